# SPDX-License-Identifier: BSD-3-Clause
"""What VTK reports as an error becomes an exception, wherever in a pipeline it happens."""
import os
import tempfile
import unittest

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkImplicitBoolean
from vtkmodules.vtkFiltersCore import vtkCutter
from vtkmodules.vtkFiltersSources import vtkSphereSource

import freespace


def plane_view(n=8):
    K = np.array([[500., 0, 320], [0, 500, 240], [0, 0, 1]])
    x, y = np.meshgrid(np.linspace(-1, 1, n), np.linspace(-1, 1, n))
    points = np.column_stack([x.ravel(), y.ravel(), 4 + 0 * x.ravel()])
    pixels = points[:, :2] / points[:, 2:] * 500 + [320, 240]
    return freespace.make_view(points, pixels, K, np.eye(3, 4), (640, 480))


class TestUpdate(unittest.TestCase):
    def test_returns_the_output(self):
        maps = freespace.vtkDelaunayDisparityFilter()
        maps.SetInputDataObject(freespace.make_views({'a': plane_view()}))
        output = freespace.update(maps)
        self.assertEqual(output.GetNumberOfBlocks(), 1)
        self.assertGreater(output.GetNumberOfCells(), 50)

    def test_its_own_error(self):
        reader = freespace.vtkEdgeStereoReader()
        reader.SetFileName('nowhere.json')
        with self.assertRaisesRegex(freespace.Error, r'^Cannot read nowhere\.json: there is no such'):
            freespace.update(reader)

    def test_an_error_upstream(self):
        stereo = freespace.vtkEdgeStereoReader()
        stereo.SetFileName('nowhere.json')
        maps = freespace.vtkDelaunayDisparityFilter()
        maps.SetInputConnection(stereo.GetOutputPort())
        with self.assertRaisesRegex(freespace.Error, 'nowhere.json'):
            freespace.update(maps)

    def test_an_error_of_the_function_that_is_contoured(self):
        phi = freespace.vtkFreespaceUnion()
        surface = freespace.vtkBisectionContourFilter()
        surface.SetImplicitFunction(phi)
        with self.assertRaisesRegex(freespace.Error, 'no disparity maps'):
            freespace.update(surface)

    def test_a_union(self):
        maps = freespace.vtkDelaunayDisparityFilter()
        maps.SetInputDataObject(freespace.make_views({'a': plane_view()}))
        phi = freespace.vtkFreespaceUnion()
        phi.SetInputConnection(maps.GetOutputPort())
        self.assertIs(freespace.update(phi), phi)
        self.assertTrue(phi.IsValid())
        with self.assertRaisesRegex(freespace.Error, 'no disparity maps'):
            freespace.update(freespace.vtkFreespaceUnion())

    def test_errors_upstream_of_cutters_and_booleans(self):
        for is_boolean in (False, True):
            stereo = freespace.vtkEdgeStereoReader(file_name='nowhere.json')
            maps = freespace.vtkDelaunayDisparityFilter()
            maps.SetInputConnection(stereo.GetOutputPort())
            phi = freespace.vtkFreespaceUnion()
            phi.SetInputConnection(maps.GetOutputPort())
            both = vtkImplicitBoolean()
            both.AddFunction(phi)
            sphere = vtkSphereSource()
            cutter = vtkCutter()
            cutter.SetCutFunction(both if is_boolean else phi)
            cutter.SetInputConnection(sphere.GetOutputPort())
            with self.assertRaisesRegex(freespace.Error, 'nowhere.json'):
                freespace.update(cutter)

    def test_writers_write(self):
        maps = freespace.vtkDelaunayDisparityFilter()
        maps.SetInputDataObject(freespace.make_views({'a': plane_view()}))
        writer = freespace.vtkViewBlocksWriter()
        writer.SetInputConnection(maps.GetOutputPort())
        with tempfile.TemporaryDirectory() as folder:
            writer.SetFileName(os.path.join(folder, 'maps.vtm'))
            freespace.update(writer)
            self.assertTrue(os.path.exists(os.path.join(folder, 'maps.vtm')))
            writer.SetFileName(os.path.join(folder, 'nowhere', 'maps.vtm'))
            with self.assertRaisesRegex(freespace.Error, 'Cannot write'):
                freespace.update(writer)

    def test_observers_are_taken_away(self):
        reader = freespace.vtkEdgeStereoReader()
        reader.SetFileName('nowhere.json')
        with self.assertRaises(freespace.Error):
            freespace.update(reader)
        self.assertFalse(reader.HasObserver('ErrorEvent'))


if __name__ == '__main__':
    unittest.main()
