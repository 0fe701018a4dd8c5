# SPDX-License-Identifier: BSD-3-Clause
"""While a filter works other Python threads go on, Ctrl-C is heard, and exceptions of observers are raised."""
import os
import signal
import subprocess
import sys
import threading
import time
import unittest

import numpy as np
from vtkmodules.vtkFiltersCore import vtkCutter
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkImagingHybrid import vtkSampleFunction

import freespace
from freespace import queries

SCENE = os.environ['FREESPACE_SCENE']
# What takes long, as a statement that says when it has begun.
BEGIN = '''
import sys, freespace
from freespace import queries
import numpy as np
scene = sys.argv[1]
said = []
def begin(*_):
    if not said:
        said.append(1)
        print('begun', flush=True)
def maps_of(n):
    K = np.array([[500., 0, 320], [0, 500, 240], [0, 0, 1]])
    x, y = np.meshgrid(np.linspace(-1, 1, n), np.linspace(-1, 1, n))
    points = np.column_stack([x.ravel(), y.ravel(), 4 + 0.1 * np.sin(9 * x.ravel()) ])
    pixels = points[:, :2] / points[:, 2:] * 500 + [320, 240]
    view = freespace.make_view(points, pixels, K, np.eye(3, 4), (640, 480))
    maps = freespace.vtkDelaunayDisparityFilter()
    maps.SetInputDataObject(freespace.make_views({'a': view}))
    return maps
def union_of(n):
    maps, phi = maps_of(n), freespace.vtkFreespaceUnion()
    phi.SetInputConnection(maps.GetOutputPort())
    return phi
'''
LONG = {
    'update of a reader': '''
stereo = freespace.vtkEdgeStereoReader(file_name=scene)
stereo.AddObserver('ProgressEvent', begin)
stereo.Update()
''',
    'update of a pipeline': '''
stereo = freespace.vtkEdgeStereoReader(file_name=scene)
stereo.AddObserver('ProgressEvent', begin)
support = freespace.vtkOutlierFilter()
support.SetInputConnection(stereo.GetOutputPort())
freespace.update(support)
''',
    'reconstruct': '''
begin()
freespace.reconstruct(scene)
''',
    'query': '''
phi = freespace.update(union_of(50))
phi.AddObserver('ProgressEvent', begin)
centers = np.random.default_rng(1).uniform(-1, 5, (20_000_000, 3))
queries.spheres_free(phi, centers, 0.1)
''',
    'contour': '''
contour = freespace.vtkBisectionContourFilter(cells=2000)
contour.SetImplicitFunction(union_of(50))
contour.AddObserver('ProgressEvent', begin)
contour.Update()
''',
    'an observer that works': '''
stereo = freespace.vtkEdgeStereoReader(file_name=scene)
def work(*_):
    begin()
    return sum(range(10 ** 5))
stereo.AddObserver('ProgressEvent', work)
stereo.Update()
'''}


def plane_maps():
    K = np.array([[500., 0, 320], [0, 500, 240], [0, 0, 1]])
    x, y = np.meshgrid(np.linspace(-1, 1, 8), np.linspace(-1, 1, 8))
    points = np.column_stack([x.ravel(), y.ravel(), 4 + 0 * x.ravel()])
    pixels = points[:, :2] / points[:, 2:] * 500 + [320, 240]
    maps = freespace.vtkDelaunayDisparityFilter()
    maps.SetInputDataObject(freespace.make_views(
        {'a': freespace.make_view(points, pixels, K, np.eye(3, 4), (640, 480))}))
    return maps


class TestThreads(unittest.TestCase):
    def test_other_threads_go_on(self):
        stereo = freespace.vtkEdgeStereoReader(file_name=SCENE)
        counted, is_done = [], threading.Event()

        def count():
            while not is_done.is_set():
                counted.append(1)
                time.sleep(0.001)
        counting = threading.Thread(target=count)
        # No observer of ours, and no Run: what is counted was counted while the filter worked.
        freespace._unlocked.update(plane_maps(), 0)
        counting.start()
        before = len(counted)
        freespace._unlocked.update(stereo, 0)
        during = len(counted) - before
        is_done.set()
        counting.join()
        self.assertGreater(during, 10)

    def test_several_threads_update(self):
        outputs = {}

        def work(i):
            maps = plane_maps()
            maps.AddObserver('ProgressEvent', lambda *_: sum(range(1000)))
            for _ in range(20):
                maps.Modified()
                outputs[i] = freespace.update(maps).GetNumberOfCells()
        threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(set(outputs), {0, 1, 2, 3})
        self.assertEqual(len(set(outputs.values())), 1)


class TestObservers(unittest.TestCase):
    def raising(self, algorithm, event='ProgressEvent'):
        def fail(*_):
            raise ValueError('the observer failed')
        return algorithm.AddObserver(event, fail)

    def test_exceptions_are_raised(self):
        for event in ('StartEvent', 'ProgressEvent', 'EndEvent'):
            for call in (freespace.update, lambda algorithm: algorithm.Update()):
                with self.subTest(event=event):
                    maps = plane_maps()
                    tag = self.raising(maps, event)
                    with self.assertRaisesRegex(ValueError, 'the observer failed'):
                        call(maps)
                    maps.RemoveObserver(tag)
                    maps.Modified()
                    call(maps)
                    self.assertGreater(maps.GetOutput().GetNumberOfCells(), 50)

    def test_of_what_is_upstream(self):
        maps = plane_maps()
        tag = self.raising(maps)
        phi = freespace.vtkFreespaceUnion()
        phi.SetInputConnection(maps.GetOutputPort())
        contour = freespace.vtkBisectionContourFilter(cells=20)
        contour.SetImplicitFunction(phi)
        for call in (lambda: freespace.update(contour), contour.Update, phi.Update,
                     lambda: queries.points_free(phi, [[0, 0, 1]])):
            with self.assertRaisesRegex(ValueError, 'the observer failed'):
                call()
        maps.RemoveObserver(tag)
        self.assertEqual(queries.points_free(phi, [[0, 0, 1]]).tolist(), [True])
        self.assertGreater(freespace.update(contour).GetNumberOfCells(), 0)

    def test_of_a_union_and_of_vtks_own_filters(self):
        maps, phi = plane_maps(), freespace.vtkFreespaceUnion()
        phi.SetInputConnection(maps.GetOutputPort())
        tag = self.raising(phi)
        cutter = vtkCutter()
        cutter.SetCutFunction(phi)
        sphere = vtkSphereSource()
        sphere.SetCenter(0, 0, 4)
        cutter.SetInputConnection(sphere.GetOutputPort())
        for call in (lambda: freespace.update(phi), lambda: freespace.update(cutter)):
            with self.assertRaisesRegex(ValueError, 'the observer failed'):
                call()
        phi.RemoveObserver(tag)
        self.raising(cutter)
        with self.assertRaisesRegex(ValueError, 'the observer failed'):
            freespace.update(cutter)

    def test_of_writers(self):
        writer = freespace.vtkViewBlocksWriter(file_name=os.devnull + '/nowhere.vtm')
        maps = plane_maps()
        writer.SetInputConnection(maps.GetOutputPort())
        self.raising(maps)
        with self.assertRaisesRegex(ValueError, 'the observer failed'):
            writer.Write()

    def test_excepthook_stays(self):
        before = sys.excepthook
        maps = plane_maps()
        self.raising(maps)
        with self.assertRaises(ValueError):
            maps.Update()
        self.assertIs(sys.excepthook, before)

    def test_an_observer_that_updates_another(self):
        outer, inner = plane_maps(), plane_maps()
        self.raising(inner)
        outer.AddObserver('StartEvent', lambda *_: inner.Update())
        with self.assertRaisesRegex(ValueError, 'the observer failed'):
            outer.Update()


class TestFailed(unittest.TestCase):
    def failing(self):
        stereo = freespace.vtkEdgeStereoReader(file_name='nowhere.json')
        maps = freespace.vtkDelaunayDisparityFilter()
        maps.SetInputConnection(stereo.GetOutputPort())
        phi = freespace.vtkFreespaceUnion()
        phi.SetInputConnection(maps.GetOutputPort())
        return stereo, maps, phi

    def test_each_time_anew(self):
        stereo, maps, phi = self.failing()
        sampled = vtkSampleFunction()
        sampled.SetImplicitFunction(phi)
        sampled.SetSampleDimensions(3, 3, 3)
        for _ in range(2):
            for last in (stereo, maps, phi, sampled):
                with self.assertRaisesRegex(freespace.Error, 'nowhere.json|not valid', msg=last.GetClassName()):
                    freespace.update(last)

    def test_queries(self):
        phi = self.failing()[2]
        point = np.zeros((1, 3))
        for _ in range(2):
            for ask in (lambda: queries.points_free(phi, point), lambda: queries.point_states(phi, point),
                        lambda: queries.first_blocked(phi, point, point), lambda: queries.spheres_free(phi, point, 1)):
                with self.assertRaises(freespace.Error):
                    ask()


class TestInterrupt(unittest.TestCase):
    def run_and_interrupt(self, what, after=0.3):
        """Seconds from SIGINT to the end, and what was written to the standard error."""
        child = subprocess.Popen([sys.executable, '-c', BEGIN + LONG[what] + "print('finished', flush=True)", SCENE],
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.assertEqual(child.stdout.readline(), 'begun\n')
        time.sleep(after)
        child.send_signal(signal.SIGINT)
        start = time.monotonic()
        out, err = child.communicate(timeout=120)
        self.assertNotIn('finished', out, 'it was too quick to be interrupted')
        return child.returncode, time.monotonic() - start, err

    def test_ends_by_keyboard_interrupt(self):
        for what in LONG:
            with self.subTest(what=what):
                code, seconds, err = self.run_and_interrupt(what)
                if os.environ.get('FREESPACE_SAY_SECONDS'):
                    print(f'{what}: {seconds:.2f} s')
                self.assertEqual(code, -signal.SIGINT)
                self.assertEqual(err.strip().splitlines()[-1], 'KeyboardInterrupt')
                self.assertNotIn('ERROR', err)
                self.assertLess(seconds, 20) # a half on an idle machine; a whole run takes longer


if __name__ == '__main__':
    unittest.main()
