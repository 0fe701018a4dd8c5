# SPDX-License-Identifier: BSD-3-Clause
"""What mpiexec shares out among processes is what a single process makes, byte for byte."""
import json
import os
import shlex
import shutil
import signal
import struct
import subprocess
import tempfile
import time
import unittest
import zlib
from pathlib import Path

SCENE = Path(__file__).resolve().parents[3] / 'Examples' / 'Data' / 'blocks'
PROGRAM = os.environ['FREESPACE_PROGRAM']
MPIEXEC = os.environ.get('FREESPACE_MPIEXEC', '')
# Open MPI starts as root, and more processes than there are cores, only when told so.
ALLOWED = {'OMPI_ALLOW_RUN_AS_ROOT': '1', 'OMPI_ALLOW_RUN_AS_ROOT_CONFIRM': '1',
           'OMPI_MCA_rmaps_base_oversubscribe': '1', 'PRTE_MCA_rmaps_default_mapping_policy': ':oversubscribe'}
ENVIRONMENT = {**os.environ, **ALLOWED}
FAST = ('--no-patches',) # half of the time, and nothing that is shared out differently


def run(*arguments):
    """One process, or several after mpiexec's own arguments."""
    return subprocess.run([*map(str, arguments)], capture_output=True, text=True, timeout=300, env=ENVIRONMENT)


def share(processes, *arguments):
    return run(MPIEXEC, '-n', processes, PROGRAM, '--threads', 1, *arguments)


def share_each(first, second):
    """Two processes with a command each. By a shell, since Debian 13's mpiexec crashes when it is given two programs."""
    commands = [shlex.join(map(str, command)) for command in (first, second)]
    return run(MPIEXEC, '-n', 2, 'sh', '-c', 'if [ "${OMPI_COMM_WORLD_RANK:-$PMI_RANK}" = 0 ]; then '
               f'exec {commands[0]}; else exec {commands[1]}; fi')


def contents(file):
    """Of a file of views, with the folder beside it."""
    pieces = sorted(file.with_suffix('').rglob('*')) if file.suffix == '.vtm' else []
    return [(piece.name, piece.read_bytes()) for piece in (file, *pieces)]


def white_png(width, height):
    def chunk(kind, data):
        return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))
    rows = zlib.compress((b'\0' + b'\xff' * width) * height)
    return (b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', width, height, 8, 0, 0, 0, 0)) +
            chunk(b'IDAT', rows) + chunk(b'IEND', b''))


@unittest.skipUnless(Path(MPIEXEC).is_file(), 'built without MPI, or mpiexec is not there')
class TestMpi(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix='freespace-test-'))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.scene = cls.write_scene('scene.json', SCENE / 'images')
        cls.features, cls.maps = cls.folder / 'features.vtm', cls.folder / 'maps.vtm'
        run(PROGRAM, 'stereo', cls.scene, *FAST, '-o', cls.features)
        run(PROGRAM, 'triangulate', cls.features, '-o', cls.maps)

    @classmethod
    def write_scene(cls, name, images, **also):
        scene = json.loads((SCENE / 'scene.json').read_text())
        scene.update(clusters=scene['clusters'][:1], images=str(images), model=str(SCENE / 'sparse'), **also)
        (cls.folder / name).write_text(json.dumps(scene))
        return cls.folder / name

    def expect_the_same(self, one, *arguments, processes=(2, 3)):
        """Whatever the number of processes, the output is that of one."""
        for count in processes:
            with self.subTest(arguments=arguments, processes=count):
                other = self.folder / f'of {count}' / one.name
                other.parent.mkdir(exist_ok=True)
                result = share(count, *arguments, '-o', other)
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertEqual(result.stderr.count('wrote '), 1, result.stderr)
                self.assertRegex(result.stderr, rf'{count} processes exchanged [\d.e+]+ MB')
                self.assertEqual(contents(other), contents(one))

    def test_features(self):
        self.expect_the_same(self.features, 'stereo', self.scene, *FAST)

    def test_maps(self):
        self.expect_the_same(self.maps, 'triangulate', self.features)

    def test_surfaces(self):
        for number, options in enumerate(((), ('--no-fit', '--no-sharp'), ('--no-fit', '--observed'))):
            one = self.folder / f'surface-{number}.ply'
            arguments = ('contour', self.maps, '--cells', 60, *options)
            self.assertEqual(run(PROGRAM, *arguments, '-o', one).returncode, 0)
            self.expect_the_same(one, *arguments, processes=(3,) if options else (2, 3))

    def test_all_stages(self):
        one = self.folder / 'whole.ply'
        arguments = ('reconstruct', self.scene, *FAST, '--cells', 60, '--no-fit')
        self.assertEqual(run(PROGRAM, *arguments, '-o', one).returncode, 0)
        self.expect_the_same(one, *arguments)

    def test_one_process_works_for_other_commands(self):
        result = share(3, 'info', self.maps)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout, run(PROGRAM, 'info', self.maps).stdout)

    def expect_one_sentence(self, result, words):
        self.assertNotEqual(result.returncode, 0)
        sentences = [line for line in result.stderr.splitlines() if line.startswith('freespace: ')]
        self.assertEqual(len(sentences), 1, result.stderr)
        self.assertIn(words, sentences[0])

    def expect_nothing(self, file):
        self.assertFalse(file.exists())
        self.assertFalse(file.with_suffix('').exists())

    def test_a_fault_of_all(self):
        mesh = self.folder / 'mesh.ply'
        self.expect_one_sentence(share(3, 'contour', self.folder / 'nothing.vtm', '-o', mesh), 'nothing.vtm')
        broken = self.scene_with_a_broken_image('broken.json')
        self.expect_one_sentence(share(3, 'reconstruct', broken, *FAST, '-o', mesh), 'broken')
        self.expect_nothing(mesh)

    def test_a_fault_of_the_writing_process(self):
        self.expect_one_sentence(share(3, 'contour', self.maps, '-o', self.folder / 'no' / 'mesh.ply'), 'mesh.ply')

    def expect_one_fault(self, command, good, bad, output, words):
        """Of two processes, one has an input that is broken: both end soon."""
        one = (PROGRAM, '-q', '--threads', 1, command)
        for inputs in ((good, bad), (bad, good)):
            with self.subTest(command=command, first=inputs[0].name):
                began = time.monotonic()
                result = share_each(*((*one, each, '-o', output) for each in inputs))
                self.expect_one_sentence(result, words)
                self.assertLess(time.monotonic() - began, 60)
                self.expect_nothing(output)

    def scene_with_a_broken_image(self, name):
        images = self.folder / 'broken'
        if not images.exists():
            shutil.copytree(SCENE / 'images', images)
            reference = json.loads(self.scene.read_text())['clusters'][0]['reference']
            (images / reference).write_bytes(b'no image')
        return self.write_scene(name, images)

    def test_a_fault_of_one_process(self):
        self.expect_one_fault('contour', self.maps, self.folder / 'lost.vtm', self.folder / 'never.ply', 'lost.vtm')
        self.expect_one_fault('triangulate', self.features, self.folder / 'lost.vtm', self.folder / 'never.vtm',
                              'lost.vtm')
        self.expect_one_fault('stereo', self.scene, self.scene_with_a_broken_image('one.json'),
                              self.folder / 'never.vtm', 'broken')

    def test_processes_with_different_options(self):
        """They would wait for each other for ever."""
        output = self.folder / 'never.vtm'
        one = (PROGRAM, '--threads', 1, 'stereo', self.scene, *FAST, '-o', output)
        self.expect_one_sentence(
            share_each(one, (*one, '--every-image', 'off')), 'different files or options')
        self.expect_nothing(output)

    def test_a_warning_of_another_process(self):
        """Is told by the first one; with --strict nothing is written."""
        masks = self.folder / 'masks'
        masks.mkdir()
        (masks / 'cluster1_c.jpg.png').write_bytes(white_png(1134, 756)) # the other images have no mask
        warning = self.write_scene('masks.json', SCENE / 'images', masks=str(masks))
        output = self.folder / 'warned.vtm'

        def share_with_warning(*options):
            one = (PROGRAM, '--threads', 1, *options, 'stereo', '--refine-cameras', 'off', *FAST, '-o', output)
            return share_each((*one, self.scene), (*one, warning))

        self.expect_one_sentence(share_with_warning('-q', '--strict'), 'have no mask')
        self.expect_nothing(output)
        result = share_with_warning()
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr.count('freespace: warning: '), 1, result.stderr)
        self.assertIn('have no mask', result.stderr)

    def test_a_request_to_stop(self):
        mesh = self.folder / 'stopped.ply'
        process = subprocess.Popen(
            [MPIEXEC, '-n', '2', PROGRAM, '--threads', '1', 'reconstruct', self.scene, '-o', mesh],
            stderr=subprocess.PIPE, text=True, env=ENVIRONMENT)
        while 'stereo' not in process.stderr.readline():
            self.assertIsNone(process.poll())
        process.send_signal(signal.SIGTERM)
        words = process.communicate(timeout=60)[1]
        self.assertNotEqual(process.returncode, 0)
        # From Open MPI 5 on mpiexec drops what processes say while it ends them.
        told = (1,) if 'OpenRTE' in run(MPIEXEC, '--version').stdout else (0, 1)
        self.assertIn(words.count('Stopped on request.'), told, words)
        self.expect_nothing(mesh)


if __name__ == '__main__':
    unittest.main()
