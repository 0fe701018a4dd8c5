# SPDX-License-Identifier: BSD-3-Clause
"""Views go from numpy to VTK and back unchanged; images in arrays give the features that their files give."""
import gc
import json
import os
import tempfile
import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

import freespace

SCENE = os.environ['FREESPACE_SCENE']
PINHOLE = np.array([[40., 0, 10], [0, 40, 8], [0, 0, 1]])


def random_view(rng, n):
    K = np.array([[500., 0, 320], [0, 510, 240], [0, 0, 1]])
    cam_from_world = np.hstack([np.eye(3), [[.1], [.2], [.3]]])
    return dict(points=rng.normal(size=(n, 3)), image_points=rng.uniform(0, 480, (n, 2)), K=K,
                cam_from_world=cam_from_world, size=(640, 480), image_file='c.jpg')


class TestArrays(unittest.TestCase):
    def test_round_trip(self):
        view = random_view(np.random.default_rng(1), 50)
        back = freespace.view_arrays(freespace.make_view(**view))
        for name in ('points', 'image_points', 'K', 'cam_from_world'):
            np.testing.assert_array_equal(back[name], view[name])
        self.assertEqual(back['size'], view['size'])
        self.assertEqual(back['triangles'].shape, (0, 3))

    def test_rows_are_copied_unless_asked_otherwise(self):
        view = random_view(np.random.default_rng(1), 50)
        before = tuple(view['points'][7])
        copied, shared = freespace.make_view(**view), freespace.make_view(**view, copy=False)
        K = view['K'].copy()
        view['points'][7] = [1, 2, 3]
        view['K'][0, 0] = 1
        view['cam_from_world'][0, 3] = 1
        for block in (copied, shared):
            np.testing.assert_array_equal(freespace.view_arrays(block)['K'], K, 'a camera is always copied')
            self.assertEqual(freespace.view_arrays(block)['cam_from_world'][0, 3], .1)
        self.assertEqual(copied.GetPoint(7), before)
        self.assertEqual(shared.GetPoint(7), (1, 2, 3))
        self.assertTrue(np.shares_memory(vtk_to_numpy(shared.GetPointData().GetArray('ImagePoint')),
                                         view['image_points']))

    def test_shared_memory_outlives_its_array(self):
        blocks = []
        for seed in range(20):
            blocks.append(freespace.make_view(**random_view(np.random.default_rng(seed), 1000), copy=False))
            gc.collect()
        for seed, block in enumerate(blocks):
            wanted = random_view(np.random.default_rng(seed), 1000)['points']
            np.testing.assert_array_equal(freespace.view_arrays(block)['points'], wanted)

    def test_other_layouts_are_copied(self):
        view = random_view(np.random.default_rng(1), 50)
        points = view['points'].copy()
        layouts = [np.asfortranarray(points), points.astype(np.float32), np.repeat(points, 2, axis=0)[::2]]
        points.flags.writeable = False
        for other in (*layouts, points):
            back = freespace.view_arrays(freespace.make_view(**{**view, 'points': other}, copy=False))['points']
            np.testing.assert_array_equal(back, other)
            self.assertFalse(np.shares_memory(back, other))

    def test_images_that_are_bottom_up_are_shared_if_asked(self):
        pixels = np.arange(24, dtype=np.uint8).reshape(4, 6)
        K, pose = random_view(np.random.default_rng(1), 1)['K'], np.eye(4)[:3]
        for copy, shares in ((True, False), (False, True)):
            image = freespace.make_image(pixels[::-1], K, pose, copy=copy)
            inside = vtk_to_numpy(image.GetPointData().GetScalars())
            np.testing.assert_array_equal(inside.ravel(), pixels.ravel())
            self.assertEqual(np.shares_memory(inside, pixels), shares)

    def test_empty_view(self):
        view = random_view(np.random.default_rng(1), 0)
        back = freespace.view_arrays(freespace.make_view(**view))
        self.assertEqual(back['points'].shape, (0, 3))

    def test_unequal_lengths(self):
        view = random_view(np.random.default_rng(1), 5)
        view['image_points'] = view['image_points'][:4]
        with self.assertRaises(ValueError):
            freespace.make_view(**view)

    def test_other_shapes_are_refused(self):
        view = random_view(np.random.default_rng(1), 5)
        turned = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1.]])
        wrong = {'points': view['points'].T, 'image_points': view['image_points'].T, 'K': view['K'].T,
                 'cam_from_world': view['cam_from_world'].T}
        for name, value in wrong.items():
            with self.assertRaises(ValueError, msg=name):
                freespace.make_view(**{**view, name: value})
        for K in (-view['K'], np.full((3, 3), np.nan), np.zeros((3, 3))):
            with self.assertRaises(ValueError):
                freespace.make_view(**{**view, 'K': K})
        for R in (2 * turned, turned * [1, 1, -1], np.full((3, 3), np.nan)):
            with self.assertRaises(ValueError):
                freespace.make_view(**{**view, 'cam_from_world': np.hstack([R, np.zeros((3, 1))])})
        freespace.make_view(**{**view, 'cam_from_world': np.hstack([turned, np.zeros((3, 1))])})

    def test_surface_of_other_cells_is_refused(self):
        from vtkmodules.vtkFiltersSources import vtkCubeSource
        cube = vtkCubeSource()
        cube.Update()
        with self.assertRaises(ValueError):
            freespace.surface_arrays(cube.GetOutput())

    def test_outlier_filter_takes_views_from_numpy(self):
        view = random_view(np.random.default_rng(1), 0)
        pixels = np.array([[100., 100], [101, 101], [102, 100], [103, 101], [101, 100]])
        depth = np.array([2.0, 2, 2, 2, 1.5])[:, None]
        rays = np.column_stack([pixels, np.ones(5)]) @ np.linalg.inv(view['K']).T
        view.update(image_points=pixels, points=depth * rays - view['cam_from_world'][:, 3])
        support = freespace.vtkOutlierFilter()
        support.SetSupport(3)
        support.SetSupportRadius(5)
        support.SetInputDataObject(freespace.make_views({'a': freespace.make_view(**view)}))
        support.Update()
        kept = freespace.views(support.GetOutput())['a']
        np.testing.assert_array_equal(kept['image_points'], pixels[:4])


class TestImagesInMemory(unittest.TestCase):
    def scene(self, clusters):
        """The example scene with its first clusters."""
        with open(SCENE) as file:
            scene = json.load(file)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        for name in ('images', 'model'):
            scene[name] = os.path.join(os.path.dirname(SCENE), scene[name])
        scene['clusters'] = scene['clusters'][:clusters]
        path = os.path.join(folder.name, 'scene.json')
        with open(path, 'w') as file:
            json.dump(scene, file)
        return path, scene['clusters']

    def arrays(self, path):
        """Of each image: its name, pixels from the top, K and cam_from_world."""
        blocks = freespace.update(freespace.vtkPhotographReader(file_name=path))
        for i in range(blocks.GetNumberOfBlocks()):
            image = blocks.GetBlock(i)
            width, height, _ = image.GetDimensions()
            pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, 3)[::-1]
            field = image.GetFieldData()
            yield (field.GetAbstractArray('ImageFile').GetValue(0), pixels,
                   vtk_to_numpy(field.GetArray('CameraIntrinsics')).reshape(3, 3),
                   vtk_to_numpy(field.GetArray('CameraFromWorld')).reshape(3, 4))

    def test_numpy_arrays_give_the_same_features(self):
        path, clusters = self.scene(2)
        stereo = freespace.vtkEdgeStereoReader()
        stereo.SetInputDataObject(freespace.make_views(
            {name: freespace.make_image(pixels, K, pose) for name, pixels, K, pose in self.arrays(path)}))
        for cluster in clusters:
            for triplet in cluster['triplets']:
                stereo.AddTriplet(cluster['name'], *triplet)
        self.assertEqual(stereo.GetNumberOfTriplets(), 4)
        found = freespace.views(freespace.update(stereo))
        expected = freespace.views(freespace.update(freespace.vtkEdgeStereoReader(file_name=path)))
        self.assertEqual(list(found), list(expected))
        for name, view in expected.items():
            self.assertGreater(len(view['points']), 1000)
            for key, value in view.items():
                np.testing.assert_array_equal(found[name][key], value, f'{key} of {name}')

    def test_clusters_are_proposed(self):
        path, _ = self.scene(1)
        stereo = freespace.vtkEdgeStereoReader(every_image=0, refine_cameras=0, check_images=False)
        stereo.SetInputDataObject(freespace.make_views(
            {name: freespace.make_image(pixels, K, pose) for name, pixels, K, pose in self.arrays(path)
             if name.startswith('cluster1')}))
        views = freespace.views(freespace.update(stereo))
        self.assertIn('reference', stereo.GetClusterSummary())
        self.assertGreater(len(views), 0)

    def test_pixels_are_where_they_were(self):
        pixels = np.arange(6 * 4 * 3, dtype=np.uint8).reshape(4, 6, 3)
        for given in (pixels, pixels[:, :, 0], pixels.astype(np.float32)):
            image = freespace.make_image(given, PINHOLE, np.eye(3, 4))
            for row, column in ((0, 0), (1, 4), (3, 5)):
                self.assertEqual(image.GetScalarComponentAsDouble(column, 3 - row, 0, 0),
                                 np.atleast_3d(given)[row, column, 0])
        pixels[:] = 0  # the image holds its own
        self.assertGreater(image.GetScalarComponentAsDouble(5, 0, 0, 0), 0)

    def test_what_is_no_image(self):
        for pixels in (np.zeros((4, 6, 2), np.uint8), np.zeros(4, np.uint8), np.zeros((0, 6), np.uint8),
                       np.zeros((4, 6), np.int64)):
            with self.assertRaises(ValueError):
                freespace.make_image(pixels, PINHOLE, np.eye(3, 4))
        with self.assertRaises(ValueError):
            freespace.make_image(np.zeros((4, 6), np.uint8), PINHOLE.T, np.eye(3, 4))
        stereo = freespace.vtkEdgeStereoReader()
        stereo.SetInputDataObject(freespace.make_views({}))
        with self.assertRaisesRegex(freespace.Error, 'There are no images'):
            freespace.update(stereo)


if __name__ == '__main__':
    unittest.main()
