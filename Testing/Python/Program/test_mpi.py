# SPDX-License-Identifier: BSD-3-Clause
"""A contour that mpiexec shares out among processes is the one of a single process, byte for byte."""
import json
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

SCENE = Path(__file__).resolve().parents[3] / 'Examples' / 'Data' / 'blocks'
PROGRAM = os.environ['FREESPACE_PROGRAM']
MPIEXEC = os.environ.get('FREESPACE_MPIEXEC', '')
# Open MPI starts as root, and more processes than there are cores, only when told so.
ALLOWED = {'OMPI_ALLOW_RUN_AS_ROOT': '1', 'OMPI_ALLOW_RUN_AS_ROOT_CONFIRM': '1',
           'OMPI_MCA_rmaps_base_oversubscribe': '1'}


def run(*arguments):
    """One process, or several after mpiexec's own arguments."""
    return subprocess.run([*map(str, arguments)], capture_output=True, text=True, timeout=300,
                          env={**os.environ, **ALLOWED})


@unittest.skipUnless(Path(MPIEXEC).is_file(), 'built without MPI, or mpiexec is not there')
class TestMpi(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix='freespace-test-'))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.maps = cls.folder / 'maps.vtm'
        scene = json.loads((SCENE / 'scene.json').read_text())
        scene.update(clusters=scene['clusters'][:1], images=str(SCENE / 'images'), model=str(SCENE / 'sparse'))
        (cls.folder / 'scene.json').write_text(json.dumps(scene))
        run(PROGRAM, 'stereo', cls.folder / 'scene.json', '-o', cls.folder / 'features.vtm')
        run(PROGRAM, 'triangulate', cls.folder / 'features.vtm', '-o', cls.maps)

    def test_the_same_file(self):
        one, three = self.folder / 'one.ply', self.folder / 'three.ply'
        for options in ((), ('--no-sharp',), ('--observed',)):
            with self.subTest(options=options):
                arguments = ('contour', self.maps, '--cells', 100, *options, '-o')
                self.assertEqual(run(PROGRAM, *arguments, one).returncode, 0)
                result = run(MPIEXEC, '-n', 3, PROGRAM, *arguments, three)
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertEqual(result.stderr.count('wrote '), 1, result.stderr)
                self.assertEqual(three.read_bytes(), one.read_bytes())

    def test_one_process_works_for_other_commands(self):
        result = run(MPIEXEC, '-n', 3, PROGRAM, 'triangulate', self.folder / 'features.vtm', '-o',
                     self.folder / 'again.vtm')
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr.count('wrote '), 1, result.stderr)

    def expect_one_sentence(self, result, words):
        self.assertNotEqual(result.returncode, 0)
        sentences = [line for line in result.stderr.splitlines() if line.startswith('freespace: ')]
        self.assertEqual(len(sentences), 1, result.stderr)
        self.assertIn(words, sentences[0])

    def test_a_fault_of_all(self):
        self.expect_one_sentence(run(MPIEXEC, '-n', 3, PROGRAM, 'contour', self.folder / 'nothing.vtm',
                                     '-o', self.folder / 'mesh.ply'), 'nothing.vtm')

    def test_a_fault_of_the_writing_process(self):
        self.expect_one_sentence(run(MPIEXEC, '-n', 3, PROGRAM, 'contour', self.maps,
                                     '-o', self.folder / 'no' / 'mesh.ply'), 'mesh.ply')

    def test_a_fault_of_another_process(self):
        mesh = self.folder / 'never.ply'
        self.expect_one_sentence(
            run(MPIEXEC, '-n', 1, PROGRAM, '-q', 'contour', self.maps, '-o', mesh, ':',
                '-n', 2, PROGRAM, '-q', 'contour', self.folder / 'lost.vtm', '-o', mesh), 'lost.vtm')
        self.assertFalse(mesh.exists())


if __name__ == '__main__':
    unittest.main()
