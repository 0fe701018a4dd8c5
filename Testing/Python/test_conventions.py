# SPDX-License-Identifier: BSD-3-Clause
"""What VTK's own readers, writers and filters do: error codes, names that are null, both composite types, pieces."""
import os
import tempfile
import unittest

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkPartitionedDataSet, vtkPartitionedDataSetCollection, \
    vtkPolyData
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOCore import vtkWriter

import freespace
from freespace import queries

# vtkErrorCode
NO_ERROR, FILE_NOT_FOUND, CANNOT_OPEN, FILE_FORMAT, NO_FILE_NAME, OUT_OF_SPACE = 0, 20001, 20002, 20005, 20006, 20007
USER_ERROR = 40000
READERS = ('vtkCameraReader', 'vtkDepthMapReader', 'vtkEdgeStereoReader', 'vtkPhotographReader', 'vtkSparseModelReader', 'vtkSurfaceReader',
           'vtkViewBlocksReader')
WRITERS = ('vtkOccupancyMapWriter', 'vtkSparseModelWriter', 'vtkSurfaceWriter', 'vtkTexturedSurfaceWriter',
           'vtkViewBlocksWriter')


def plane_view(z=4.0, shift=0.0, n=8):
    K = np.array([[500., 0, 320], [0, 500, 240], [0, 0, 1]])
    x, y = np.meshgrid(np.linspace(-1, 1, n), np.linspace(-1, 1, n))
    points = np.column_stack([x.ravel() + shift, y.ravel(), z + 0 * x.ravel()])
    pixels = points[:, :2] / points[:, 2:] * 500 + [320, 240]
    return freespace.make_view(points, pixels, K, np.eye(3, 4), (640, 480))


def collection_of(views):
    """The same views as a vtkPartitionedDataSetCollection; a list of blocks is a view of several partitions."""
    collection = vtkPartitionedDataSetCollection()
    for i, (name, blocks) in enumerate(views.items()):
        parts = vtkPartitionedDataSet()
        for k, block in enumerate(blocks if isinstance(blocks, list) else [blocks]):
            parts.SetPartition(k, block)
        collection.SetPartitionedDataSet(i, parts)
        collection.GetMetaData(i).Set(vtkCompositeDataSet.NAME(), name)
    return collection


def failing(algorithm, method='Update'):
    """The error that it reports."""
    errors = []

    def note(caller, event, text):
        errors.append(text)
    note.CallDataType = 'string0'
    tag = algorithm.AddObserver('ErrorEvent', note)
    executive = algorithm.GetExecutive().AddObserver('ErrorEvent', lambda *_: None)
    result = getattr(algorithm, method)()
    algorithm.RemoveObserver(tag)
    algorithm.GetExecutive().RemoveObserver(executive)
    return errors[0].strip().splitlines()[-1] if errors else '', result


class TestErrorCodes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name, content=None):
        path = os.path.join(self.folder, name)
        if content is not None:
            with open(path, 'w') as file:
                file.write(content)
        return path

    def test_readers(self):
        bad = {'vtkSurfaceReader': self.path('bad.ply', 'hello'), 'vtkViewBlocksReader': self.path('bad.vtm', 'hello'),
               'vtkSparseModelReader': self.path('bad.nvm', 'hello')}
        for name in READERS:
            with self.subTest(name=name):
                reader = getattr(freespace, name)()
                for value, wanted in ((self.path('absent.json'), FILE_NOT_FOUND),
                                      (bad.get(name, self.path('bad.json', 'hello')), FILE_FORMAT),
                                      ('', NO_FILE_NAME), (None, NO_FILE_NAME)):
                    reader.SetFileName(value)
                    self.assertNotEqual(failing(reader)[0], '', value)
                    self.assertEqual(reader.GetErrorCode(), wanted, value)
                    self.assertEqual(reader.GetOutputDataObject(0).GetNumberOfCells(), 0)

    def test_a_calibration(self):
        board = freespace.vtkBoardCalibration()
        board.SetBoard('chessboard:9x6:0.025')
        for value, wanted in ((None, NO_FILE_NAME), (self.path('absent.png'), FILE_NOT_FOUND),
                              (self.path('bad.png', 'hello'), FILE_FORMAT)):
            board.ClearFileNames()
            if value:
                board.AddFileName(value)
            self.assertNotEqual(failing(board)[0], '', value)
            self.assertEqual(board.GetErrorCode(), wanted, value)

    def test_filters(self):
        sphere = vtkSphereSource()
        sphere.Update()
        sphere = sphere.GetOutput()
        views = freespace.make_views({'a': plane_view()})
        maps = freespace.vtkDelaunayDisparityFilter()
        maps.SetInputDataObject(views)
        maps = freespace.update(maps)
        point = vtkPolyData()
        # Each with its inputs, a setting that it refuses and one that it takes.
        cases = (('vtkDelaunayDisparityFilter', [views], 'Tolerance', -1, 0),
                 ('vtkOutlierFilter', [views], 'Support', -1, 2),
                 ('vtkFreespaceSurfaceFilter', [maps], 'Cells', -5, 16),
                 ('vtkFitSurfaceFilter', [sphere, maps], 'Rounds', -1, 0),
                 ('vtkSimplifySurfaceFilter', [sphere], 'Distance', -1, 0.1),
                 ('vtkSurfaceComparison', [sphere, sphere], 'Bins', -1, 8),
                 ('vtkSurfacePicture', [sphere], 'Zoom', -1, 1))
        for name, inputs, setting, bad, good in cases:
            with self.subTest(name=name):
                algorithm = getattr(freespace, name)()
                for port, data in enumerate(inputs):
                    algorithm.SetInputDataObject(port, data)
                getattr(algorithm, f'Set{setting}')(bad)
                for _ in range(2):
                    self.assertNotEqual(failing(algorithm)[0], '')
                    self.assertEqual(algorithm.GetErrorCode(), USER_ERROR)
                getattr(algorithm, f'Set{setting}')(good)
                algorithm.Update()
                self.assertEqual(algorithm.GetErrorCode(), NO_ERROR)
        # Those without a setting to refuse.
        contour = freespace.vtkBisectionContourFilter()
        baker = freespace.vtkTextureBaker()
        baker.SetInputDataObject(point)
        merged = freespace.vtkMergeViewsFilter()
        merged.SetInputDataObject(collection_of({'a': []}))
        pieces = freespace.vtkAppendPiecesFilter()
        pieces.AddInputDataObject(sphere)
        pieces.AddInputDataObject(sphere)
        for algorithm in (contour, baker, merged, pieces):
            with self.subTest(name=algorithm.GetClassName()):
                self.assertNotEqual(failing(algorithm)[0], '')
                self.assertEqual(algorithm.GetErrorCode(), USER_ERROR)

    def test_a_reader_that_succeeds_again(self):
        reader = freespace.vtkSurfaceReader(file_name=self.path('absent.ply'))
        failing(reader)
        writer = freespace.vtkSurfaceWriter(file_name=self.path('mesh.ply'))
        sphere = vtkSphereSource()
        writer.SetInputConnection(sphere.GetOutputPort())
        self.assertEqual(writer.Write(), 1)
        self.assertEqual(writer.GetErrorCode(), NO_ERROR)
        reader.SetFileName(self.path('mesh.ply'))
        reader.Update()
        self.assertEqual(reader.GetErrorCode(), NO_ERROR)
        self.assertGreater(reader.GetOutput().GetNumberOfCells(), 0)

    def test_writers(self):
        endings = {'vtkOccupancyMapWriter': '.bt', 'vtkSurfaceWriter': '.ply', 'vtkTexturedSurfaceWriter': '.ply',
                   'vtkViewBlocksWriter': '.vtm', 'vtkSparseModelWriter': ''}
        maps = freespace.vtkDelaunayDisparityFilter()
        maps.SetInputDataObject(freespace.make_views({'a': plane_view()}))
        sphere = vtkSphereSource()
        for name in WRITERS:
            with self.subTest(name=name):
                writer = getattr(freespace, name)()
                self.assertIsInstance(writer, vtkWriter)
                source = sphere if 'Surface' in name else maps
                writer.SetInputConnection(source.GetOutputPort())
                for value, wanted in ((os.devnull + '/out' + endings[name], CANNOT_OPEN), ('', NO_FILE_NAME),
                                      (None, NO_FILE_NAME)):
                    writer.SetFileName(value)
                    error, result = failing(writer, 'Write')
                    self.assertNotEqual(error, '')
                    self.assertEqual(result, 0)
                    self.assertEqual(writer.GetErrorCode(), wanted, value)
        self.assertEqual(os.listdir(self.folder), [])

    @unittest.skipUnless(os.path.exists('/dev/full'), 'no /dev/full')
    def test_a_full_disk(self):
        writer = freespace.vtkSurfaceWriter(file_name=self.path('mesh.ply'))
        sphere = vtkSphereSource()
        writer.SetInputConnection(sphere.GetOutputPort())
        import resource
        import signal
        before = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        limits = resource.getrlimit(resource.RLIMIT_FSIZE)
        try:
            resource.setrlimit(resource.RLIMIT_FSIZE, (100, limits[1]))
            result = failing(writer, 'Write')[1]
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, limits)
            signal.signal(signal.SIGXFSZ, before)
        self.assertEqual(result, 0)
        self.assertEqual(writer.GetErrorCode(), OUT_OF_SPACE)
        self.assertEqual(os.listdir(self.folder), [])

    def test_null_folders(self):
        overlay = freespace.vtkFeatureOverlayWriter()
        overlay.SetImagesFolder(None)
        overlay.SetOutputFolder(None)
        proposal = freespace.vtkClusterProposal()
        for setter in ('SetFileName', 'SetModel', 'SetImages'):
            getattr(proposal, setter)(None)
        overlay.SetInputDataObject(freespace.make_views({'a': plane_view()}))
        self.assertRegex(failing(overlay, 'Write')[0], 'folder has no name')
        self.assertEqual(overlay.GetErrorCode(), NO_FILE_NAME)
        self.assertEqual((overlay.GetImagesFolder(), overlay.GetOutputFolder(), proposal.GetModel()), ('', '', ''))


class TestSettings(unittest.TestCase):
    def test_numbers_are_kept_as_they_are_given(self):
        """What is out of range is an error of the update, not another number; modes alone are clamped, as in VTK."""
        modes = {'EveryImage', 'RefineCameras', 'RegionMode'}
        count = 0
        for module in (freespace.vtkFreespaceFilters, freespace.vtkFreespaceReaders, freespace.vtkFreespaceSurface,
                       freespace.vtkFreespaceWriters):
            for name in (it for it in dir(module) if it.startswith('vtk')):
                thing = getattr(module, name)()
                own = {it[3:] for it in dir(type(thing)) if it.startswith('Set')} - \
                    {it[3:] for it in dir(type(thing).__mro__[1]) if it.startswith('Set')}
                for setting in sorted(own - modes):
                    if isinstance(getattr(thing, 'Get' + setting, lambda: None)(), (int, float)):
                        with self.subTest(name=name, setting=setting):
                            getattr(thing, 'Set' + setting)(-7)
                            self.assertEqual(getattr(thing, 'Get' + setting)(), -7)
                            count += 1
        self.assertGreater(count, 60)

    def test_modes_are_clamped(self):
        for thing, mode, most in ((freespace.vtkEdgeStereoReader(), 'EveryImage', 2),
                                  (freespace.vtkEdgeStereoReader(), 'RefineCameras', 2),
                                  (freespace.vtkFreespaceUnion(), 'RegionMode', 2),
                                  (freespace.vtkOccupancyMapWriter(), 'RegionMode', 2)):
            for given, kept in ((-1, 0), (9, most)):
                getattr(thing, 'Set' + mode)(given)
                self.assertEqual(getattr(thing, 'Get' + mode)(), kept)

    def test_file_names_are_paths(self):
        from pathlib import Path
        for name in READERS + WRITERS:
            thing = getattr(freespace, name)()
            self.assertEqual(thing.GetFileName(), '')
            thing.SetFileName(Path('folder') / 'file')
            self.assertEqual(thing.GetFileName(), os.path.join('folder', 'file'))
            time = thing.GetMTime()
            thing.SetFileName('folder/file')
            self.assertEqual(thing.GetMTime(), time)
            thing.SetFileName(None)
            self.assertEqual(thing.GetFileName(), '')
            self.assertGreater(thing.GetMTime(), time)


class TestRepeatedTriangles(unittest.TestCase):
    """A surface file with a triangle many times gives it once, and quickly."""

    def read(self, triangles):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, 'a.ply')
            with open(file, 'w') as ply:
                ply.write('ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n'
                          'property uchar red\nproperty uchar green\nproperty uchar blue\n'
                          f'element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n'
                          '0 0 0 1 1 1\n1 0 0 2 2 2\n0 1 0 3 3 3\n0 0 1 4 4 4\n9 9 9 5 5 5\n')
                ply.writelines(f'3 {a} {b} {c}\n' for a, b, c in triangles)
            return freespace.update(freespace.vtkSurfaceReader(file_name=file))

    def test_each_is_there_once(self):
        surface = self.read([(0, 1, 2), (1, 2, 0), (0, 1, 3), (2, 0, 1), (0, 2, 1), (0, 1, 3)])
        self.assertEqual(freespace.surface_arrays(surface)[1].tolist(), [[0, 1, 2], [0, 1, 3], [0, 2, 1]])
        colors = surface.GetPointData().GetScalars()
        self.assertEqual([colors.GetTuple(i)[0] for i in range(4)], [1, 2, 3, 4])

    def test_a_surface_without_any_stays_as_it_is(self):
        surface = self.read([(1, 2, 0), (3, 0, 1)])
        self.assertEqual(freespace.surface_arrays(surface)[1].tolist(), [[1, 2, 0], [3, 0, 1]])
        self.assertEqual(surface.GetNumberOfPoints(), 5)

    def test_many(self):
        self.assertEqual(self.read([(0, 1, 2)] * 200000).GetNumberOfCells(), 1)


class TestCollections(unittest.TestCase):
    """A vtkPartitionedDataSetCollection does wherever a vtkMultiBlockDataSet does."""

    views = {'a': plane_view(), 'b': plane_view(4.2, 0.1)}

    def outputs(self, views):
        support = freespace.vtkOutlierFilter()
        support.SetInputDataObject(views)
        maps = freespace.vtkDelaunayDisparityFilter()
        maps.SetInputDataObject(views)
        merged = freespace.vtkMergeViewsFilter()
        merged.SetInputDataObject(views)
        return [freespace.update(it) for it in (support, maps, merged)]

    def test_filters_of_features(self):
        for one, other in zip(self.outputs(freespace.make_views(self.views)), self.outputs(collection_of(self.views))):
            one, other = freespace.views(one), freespace.views(other)
            self.assertEqual(list(one), list(other))
            for name in one:
                np.testing.assert_array_equal(one[name]['points'], other[name]['points'])
                np.testing.assert_array_equal(one[name]['triangles'], other[name]['triangles'])

    def test_what_takes_maps(self):
        maps = self.outputs(freespace.make_views(self.views))[1]
        collection = collection_of({'a': maps.GetBlock(0), 'b': maps.GetBlock(1)})
        surfaces, states, files = [], [], []
        at = np.random.default_rng(1).uniform(-1, 6, (500, 3))
        for data in (maps, collection):
            surface = freespace.vtkFreespaceSurfaceFilter(cells=16)
            surface.SetInputDataObject(data)
            surfaces.append(freespace.surface_arrays(freespace.update(surface))[0])
            phi = freespace.vtkFreespaceUnion()
            phi.SetInputDataObject(data)
            states.append(queries.point_states(phi, at))
            with tempfile.TemporaryDirectory() as folder:
                for writer, name in ((freespace.vtkOccupancyMapWriter(resolution=0.2), 'map.bt'),
                                     (freespace.vtkViewBlocksWriter(), 'maps.vtm')):
                    writer.SetFileName(os.path.join(folder, name))
                    writer.SetInputDataObject(data)
                    freespace.update(writer)
                    with open(os.path.join(folder, name), 'rb') as file:
                        files.append(file.read())
        np.testing.assert_array_equal(*surfaces)
        np.testing.assert_array_equal(*states)
        self.assertEqual(set(states[0].tolist()), {queries.MATTER, queries.FREE, queries.UNKNOWN})
        self.assertEqual(files[:2], files[2:])

    def test_a_connection_of_a_union(self):
        from vtkmodules.vtkCommonExecutionModel import vtkTrivialProducer
        producer = vtkTrivialProducer()
        maps = self.outputs(freespace.make_views(self.views))[1]
        producer.SetOutput(collection_of({'a': maps.GetBlock(0), 'b': maps.GetBlock(1)}))
        phi = freespace.vtkFreespaceUnion()
        phi.SetInputConnection(producer.GetOutputPort())
        self.assertTrue(freespace.update(phi).IsValid())

    def test_a_view_of_two_partitions_is_an_error(self):
        maps = freespace.vtkDelaunayDisparityFilter()
        maps.SetInputDataObject(collection_of({'a': [plane_view(), plane_view()]}))
        with self.assertRaisesRegex(freespace.Error, '2 partitions'):
            freespace.update(maps)

    def test_a_view_without_data_is_an_error(self):
        maps = freespace.vtkDelaunayDisparityFilter()
        maps.SetInputDataObject(collection_of({'a': []}))
        with self.assertRaises(freespace.Error):
            freespace.update(maps)


class TestPieces(unittest.TestCase):
    def contour(self):
        maps = freespace.vtkDelaunayDisparityFilter()
        maps.SetInputDataObject(freespace.make_views({'a': plane_view()}))
        phi = freespace.vtkFreespaceUnion()
        phi.SetMaps(freespace.update(maps))
        contour = freespace.vtkBisectionContourFilter(cells=40)
        contour.SetImplicitFunction(phi)
        return contour

    def pieces(self, count):
        contour, pieces = self.contour(), []
        for i in range(count):
            contour.UpdatePiece(i, count, 0)
            pieces.append(vtkPolyData())
            pieces[-1].ShallowCopy(contour.GetOutput())
        return [piece for piece in pieces if piece.GetNumberOfCells()]

    def append(self, pieces):
        append = freespace.vtkAppendPiecesFilter()
        for piece in pieces:
            append.AddInputDataObject(piece)
        return freespace.update(append)

    def test_a_piece_given_twice_is_an_error(self):
        pieces = self.pieces(4)
        self.assertGreater(len(pieces), 2)
        self.assertEqual(self.append(pieces).GetNumberOfCells(), sum(piece.GetNumberOfCells() for piece in pieces))
        copy = vtkPolyData()
        copy.DeepCopy(pieces[1])
        for again in (pieces[1], copy):
            with self.assertRaisesRegex(freespace.Error, r'Piece \d is given twice: it is the same as piece 1'):
                self.append(pieces + [again])

    def test_ghost_levels_are_refused(self):
        contour = self.contour()
        surface = freespace.vtkFreespaceSurfaceFilter(cells=40)
        surface.SetInputDataObject(contour.GetImplicitFunction().GetMaps())
        for filter in (contour, surface):
            errors = []
            tags = [(it, it.AddObserver('ErrorEvent', lambda *_: errors.append(1))) for it in (filter, filter.GetExecutive())]
            filter.UpdatePiece(0, 2, 1)
            self.assertGreater(len(errors), 0)
            self.assertEqual(filter.GetOutput().GetNumberOfCells(), 0)
            del errors[:]
            filter.UpdatePiece(0, 1, 1) # the whole has no neighbours
            self.assertEqual(errors, [])
            self.assertGreater(filter.GetOutput().GetNumberOfCells(), 0)
            for it, tag in tags:
                it.RemoveObserver(tag)


if __name__ == '__main__':
    unittest.main()
