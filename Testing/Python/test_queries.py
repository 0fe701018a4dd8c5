# SPDX-License-Identifier: BSD-3-Clause
"""Queries over numpy arrays and by the program agree with a scene that can be worked out by hand."""
import os
import subprocess
import tempfile
import unittest

import numpy as np

from freespace import make_view, queries
from freespace.vtkFreespaceFilters import vtkDelaunayDisparityFilter, vtkFreespaceUnion
from freespace.vtkFreespaceWriters import vtkViewBlocksWriter
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkMultiBlockDataSet


def wall_maps():
    """A camera at the origin sees a square wall at z = 2, from -1 to 1 in x and y.
    A second camera sees another wall from behind."""
    K = np.array([[100., 0, 200], [0, 100, 200], [0, 0, 1]])
    x, y = np.meshgrid(np.linspace(-1, 1, 9), np.linspace(-1, 1, 9))
    points = np.stack([x.ravel(), y.ravel(), np.full(81, 2.)], 1)
    pixels = points[:, :2] / points[:, 2:] * 100 + 200
    near = make_view(points, pixels, K, np.eye(4)[:3], (400, 400))
    # It stands at z = 6 and looks back at a wall at z = 4.
    points[:, 2] = 4
    turn = np.diag([-1., 1, -1])
    pixels = (points * [-1, 1, 0])[:, :2] / 2 * 100 + 200
    far = make_view(points, pixels, K, np.hstack([turn, [[0], [0], [6]]]), (400, 400))
    blocks = vtkMultiBlockDataSet()
    for i, (name, block) in enumerate((('near', near), ('far', far))):
        blocks.SetBlock(i, block)
        blocks.GetMetaData(i).Set(vtkCompositeDataSet.NAME(), name)
    filter = vtkDelaunayDisparityFilter()
    filter.MinimumDisparityOff()
    filter.SetInputData(blocks)
    filter.Update()
    return filter.GetOutput()


class TestQueries(unittest.TestCase):
    """Matter fills z = 2 to 4 between the two walls."""

    points = np.array([[0, 0, 1], [0, 0, 2.1], [0, 0, 3.9], [0, 0, 4.1], [3, 0, 3]])
    first = np.array([[0, 0, 1], [0, 0, 1], [.5, .5, 5], [0, 0, 3]])
    last = np.array([[0, 0, 5], [0, 0, 1.9], [.5, .5, 1], [0, 0, 9]])

    def setUp(self):
        self.maps = wall_maps()
        self.phi = vtkFreespaceUnion()
        self.phi.SetHullMargin(0)
        self.phi.SetMaps(self.maps)

    def test_points(self):
        np.testing.assert_array_equal(
            queries.points_free(self.phi, self.points), [True, False, False, True, True])
        self.assertEqual(queries.points_free(self.phi, np.zeros((0, 3))).shape, (0,))

    def test_segments(self):
        np.testing.assert_allclose(
            queries.first_blocked(self.phi, self.first, self.last), [.25, np.inf, .25, 0], atol=1e-9)
        with self.assertRaises(ValueError):
            queries.first_blocked(self.phi, self.first, self.last[:2])

    def test_spheres(self):
        centers = [[0, 0, 1.5]] * 3
        np.testing.assert_array_equal(
            queries.spheres_free(self.phi, centers, [.1, .49, .51]), [True, True, False])
        np.testing.assert_array_equal(queries.spheres_free(self.phi, centers, .6), [False] * 3)

    def test_an_observer_sees_progress_and_stops(self):
        seen = []
        tag = self.phi.AddObserver(
            'ProgressEvent', lambda phi, event: (seen.append(event), phi.SetAbortExecute(1)))
        self.phi.Update()
        self.assertEqual(len(seen), 1)
        for stopped in (queries.points_free(self.phi, self.points),
                        queries.first_blocked(self.phi, self.first, self.last),
                        queries.spheres_free(self.phi, self.points, .1)):
            self.assertEqual(stopped.shape, (0,))
        self.assertEqual(len(seen), 4)
        self.phi.RemoveObserver(tag)
        self.test_points()

    def test_program(self):
        with tempfile.TemporaryDirectory() as folder:
            writer = vtkViewBlocksWriter()
            writer.SetFileName(os.path.join(folder, 'maps.vtm'))
            writer.SetInputData(self.maps)
            writer.Write()
            for outside, option, table, answer in (
                    (['--outside', 'free'], '--points', self.points, [1, 0, 0, 1, 1]),
                    ([], '--segments', np.hstack([self.first, self.last]), [.25, np.inf, .25, 0])):
                np.savetxt(os.path.join(folder, 'table.csv'), table, delimiter=',', header='x,y,z',
                           comments='')
                run = subprocess.run(
                    [os.environ['FREESPACE_PROGRAM'], '--quiet', 'query', 'maps.vtm', *outside, option, 'table.csv',
                     '--hull-margin', '0'], cwd=folder, capture_output=True, text=True)
                self.assertEqual(run.returncode, 0, run.stderr)
                lines = run.stdout.split('\n')
                np.testing.assert_allclose([float(x) for x in lines[1:-1]], answer, atol=1e-9)

    def ask(self, table, *options):
        """Writes the maps and a table of these bytes (None: a folder), and asks for its points."""
        with tempfile.TemporaryDirectory() as folder:
            writer = vtkViewBlocksWriter()
            writer.SetFileName(os.path.join(folder, 'maps.vtm'))
            writer.SetInputData(self.maps)
            writer.Write()
            path = os.path.join(folder, 'table.csv')
            if table is None:
                os.mkdir(path)
            else:
                with open(path, 'wb') as file:
                    file.write(table)
            return subprocess.run(
                [os.environ['FREESPACE_PROGRAM'], '--quiet', 'query', 'maps.vtm', '--points', 'table.csv',
                 *options], cwd=folder, capture_output=True, text=True)

    def refuse(self, words, *arguments):
        run = self.ask(*arguments)
        self.assertNotEqual(run.returncode, 0)
        self.assertEqual(run.stderr.count('\n'), 1, run.stderr)
        for word in words:
            self.assertIn(word, run.stderr)

    def test_program_reads_headings_and_byte_order_marks(self):
        for table in (b'0,0,1\n', b'\xef\xbb\xbf0,0,1\n', b'\xef\xbb\xbfx,y,z\r\n0,0,1\r\n',
                      b'0e0,0e0,1e0\n', b'\n x;y;z\n\n0 0 1'):
            with self.subTest(table=table):
                run = self.ask(table)
                self.assertEqual((run.returncode, run.stdout), (0, 'free\n1\n'), run.stderr)

    def test_program_refuses_bad_tables(self):
        for table, words in (
                (None, 'folder'), (b'', 'empty'), (b'\xef\xbb\xbf', 'empty'), (b'1,2\n', 'line 1'),
                (b'1;2;3\n', 'line 1'), (b'1;2;3e5\n', 'line 1'), (b'\xef\xbb\xbf1;2;3\n', 'line 1'),
                (b'nan,0,0\n', 'line 1'), (b'-\n0,0,1\n', 'line 1'), (b'x,y,z\n0,0,1\n0,0,1,4e\n', 'line 3'),
                (b'x,y,z\nx,y,z\n', 'line 2')):
            with self.subTest(table=table):
                self.refuse(['table.csv', words], table)

    def test_program_refuses_bad_settings(self):
        self.refuse(['only 2 views'], b'0,0,1\n', '--min-views', '3')
        self.refuse(['margin'], b'0,0,1\n', '--hull-margin', '10')
        self.maps.GetBlock(0).SetPolys(None)
        self.assertEqual(self.ask(b'0,0,1\n').returncode, 0)
        self.maps.GetBlock(1).SetPolys(None)
        self.refuse(['maps.vtm', 'features', 'triangulate'], b'0,0,1\n')


if __name__ == '__main__':
    unittest.main()
