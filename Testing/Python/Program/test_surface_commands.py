# SPDX-License-Identifier: BSD-3-Clause
"""compare, mesh, info and export: their results by other means, and one sentence for every bad input."""
import csv
import json
import math
import unittest

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import (vtkAppendPolyData, vtkCleanPolyData, vtkClipPolyData, vtkPolyDataConnectivityFilter,
                                       vtkPolyDataNormals, vtkQuadricDecimation, vtkTriangleFilter)
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOGeometry import vtkOBJReader
from vtkmodules.vtkIOPLY import vtkPLYReader, vtkPLYWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter

from test_program import SCENE, WithFolder, run


def sphere(radius=1.0, middle=(0, 0, 0), resolution=24):
    source = vtkSphereSource()
    source.SetRadius(radius)
    source.SetCenter(middle)
    source.SetThetaResolution(resolution)
    source.SetPhiResolution(resolution)
    source.Update()
    return source.GetOutput()


def joined(*surfaces):
    append = vtkAppendPolyData()
    for surface in surfaces:
        append.AddInputData(surface)
    append.Update()
    return append.GetOutput()


def write(surface, path):
    writer = vtkXMLPolyDataWriter() if path.suffix == '.vtp' else vtkPLYWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(surface)
    writer.Write()


def read(path):
    reader = {'.vtp': vtkXMLPolyDataReader, '.ply': vtkPLYReader, '.obj': vtkOBJReader}[path.suffix]()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def points_of(surface):
    return vtk_to_numpy(surface.GetPoints().GetData()).astype(float)


def triangles_of(surface):
    return vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def to_triangle(p, a, b, c):
    """The distance of a point to a triangle: of the plane where the point is above it, else of its edges."""
    def to_segment(from_, to):
        t = numpy.clip(numpy.dot(p - from_, to - from_) / max(numpy.dot(to - from_, to - from_), 1e-300), 0, 1)
        return numpy.linalg.norm(from_ + t * (to - from_) - p)
    normal = numpy.cross(b - a, c - a)
    above = all(numpy.dot(numpy.cross(y - x, p - x), normal) >= 0 for x, y in ((a, b), (b, c), (c, a)))
    edges = min(to_segment(a, b), to_segment(b, c), to_segment(c, a))
    return abs(numpy.dot(p - a, normal)) / numpy.linalg.norm(normal) if above and normal.any() else edges


def brute_force(surface, reference):
    corners = points_of(reference)[triangles_of(reference)]
    return numpy.array([min(to_triangle(p, *triangle) for triangle in corners) for p in points_of(surface)])


class TestCompare(WithFolder):
    def setUp(self):
        super().setUp()
        write(sphere(1, resolution=9), self.folder / 'mesh.ply')
        write(sphere(1.2, resolution=7), self.folder / 'truth.ply')

    def test_distances_are_those_of_brute_force(self):
        self.succeed('compare', 'mesh.ply', 'truth.ply', '--samples', 0, '--json', 'figures.json', '-o', 'mesh.vtp',
                     '--reference-output', 'truth.vtp', '--distances', '0.1,0.15', '--bins', 3)
        figures = json.loads((self.folder / 'figures.json').read_text())
        mesh, truth = read(self.folder / 'mesh.ply'), read(self.folder / 'truth.ply')
        for way, name, one, other in (('mesh_to_reference', 'mesh.vtp', mesh, truth),
                                      ('reference_to_mesh', 'truth.vtp', truth, mesh)):
            expected = brute_force(one, other)
            found = vtk_to_numpy(read(self.folder / name).GetPointData().GetArray('Distance'))
            numpy.testing.assert_allclose(found, expected, atol=1e-12)
            self.assertAlmostEqual(figures[way]['mean'], expected.mean(), 12)
            self.assertAlmostEqual(figures[way]['root_mean_square'], math.sqrt((expected ** 2).mean()), 12)
            self.assertAlmostEqual(figures[way]['median'], sorted(expected)[len(expected) // 2], 12)
            self.assertAlmostEqual(figures[way]['greatest'], expected.max(), 12)
            bins = numpy.histogram(expected, [0, 0.05, 0.1, 0.15, numpy.inf])[0] / len(expected)
            numpy.testing.assert_allclose(figures[way]['histogram'], bins, atol=1e-12)
            share = 'accuracy' if one is mesh else 'completeness'
            numpy.testing.assert_allclose(figures[share], [(expected < d).mean() for d in (0.1, 0.15)], atol=1e-12)
        for a, c, f in zip(figures['accuracy'], figures['completeness'], figures['f']):
            self.assertAlmostEqual(f, 2 * a * c / (a + c) if a + c else 0, 12)

    def test_coloured_ply_and_histogram(self):
        result = self.succeed('compare', 'mesh.ply', 'truth.ply', '-o', 'errors.ply', '--histogram', 'shares.csv')
        self.assertIn('completeness', result.stdout)
        colors = vtk_to_numpy(read(self.folder / 'errors.ply').GetPointData().GetScalars())
        self.assertTrue((colors[:, 0] == 255).all(), 'all farther than the greatest distance: red')
        rows = list(csv.DictReader((self.folder / 'shares.csv').read_text().splitlines()))
        self.assertEqual(len(rows), 51)
        self.assertAlmostEqual(sum(float(row['mesh_to_reference']) for row in rows), 1, 6)

    def test_is_the_same_for_any_number_of_threads(self):
        one, two = (self.succeed('--threads', n, 'compare', 'mesh.ply', 'truth.ply', '--json', '-').stdout for n in (1, 2))
        self.assertEqual(one, two)


class TestMesh(WithFolder):
    def test_five_operations_are_the_filters_of_vtk(self):
        write(joined(sphere(1), sphere(0.2, (3, 0, 0)), sphere(0.1, (0, 3, 0))), self.folder / 'in.ply')
        self.succeed('mesh', 'in.ply', '--crop', '-5,5,-5,5,-0.5,5', '--largest', 1, '--triangles', 300, '--shift', '1,2,3',
                     '--normals', '-o', 'out.vtp')
        surface = read(self.folder / 'in.ply')

        def after(filter_):
            nonlocal surface
            filter_.SetInputData(surface)
            filter_.Update()
            surface = filter_.GetOutput()

        for axis, sign, place in ((0, 1, -5), (0, -1, 5), (1, 1, -5), (1, -1, 5), (2, 1, -0.5), (2, -1, 5)):
            plane, clip = vtkPlane(), vtkClipPolyData()
            plane.SetOrigin([place if k == axis else 0 for k in range(3)])
            plane.SetNormal([sign if k == axis else 0 for k in range(3)])
            clip.SetClipFunction(plane)
            clip.SetOutputPointsPrecision(vtkAlgorithm.DOUBLE_PRECISION)
            after(clip)
        after(vtkTriangleFilter())
        largest = vtkPolyDataConnectivityFilter()
        largest.SetExtractionModeToLargestRegion()
        after(largest)
        clean = vtkCleanPolyData()
        clean.PointMergingOff()
        after(clean)
        decimate = vtkQuadricDecimation()
        decimate.SetTargetReduction(1 - 300 / surface.GetNumberOfPolys())
        after(decimate)
        shift, move = vtkTransform(), vtkTransformPolyDataFilter()
        shift.Translate(1, 2, 3)
        move.SetTransform(shift)
        move.SetOutputPointsPrecision(vtkAlgorithm.DOUBLE_PRECISION)
        after(move)
        normals = vtkPolyDataNormals()
        normals.SplittingOff()
        after(normals)
        found = read(self.folder / 'out.vtp')
        self.assertGreater(found.GetNumberOfPolys(), 200)
        self.assertLessEqual(found.GetNumberOfPolys(), 300)
        numpy.testing.assert_array_equal(points_of(found), points_of(surface))
        numpy.testing.assert_array_equal(triangles_of(found), triangles_of(surface))
        numpy.testing.assert_array_equal(vtk_to_numpy(found.GetPointData().GetNormals()),
                                         vtk_to_numpy(surface.GetPointData().GetNormals()))

    def test_each_operation_is_a_row_of_the_log_in_the_order_given(self):
        write(sphere(), self.folder / 'in.ply')
        (self.folder / 'matrix.txt').write_text('2 0 0 0\n0 2 0 0\n0 0 2 0\n0 0 0 1\n')
        result = self.succeed('mesh', 'in.ply', '--shift=-1,0,0', '--scale', 2, '-o', 'out.ply', '--shift', '1,0,0', '--transform',
                              'matrix.txt')
        rows = [line.split(':')[0] for line in result.stderr.splitlines() if line.startswith('--')]
        self.assertEqual(rows, ['--shift -1,0,0', '--scale 2', '--shift 1,0,0', '--transform matrix.txt'])
        expected = ((points_of(sphere()) + [-1, 0, 0]) * 2 + [1, 0, 0]) * 2
        numpy.testing.assert_allclose(points_of(read(self.folder / 'out.ply')), expected, atol=1e-6)

    def test_crumbs_by_area(self):
        write(joined(sphere(0.1, (0, 3, 0)), sphere(1), sphere(0.2, (3, 0, 0))), self.folder / 'in.ply')
        self.succeed('mesh', 'in.ply', '--crumbs', 0.3, '-o', 'out.ply')  # 4 pi r^2: 0.13, 12.6, 0.50
        self.assertEqual(self.info('out.ply')['components'], 2)
        self.succeed('mesh', 'in.ply', '--largest', 2, '-o', 'out.ply')
        self.assertEqual(self.info('out.ply')['components'], 2)

    def test_smoothing_moves_no_farther_than_its_length(self):
        random = numpy.random.default_rng(3)
        surface = sphere(1, resolution=30)
        noise = points_of(surface) * (1 + 0.005 * random.standard_normal((surface.GetNumberOfPoints(), 1)))
        for i, point in enumerate(noise):
            surface.GetPoints().SetPoint(i, point)
        write(surface, self.folder / 'in.ply')
        self.succeed('mesh', 'in.ply', '--smooth', 0.004, '-o', 'out.ply')
        moved = numpy.linalg.norm(points_of(read(self.folder / 'out.ply')) - noise, axis=1)
        self.assertLessEqual(moved.max(), 0.004 + 1e-6)
        self.assertGreater(moved.max(), 0.0039)
        radii = numpy.linalg.norm(points_of(read(self.folder / 'out.ply')), axis=1)
        self.assertLess(radii.std(), 0.8 * numpy.linalg.norm(noise, axis=1).std())

    def test_filling_closes_small_holes_and_leaves_large_ones(self):
        write(sphere(1, resolution=30), self.folder / 'in.ply')
        self.succeed('mesh', 'in.ply', '--crop', '-2,2,-2,2,-2,0.98', '-o', 'open.ply')
        self.assertFalse(self.info('open.ply')['closed'])
        self.succeed('mesh', 'open.ply', '--fill', 0.05, '-o', 'large.ply')
        self.assertFalse(self.info('large.ply')['closed'])
        self.succeed('mesh', 'open.ply', '--fill', 0.5, '-o', 'closed.ply')
        info = self.info('closed.ply')
        self.assertTrue(info['closed'])
        self.assertEqual(info['edges_between_contrary_triangles'], 0)
        self.assertGreater(info['volume'], 4)

    def test_a_global_shift_keeps_a_scene_far_away_in_single_precision(self):
        write(sphere(1), self.folder / 'near.ply')
        self.succeed('mesh', 'near.ply', '--shift', '500000,5400000,300', '-o', 'far.ply')
        refused = run('mesh', 'far.ply', '-o', 'mesh.stl', cwd=self.folder)
        self.assertEqual(refused.returncode, 1)
        self.assertIn('global shift', refused.stderr)
        result = self.succeed('mesh', 'far.ply', '--global-shift', 'auto', '-o', 'mesh.stl')
        self.assertIn('wrote mesh.stl, global shift 500000 5400000 300', result.stderr)
        for name in ('mesh.stl', 'far.ply'):
            self.succeed('mesh', name, '--shift=-500000,-5400000,-300', '-o', 'back.ply')
            again, near = (read(self.folder / name) for name in ('back.ply', 'near.ply'))
            self.assertEqual(again.GetNumberOfPoints(), near.GetNumberOfPoints())
            self.assertEqual(sorted(map(tuple, numpy.round(points_of(again), 5))),
                             sorted(map(tuple, numpy.round(points_of(near), 5))))

    def test_a_mirror_keeps_the_outside(self):
        write(sphere(), self.folder / 'in.ply')
        (self.folder / 'mirror.txt').write_text('-1,0,0,0\n0,1,0,0\n0,0,1,5\n0,0,0,1')
        self.succeed('mesh', 'in.ply', '--transform', 'mirror.txt', '-o', 'out.ply')
        self.assertAlmostEqual(self.info('out.ply')['volume'], self.info('in.ply')['volume'], 5)

    def test_simplify_keeps_its_bound(self):
        write(sphere(1, resolution=50), self.folder / 'in.ply')
        self.succeed('mesh', 'in.ply', '--simplify', 0.03, '-o', 'out.ply')
        self.succeed('compare', 'out.ply', 'in.ply', '--samples', 2000, '--json', 'figures.json')
        figures = json.loads((self.folder / 'figures.json').read_text())
        self.assertLess(self.info('out.ply')['triangles'], self.info('in.ply')['triangles'] / 2)
        for way in ('mesh_to_reference', 'reference_to_mesh'):
            self.assertLessEqual(figures[way]['greatest'], 0.03)

    def test_colours_come_from_photographs(self):
        scene = self.small_scene()
        write(sphere(0.1, (0, 0, 0.1)), self.folder / 'in.ply')
        result = run('mesh', 'in.ply', '--colour-from', scene, '--normals', '-o', 'out.ply', cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        data = read(self.folder / 'out.ply').GetPointData()
        self.assertEqual(data.GetScalars().GetNumberOfComponents(), 3)
        self.assertGreater(vtk_to_numpy(data.GetScalars()).std(), 1)
        self.assertIsNotNone(data.GetNormals())

    def test_what_is_left_must_be_something(self):
        write(sphere(), self.folder / 'in.ply')
        result = run('mesh', 'in.ply', '--crop', '5,6,5,6,5,6', '-o', 'out.ply', cwd=self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertIn('after --crop 5,6,5,6,5,6', result.stderr)
        self.assertFalse((self.folder / 'out.ply').exists())

    def info(self, name):
        return json.loads(self.succeed('info', name, '--json', '-').stdout)


class TestInfo(WithFolder):
    def info(self, path):
        return json.loads(self.succeed('-q', 'info', path, '--json', '-').stdout)

    def test_of_a_surface(self):
        write(sphere(1, resolution=30), self.folder / 'in.ply')
        info = self.info('in.ply')
        self.assertEqual(info['kind'], 'surface')
        self.assertEqual(info['triangles'], sphere(1, resolution=30).GetNumberOfPolys())
        self.assertTrue(info['closed'])
        self.assertEqual((info['components'], info['euler_characteristic']), (1, 2))
        self.assertAlmostEqual(info['volume'], 4 / 3 * math.pi, 1)
        self.assertIn('closed: yes', self.succeed('info', 'in.ply').stdout)

    def test_of_a_scene_tells_the_references(self):
        info = self.info(SCENE / 'scene.json')
        scene = json.loads((SCENE / 'scene.json').read_text())
        self.assertEqual(info['references'], sorted(cluster['reference'] for cluster in scene['clusters']))
        self.assertEqual((info['images'], info['photographs']), (30, 30))
        marked = [row['name'] for row in info['of_each_image'] if row['reference']]
        self.assertEqual(sorted(marked), info['references'])

    def test_of_a_model(self):
        (self.folder / 'model').mkdir()
        (self.folder / 'model' / 'cameras.txt').write_text('1 PINHOLE 640 480 500 500 320 240\n')
        (self.folder / 'model' / 'images.txt').write_text('1 1 0 0 0 0 0 0 1 a.jpg\n320 240 7\n'
                                                          '2 1 0 0 0 -1 0 0 1 b.jpg\n320 240 7\n')
        (self.folder / 'model' / 'points3D.txt').write_text('7 0 0 1 0 0 0 0.5 1 0 2 0\n')
        info = self.info('model')
        self.assertEqual((info['images'], info['points'], info['observations']), (2, 1, 2))
        self.assertEqual(info['images_of_a_point']['median'], 2)
        self.assertAlmostEqual(info['angles_in_degrees']['median'], 45, 9)  # from (0, 0, 0) and (1, 0, 0)
        self.assertEqual(info['errors_in_pixels']['greatest'], 0.5)
        self.assertEqual(info['of_each_image'][1]['centre'], [1, 0, 0])

    def test_of_features_maps_and_an_image(self):
        scene = self.small_scene()
        self.succeed('stereo', scene, '-o', 'features.vtm', '--every-image', 'off', '--refine-cameras', 'off', '--no-patches')
        self.succeed('triangulate', 'features.vtm', '-o', 'maps.vtm')
        info = self.info('features.vtm')
        self.assertEqual((info['kind'], info['views'], info['triangles']), ('features', 1, 0))
        self.assertEqual(info['features'], info['of_each_view'][0]['features'])
        self.assertLess(0, info['depths']['least'])
        self.assertLess(info['deviations_in_pixels']['greatest'], 5)
        self.assertEqual(self.info('maps.vtm')['kind'], 'disparity maps')
        self.assertGreater(self.info('maps.vtm')['triangles'], 100)
        image = self.info('images/cluster1_c.jpg')
        self.assertEqual((image['kind'], image['width'] > 100), ('image', True))

    def test_of_what_the_program_does_not_read(self):
        (self.folder / 'notes.txt').write_text('hello')
        for name in ('notes.txt', 'absent', 'absent.ply'):
            result = run('info', name, cwd=self.folder)
            self.assertEqual(result.returncode, 1)
            self.assertIn(name, result.stderr)


class TestExport(WithFolder):
    def test_features_chains_and_cameras(self):
        scene = self.small_scene()
        self.succeed('stereo', scene, '-o', 'features.vtm', '--every-image', 'off', '--refine-cameras', 'off', '--no-patches')
        for name in ('features.ply', 'features.csv', 'features.vtp'):
            self.succeed('export', 'features.vtm', '-o', name)
        block = read(next((self.folder / 'features').iterdir()))
        expected = points_of(block)
        rows = list(csv.DictReader((self.folder / 'features.csv').read_text().splitlines()))
        numpy.testing.assert_array_equal([[float(row[axis]) for axis in 'xyz'] for row in rows], expected)
        numpy.testing.assert_array_equal([[float(row['pixel_x']), float(row['pixel_y'])] for row in rows],
                                         vtk_to_numpy(block.GetPointData().GetArray('ImagePoint')))
        numpy.testing.assert_allclose([float(row['MatchingCost']) for row in rows],
                                      vtk_to_numpy(block.GetPointData().GetArray('MatchingCost')))
        numpy.testing.assert_array_equal(points_of(read(self.folder / 'features.vtp')), expected)
        cloud = read(self.folder / 'features.ply')
        numpy.testing.assert_allclose(points_of(cloud), expected, rtol=1e-6)
        numpy.testing.assert_array_equal(vtk_to_numpy(cloud.GetPointData().GetScalars()),
                                         vtk_to_numpy(block.GetPointData().GetArray('RGB')))
        for name in ('chains.vtp', 'chains.obj'):
            self.succeed('export', 'features.vtm', '--what', 'chains', '-o', name)
            self.assertEqual(read(self.folder / name).GetNumberOfLines(), block.GetNumberOfLines())

    def test_frusta_begin_at_the_cameras(self):
        info = json.loads(self.succeed('info', SCENE / 'scene.json', '--json', '-').stdout)
        for name in ('cameras.ply', 'cameras.vtp'):
            self.succeed('export', SCENE / 'scene.json', '-o', name)
            frusta = read(self.folder / name)
            self.assertEqual(frusta.GetNumberOfPolys(), 5 * 30)
            numpy.testing.assert_allclose(points_of(frusta)[::6], [row['centre'] for row in info['of_each_image']], rtol=1e-5,
                                          atol=1e-5)
        names = read(self.folder / 'cameras.vtp').GetFieldData().GetAbstractArray('Cameras')
        self.assertEqual([names.GetValue(i) for i in range(30)], [row['name'] for row in info['of_each_image']])

    def test_what_has_no_such_form_is_refused(self):
        for arguments, word in ((('absent.vtm', '-o', 'a.ply', '--what', 'chains'), 'a.ply'), (('absent.vtm', '-o', 'a.xyz'), 'a.xyz'),
                                (('absent.json', '-o', 'a.csv'), 'a.csv'), (('absent.vtm', '-o', 'a.csv'), 'absent.vtm')):
            result = run('export', *arguments, cwd=self.folder)
            self.assertEqual(result.returncode, 1)
            self.assertIn(word, result.stderr)


if __name__ == '__main__':
    unittest.main()
