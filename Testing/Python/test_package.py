# SPDX-License-Identifier: BSD-3-Clause
"""What one expects of a Python package: a version, names, keyword arguments, paths, types, one call for all."""
import ast
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

import freespace

PROGRAM = os.environ['FREESPACE_PROGRAM']
SCENE = Path(os.environ['FREESPACE_SCENE'])


class TestNames(unittest.TestCase):
    def test_version_is_the_programs(self):
        told = subprocess.run([PROGRAM, '--version'], capture_output=True, text=True, check=True).stdout
        self.assertEqual(told.split()[-1], freespace.__version__)

    def test_all_is_there_and_documented(self):
        for name in freespace.__all__:
            self.assertTrue(hasattr(freespace, name), name)
            if name != '__version__':
                self.assertTrue(getattr(freespace, name).__doc__, name)
        self.assertIn('vtkEdgeStereoReader', freespace.__all__)
        self.assertTrue(callable(freespace.queries.points_free))

    def test_types_are_valid_python_and_tell_every_class(self):
        folder = Path(freespace.__file__).parent
        self.assertTrue((folder / 'py.typed').exists())
        tree = ast.parse((folder / 'classes.pyi').read_text())
        classes = {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}
        self.assertEqual(set(classes), set(freespace.classes.__all__))
        contour = ast.unparse(classes['vtkBisectionContourFilter'])
        self.assertIn('cells: int', contour)
        self.assertIn('def SetCells(self, _arg: int) -> None', contour)


class TestProperties(unittest.TestCase):
    def test_keyword_arguments_and_properties(self):
        contour = freespace.vtkBisectionContourFilter(cells=512, sharp_edges=True)
        self.assertEqual((contour.GetCells(), contour.GetSharpEdges()), (512, True))
        contour.cells = 64
        self.assertEqual((contour.cells, contour.GetCells()), (64, 64))
        picture = freespace.vtkSurfacePicture(size=(32, 16))
        self.assertEqual(picture.GetSize(), (32, 16))

    def test_every_property_of_every_class_can_be_read(self):
        for name in freespace.classes.__all__:
            made = getattr(freespace, name)()
            for each in made.__properties__:
                with self.subTest(name=name, property=each):
                    getattr(made, each)

    def test_an_unknown_property_is_an_error(self):
        with self.assertRaisesRegex(TypeError, "no property 'celsl'.*cells"):
            freespace.vtkBisectionContourFilter(celsl=3)

    def test_they_are_vtk_classes(self):
        from freespace import vtkFreespaceFilters
        self.assertIsInstance(freespace.vtkFreespaceUnion(), vtkFreespaceFilters.vtkFreespaceUnion)
        self.assertTrue(freespace.vtkFreespaceUnion().IsA('vtkImplicitFunction'))

    def test_snake_case(self):
        for camel, snake in (('NumberOfViews', 'number_of_views'), ('FileName', 'file_name'), ('GLBFile', 'glb_file'),
                             ('K', 'k'), ('Cells', 'cells')):
            self.assertEqual(freespace.classes.snake_case(camel), snake)

    def test_paths(self):
        reader = freespace.vtkEdgeStereoReader(file_name=SCENE)
        self.assertEqual(reader.GetFileName(), str(SCENE))
        reader.SetFileName(Path('other.json'))
        self.assertEqual(reader.file_name, 'other.json')


class TestReconstruct(unittest.TestCase):
    def test_is_what_the_program_makes(self):
        surface = freespace.reconstruct(SCENE, cells=48)
        vertices, triangles = freespace.surface_arrays(surface)
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / 'mesh.ply'
            subprocess.run([PROGRAM, '-q', 'reconstruct', SCENE, '-o', file, '--cells', '48'], check=True)
            expected = freespace.update(freespace.vtkSurfaceReader(file_name=file))
            expected_vertices, expected_triangles = freespace.surface_arrays(expected)
        np.testing.assert_array_equal(triangles, expected_triangles)
        np.testing.assert_allclose(vertices, expected_vertices, rtol=1e-6, atol=1e-6)

    def test_errors_are_raised(self):
        with self.assertRaisesRegex(freespace.Error, 'nowhere.json'):
            freespace.reconstruct(Path('nowhere.json'))
        with self.assertRaisesRegex(TypeError, 'no property'):
            freespace.reconstruct(SCENE, nonsense=3)


if __name__ == '__main__':
    unittest.main()
