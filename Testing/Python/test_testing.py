# SPDX-License-Identifier: BSD-3-Clause
"""freespace.testing: regression pictures."""
import os
import tempfile
import unittest
from pathlib import Path

from freespace.testing import expect_picture, picture_error
from freespace import vtkSurfacePicture
from vtkmodules.vtkFiltersSources import vtkConeSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow
import vtkmodules.vtkRenderingOpenGL2


def cone(resolution=12, size=(80, 60)):
    source = vtkConeSource()
    source.SetResolution(resolution)
    picture = vtkSurfacePicture()
    picture.SetInputConnection(source.GetOutputPort())
    picture.SetSize(*size)
    return picture


class TestExpectPicture(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix='freespace-test-')
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.left = self.folder / 'left'
        self.left.mkdir()
        self.baseline = self.folder / 'cone.png'
        self.assertEqual(cone().WritePNG(str(self.baseline)), 1)

    def test_same_picture_passes_and_leaves_nothing(self):
        for picture in (cone(), self.baseline, str(self.baseline)):
            expect_picture(picture, self.baseline, folder=self.left)
        self.assertEqual(picture_error(cone(), self.baseline), 0)
        self.assertEqual(os.listdir(self.left), [])

    def test_other_picture_fails_and_leaves_both(self):
        with self.assertRaisesRegex(AssertionError, r'cone\.png differs'):
            expect_picture(cone(3), self.baseline, folder=self.left)
        self.assertEqual(sorted(os.listdir(self.left)), ['cone-difference.png', 'cone.png'])
        self.assertGreater(picture_error(cone(3), self.baseline), 10)

    def test_other_size_is_infinitely_different(self):
        self.assertEqual(picture_error(cone(size=(81, 60)), self.baseline), float('inf'))
        with self.assertRaises(AssertionError):
            expect_picture(cone(size=(81, 60)), self.baseline, folder=self.left)

    def test_missing_baseline_fails_and_leaves_the_picture(self):
        with self.assertRaisesRegex(AssertionError, r'no baseline .*absent\.png'):
            expect_picture(cone(), self.folder / 'absent.png', folder=self.left)
        self.assertEqual(os.listdir(self.left), ['absent.png'])
        with self.assertRaisesRegex(FileNotFoundError, 'absent'):
            picture_error(self.folder / 'absent.png', self.baseline)

    def test_render_window(self):
        mapper, actor, renderer, window = vtkPolyDataMapper(), vtkActor(), vtkRenderer(), vtkRenderWindow()
        source = vtkConeSource()
        mapper.SetInputConnection(source.GetOutputPort())
        actor.SetMapper(mapper)
        renderer.AddActor(actor)
        window.SetOffScreenRendering(1)
        window.SetSize(80, 60)
        window.AddRenderer(renderer)
        window.Render()
        with self.assertRaises(AssertionError):
            expect_picture(window, self.folder / 'window.png', folder=self.folder)
        expect_picture(window, self.folder / 'window.png', folder=self.folder)


if __name__ == '__main__':
    unittest.main()
