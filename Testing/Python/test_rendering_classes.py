# SPDX-License-Identifier: BSD-3-Clause
"""vtkViewDependentTextureMapper, vtkTextureBaker and vtkOccupancyMapWriter from Python."""
import os
import shutil
import tempfile
import unittest
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import (vtkCellArray, vtkCompositeDataSet, vtkImageData, vtkMultiBlockDataSet,
                                           vtkPolyData)

import freespace

WIDTH, HEIGHT = 160, 120
K = np.array([[150.0, 0, WIDTH / 2], [0, 150.0, HEIGHT / 2], [0, 0, 1]])
# 2 above the plane z = 0, looking straight down, x to the right and y up in the picture; and as far below.
FROM_ABOVE = np.array([[1.0, 0, 0, 0], [0, -1, 0, 0], [0, 0, -1, 2]])
FROM_BELOW = np.array([[1.0, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 2]])
RED, BLUE = (200, 30, 20), (20, 40, 210)


def square(half=0.5):
    """The square |x|, |y| <= half in the plane z = 0, seen from above, of 32 x 32 cells."""
    side = np.linspace(-half, half, 33)
    x, y = np.meshgrid(side, side)
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.stack([x, y, 0 * x], -1).reshape(-1, 3), deep=True))
    cells = vtkCellArray()
    for row in range(32):
        for column in range(32):
            a = 33 * row + column
            cells.InsertNextCell(3, (a, a + 1, a + 34))
            cells.InsertNextCell(3, (a, a + 34, a + 33))
    surface = vtkPolyData()
    surface.SetPoints(points)
    surface.SetPolys(cells)
    return surface


def add_camera(data, name):
    for values, kind in ((K, 'CameraIntrinsics'), (FROM_ABOVE, 'CameraFromWorld'),
                         (np.array([WIDTH, HEIGHT], np.int32), 'ImageSize')):
        array = numpy_to_vtk(np.ascontiguousarray(values.reshape(1, -1)), deep=True)
        array.SetName(kind)
        data.GetFieldData().AddArray(array)
    file = vtkStringArray()
    file.SetName('ImageFile')
    file.InsertNextValue(name)
    data.GetFieldData().AddArray(file)


def photographs(name='above.jpg'):
    """One photograph from above, red left of the middle and blue right of it."""
    pixels = np.empty((HEIGHT, WIDTH, 3), np.uint8)
    pixels[:, :WIDTH // 2], pixels[:, WIDTH // 2:] = RED, BLUE
    image = vtkImageData()
    image.SetDimensions(WIDTH, HEIGHT, 1)
    image.GetPointData().SetScalars(numpy_to_vtk(pixels.reshape(-1, 3), deep=True))
    add_camera(image, name)
    blocks = vtkMultiBlockDataSet()
    blocks.SetBlock(0, image)
    blocks.GetMetaData(0).Set(vtkCompositeDataSet.NAME(), name)
    return blocks


def errors_of(algorithm):
    """The texts of the errors that it tells from now on."""
    told = []

    def tell(caller, event, text):
        told.append(text)
    tell.CallDataType = 'string0'
    algorithm.AddObserver('ErrorEvent', tell)
    return told


def picture_of(surface, mapper, pose=FROM_ABOVE):
    picture = freespace.vtkSurfacePicture()
    picture.SetInputDataObject(surface)
    picture.SetMapper(mapper)
    picture.SetSamples(1)
    picture.SetView(K.ravel(), pose.ravel(), (WIDTH, HEIGHT))
    picture.Update()
    return picture


def pixels_of(picture):
    return vtk_to_numpy(picture.GetOutput().GetPointData().GetScalars()).reshape(HEIGHT, WIDTH, 3).astype(int)


class TestViewDependentTextureMapper(unittest.TestCase):
    def test_surface_has_the_photographs_colours(self):
        mapper = freespace.vtkViewDependentTextureMapper()
        mapper.SetPhotographs(photographs())
        picture = picture_of(square(), mapper)   # its window keeps what the mapper uses
        seen = pixels_of(picture)
        row = seen[HEIGHT // 2]
        np.testing.assert_allclose(row[WIDTH // 2 - 10], RED, atol=4)
        np.testing.assert_allclose(row[WIDTH // 2 + 10], BLUE, atol=4)
        np.testing.assert_array_equal(row[2], (255, 255, 255), 'beside the square is the background')
        self.assertEqual(mapper.GetNumberOfViewsInUse(), 1)
        self.assertEqual(mapper.GetViewInUse(0), 'above.jpg')

    def test_without_photographs_all_is_unseen(self):
        mapper = freespace.vtkViewDependentTextureMapper()
        mapper.SetUnseenColor(0.2, 0.6, 0.4)
        seen = pixels_of(picture_of(square(), mapper))
        np.testing.assert_allclose(seen[HEIGHT // 2, WIDTH // 2], (51, 153, 102), atol=2)
        self.assertEqual(mapper.GetNumberOfViewsInUse(), 0)

    def test_back_of_the_surface_is_unseen(self):
        mapper = freespace.vtkViewDependentTextureMapper()
        mapper.SetPhotographs(photographs())
        mapper.SetUnseenColor(0.2, 0.6, 0.4)
        seen = pixels_of(picture_of(square(), mapper, FROM_BELOW))
        np.testing.assert_allclose(seen[HEIGHT // 2, WIDTH // 2 - 10], (51, 153, 102), atol=2)

    def test_block_that_is_no_photograph_is_named(self):
        blocks = photographs()
        blocks.SetBlock(1, vtkPolyData())
        blocks.GetMetaData(1).Set(vtkCompositeDataSet.NAME(), 'odd.jpg')
        mapper = freespace.vtkViewDependentTextureMapper()
        mapper.SetPhotographs(blocks)
        told = errors_of(mapper)
        picture_of(square(), mapper)
        self.assertEqual(len(told), 1)
        self.assertIn('odd.jpg', told[0])

    def test_settings_are_kept_within_their_range(self):
        mapper = freespace.vtkViewDependentTextureMapper()
        for name, low, high in (('BlendedViews', 1, 8), ('Feather', 1, 1000), ('Tolerance', 0, 1000),
                                ('EdgeSamples', 1, 8), ('MaximumNumberOfViews', 1, 64),
                                ('MaximumPhotographSize', 16, 16384), ('TextureMemory', 1, 1048576)):
            for value, kept in ((-5, low), (10**8, high)):
                getattr(mapper, f'Set{name}')(value)
                self.assertEqual(getattr(mapper, f'Get{name}')(), kept, name)
        before = mapper.GetMTime()
        mapper.SetBlendedViews(3)
        self.assertGreater(mapper.GetMTime(), before)


class TestTextureBaker(unittest.TestCase):
    def bake(self, surface=None, blocks=None, **settings):
        baker = freespace.vtkTextureBaker()
        baker.SetInputDataObject(surface or square())
        baker.SetPhotographs(blocks or photographs())
        for name, value in settings.items():
            getattr(baker, f'Set{name}')(value)
        baker.Update()
        return baker

    def test_points_and_texture_have_the_photographs_colours(self):
        baker = self.bake()
        baked = baker.GetOutput()
        points, _ = freespace.surface_arrays(baked)
        colors = vtk_to_numpy(baked.GetPointData().GetScalars()).astype(int)
        self.assertEqual(baked.GetNumberOfCells(), 2048)
        self.assertEqual(baked.GetPointData().GetScalars().GetName(), 'RGB')
        np.testing.assert_allclose(np.median(colors[points[:, 0] < -0.1], axis=0), RED, atol=4)
        np.testing.assert_allclose(np.median(colors[points[:, 0] > 0.1], axis=0), BLUE, atol=4)
        # The same by the coordinates in the texture.
        width, height, _ = baker.GetTexture().GetDimensions()
        texture = vtk_to_numpy(baker.GetTexture().GetPointData().GetScalars()).reshape(height, width, 3)
        at = vtk_to_numpy(baked.GetPointData().GetTCoords())
        left = at[(points[:, 0] < -0.1) & (points[:, 0] > -0.4)]
        columns = np.clip((left[:, 0] * width).astype(int), 0, width - 1)
        rows = np.clip((left[:, 1] * height).astype(int), 0, height - 1)
        np.testing.assert_allclose(np.median(texture[rows, columns].astype(int), axis=0), RED, atol=4)
        self.assertEqual(baker.GetNumberOfCharts(), 1)

    def test_texel_is_as_asked_and_the_texture_no_larger(self):
        baker = self.bake(TexelSize=0.02)
        self.assertAlmostEqual(baker.GetBakedTexelSize(), 0.02)
        width, height, _ = baker.GetTexture().GetDimensions()
        self.assertGreaterEqual(min(width, height), 50)
        small = self.bake(LargestTexture=64)
        self.assertLessEqual(max(small.GetTexture().GetDimensions()), 64)
        self.assertGreater(small.GetBakedTexelSize(), self.bake().GetBakedTexelSize())

    def test_memory_is_limited(self):
        blocks = photographs()
        images = 10 / 2 ** 20 * sum(np.prod(blocks.GetBlock(i).GetDimensions()[:2])
                                    for i in range(blocks.GetNumberOfBlocks()))
        texture = 15 / 2 ** 20 * 64 * 64
        baker = self.bake(MemoryLimit=images + texture)
        width, height, _ = baker.GetTexture().GetDimensions()
        self.assertLessEqual(width * height, 64 * 64)
        self.assertGreater(baker.GetBakedTexelSize(), self.bake().GetBakedTexelSize())
        for settings, told in (({'MemoryLimit': images / 2}, 'images take'),
                               ({'MemoryLimit': images + texture, 'TexelSize': 0.001}, 'MiB')):
            baker = freespace.vtkTextureBaker()
            baker.SetInputDataObject(square())
            baker.SetPhotographs(blocks)
            for name, value in settings.items():
                getattr(baker, 'Set' + name)(value)
            errors = errors_of(baker)
            baker.Update()
            self.assertEqual(baker.GetOutput().GetNumberOfCells(), 0)
            self.assertEqual(len(errors), 1)
            self.assertIn(told, errors[0])

    def test_a_texel_too_fine_for_the_texture_is_refused(self):
        baker = freespace.vtkTextureBaker()
        baker.SetInputDataObject(square())
        baker.SetPhotographs(photographs())
        baker.SetTexelSize(0.001)
        baker.SetLargestTexture(64)
        told = errors_of(baker)
        baker.Update()
        self.assertEqual(baker.GetOutput().GetNumberOfCells(), 0)
        self.assertEqual(len(told), 1)
        self.assertIn('64', told[0])

    def test_without_photographs_all_is_unseen(self):
        baker = self.bake(blocks=vtkMultiBlockDataSet(), UnseenColor=(0.2, 0.6, 0.4), TexelSize=0.02)
        colors = vtk_to_numpy(baker.GetOutput().GetPointData().GetScalars()).astype(int)
        np.testing.assert_allclose(colors, np.broadcast_to((51, 153, 102), colors.shape), atol=1)

    def test_empty_surface_and_photographs_that_are_none_are_errors(self):
        odd = vtkMultiBlockDataSet()
        odd.SetBlock(0, vtkPolyData())
        for surface, blocks in ((vtkPolyData(), photographs()), (square(), odd)):
            baker = freespace.vtkTextureBaker()
            baker.SetInputDataObject(surface)
            baker.SetPhotographs(blocks)
            told = errors_of(baker)
            baker.Update()
            self.assertEqual(len(told), 1)
            self.assertEqual(baker.GetOutput().GetNumberOfPoints(), 0)

    def test_another_photograph_is_baked_anew(self):
        baker = self.bake()
        first = vtk_to_numpy(baker.GetOutput().GetPointData().GetScalars()).copy()
        blocks = photographs()
        scalars = blocks.GetBlock(0).GetPointData().GetScalars()
        vtk_to_numpy(scalars)[:] = (10, 200, 30)
        baker.SetPhotographs(blocks)
        baker.Update()
        second = vtk_to_numpy(baker.GetOutput().GetPointData().GetScalars())
        np.testing.assert_allclose(np.median(second.astype(int), axis=0), (10, 200, 30), atol=4)
        self.assertGreater(np.abs(first.astype(int) - second).mean(), 20)


class TestOccupancyMapWriter(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix='freespace-test-'))
        self.addCleanup(shutil.rmtree, self.folder)

    def maps(self):
        """Maps of one view from above: a square of features on the plane, and one that sticks up in the middle."""
        side = np.linspace(-0.5, 0.5, 9)
        x, y = np.meshgrid(side, side)
        points = np.stack([x, y, np.where((abs(x) < 0.2) & (abs(y) < 0.2), 0.3, 0)], -1).reshape(-1, 3)
        seen = points @ FROM_ABOVE[:, :3].T + FROM_ABOVE[:, 3]
        pixels = seen @ K.T
        view = freespace.make_view(points, pixels[:, :2] / pixels[:, 2:], K, FROM_ABOVE, (WIDTH, HEIGHT), 'above.jpg')
        maps = freespace.vtkDelaunayDisparityFilter()
        maps.SetInputDataObject(freespace.make_views({'above': view}))
        maps.Update()
        return maps.GetOutput()

    def writer(self, name='map.bt', maps=None):
        writer = freespace.vtkOccupancyMapWriter()
        writer.SetInputDataObject(maps or self.maps())
        writer.SetFileName(str(self.folder / name))
        writer.SetResolution(0.05)
        return writer

    def test_file_is_an_octomap_of_that_resolution(self):
        for name in ('map.bt', 'map.ot'):
            writer = self.writer(name)
            self.assertEqual(writer.Write(), 1)
            header = (self.folder / name).read_bytes().split(b'data\n')[0].decode()
            self.assertTrue(header.startswith('# Octomap OcTree'), header)
            self.assertIn('id OcTree', header)
            self.assertIn('res 0.05', header)
        self.assertEqual(sorted(os.listdir(self.folder)), ['map.bt', 'map.ot'])

    def test_faults_are_told_and_nothing_is_left(self):
        features = freespace.make_views({'empty': freespace.make_view([], [], K, FROM_ABOVE, (WIDTH, HEIGHT))})
        for name, maps in (('map.xyz', None), ('nowhere/map.bt', None), ('map.bt', features),
                           ('map.bt', vtkMultiBlockDataSet())):
            with self.subTest(name=name):
                writer = self.writer(name, maps)
                told = errors_of(writer)
                self.assertEqual(writer.Write(), 0)
                self.assertEqual(len(told), 1, told)
                self.assertIn(name, told[0])
                self.assertEqual(os.listdir(self.folder), [])

    def test_settings(self):
        writer = freespace.vtkOccupancyMapWriter()
        self.assertEqual((writer.GetResolution(), writer.GetHullMargin(), writer.GetMinimumViews()), (0, -1, -1))
        writer = self.writer('map.bt')
        writer.SetMinimumViews(0)
        told = errors_of(writer)
        self.assertEqual(writer.Write(), 0)
        self.assertIn('minimum number of views', told[0])
        for resolution in (-1, float('nan'), float('inf')):
            writer = self.writer('map.bt')
            writer.SetResolution(resolution)
            told = errors_of(writer)
            self.assertEqual(writer.Write(), 0)
            self.assertIn('resolution', told[0])


if __name__ == '__main__':
    unittest.main()
