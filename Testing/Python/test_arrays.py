# SPDX-License-Identifier: BSD-3-Clause
"""Views go from numpy to VTK and back unchanged."""
import unittest

import numpy as np

import freespace


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

    def test_support_filter_takes_views_from_numpy(self):
        view = random_view(np.random.default_rng(1), 0)
        pixels = np.array([[100., 100], [101, 100], [102, 100], [103, 100], [300, 300]])
        depth = 2.0
        rays = np.column_stack([pixels, np.ones(5)]) @ np.linalg.inv(view['K']).T
        view.update(image_points=pixels, points=depth * rays - view['cam_from_world'][:, 3])
        support = freespace.vtkFeatureSupportFilter()
        support.SetMinimumNeighbors(3)
        support.SetInputDataObject(freespace.make_views({'a': freespace.make_view(**view)}))
        support.Update()
        kept = freespace.views(support.GetOutput())['a']
        np.testing.assert_array_equal(kept['image_points'], pixels[:4])
        np.testing.assert_array_equal(kept['Support'], [3, 3, 3, 3])


if __name__ == '__main__':
    unittest.main()
