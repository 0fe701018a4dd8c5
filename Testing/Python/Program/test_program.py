# SPDX-License-Identifier: BSD-3-Clause
"""The batch program: its stages, its options, and one sentence for every bad input."""
import json
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
PROGRAM = os.environ['FREESPACE_PROGRAM']
SCENE = ROOT / 'Examples' / 'Data' / 'blocks'
COMMANDS = ('reconstruct', 'sparse', 'calibrate', 'clusters', 'stereo', 'triangulate', 'contour', 'query', 'render',
            'texture', 'occupancy', 'view', 'report', 'refine', 'depth', 'compare', 'mesh',
            'info', 'export', 'run')


def run(*arguments, cwd=None):
    return subprocess.run([PROGRAM, *map(str, arguments)], cwd=cwd, capture_output=True, text=True, timeout=300)


class WithFolder(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix='freespace-test-'))
        self.addCleanup(shutil.rmtree, self.folder)

    def succeed(self, *arguments):
        result = run(*arguments, cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def small_scene(self, **changes):
        """A scene of one cluster, in a folder of its own that tests may damage."""
        scene = json.loads((SCENE / 'scene.json').read_text())
        scene['clusters'] = scene['clusters'][:1]
        scene.update(changes)
        for name in ('images', 'sparse'):
            shutil.copytree(SCENE / name, self.folder / name)
        for image in (self.folder / 'images').iterdir():
            if not image.name.startswith('cluster1'):
                image.unlink()
        path = self.folder / 'scene.json'
        path.write_text(json.dumps(scene))
        return path


class TestUsage(unittest.TestCase):
    def test_version(self):
        self.assertRegex(run('--version').stdout, r'freespace \d+\.\d+\.\d+')

    def test_only_what_a_command_needs_is_loaded(self):
        loaded = subprocess.run([PROGRAM, '--version'], capture_output=True, text=True, timeout=60,
                                env={**os.environ, 'LD_DEBUG': 'files'}).stderr
        self.assertIn('libvtkCommonCore', loaded)
        self.assertNotIn('libopencv_imgcodecs', loaded)
        self.assertNotIn('libOSMesa', loaded)

    def test_each_command_has_help_with_an_example(self):
        for command in COMMANDS:
            with self.subTest(command=command):
                result = run(command, '--help')
                self.assertEqual(result.returncode, 0)
                self.assertIn(f'freespace {command} ', result.stdout.split('Example')[-1])

    def test_help_has_lines_of_80_columns_and_the_shared_options(self):
        for command in ([], *([command] for command in COMMANDS)):
            with self.subTest(command=command):
                text = run(*command, '--help').stdout
                self.assertLessEqual(max(map(len, text.splitlines())), 80)
                for option in ('--threads', '--quiet', '--config', '--save-config'):
                    self.assertIn(option, text)

    def test_unknown_command_is_an_error_with_help_too(self):
        for arguments in (('no-such-command', '--help'), ('--help', 'no-such-command')):
            result = run(*arguments)
            self.assertEqual(result.returncode, 2)
            self.assertEqual(result.stdout, '')
            self.assertIn("no command 'no-such-command'", result.stderr)

    def test_an_error_is_one_line_whatever_the_name(self):
        result = run('stereo', 'a\nb\x1b[31m.json', '-o', 'x.vtm')
        self.assertEqual(result.returncode, 1)
        self.assertEqual(result.stderr.count('\n'), 1)
        self.assertIn('a\\nb\\x1b[31m.json', result.stderr)

    def test_did_you_mean(self):
        for arguments, meant in ((('contuor', 'maps.vtm'), "'contour'"),
                                 (('contour', 'maps.vtm', '-o', 'x.ply', '--cels=3'), "'--cells'"),
                                 (('stereo', 'scene.json', '--thread', '2'), "'--threads'"),
                                 (('reconstruct', 'scene.json', '--pictrue', 'x.png'), "'--picture'")):
            with self.subTest(arguments=arguments):
                result = run(*arguments)
                self.assertEqual(result.returncode, 2)
                self.assertIn(f'did you mean {meant}?', result.stderr)

    def test_man_pages_and_completion(self):
        folder = Path(tempfile.mkdtemp(prefix='freespace-test-'))
        self.addCleanup(shutil.rmtree, folder)
        self.assertEqual(run('--write-documentation', folder).returncode, 0)
        for command in COMMANDS:
            page = folder / 'man' / 'man1' / f'freespace-{command}.1'
            self.assertIn(f'freespace\\-{command} \\- ', page.read_text())
            self.assertIn('\\-\\-threads', page.read_text())
            if shutil.which('man'):
                shown = subprocess.run(['man', '--warnings', '-l', page], capture_output=True, text=True)
                self.assertEqual((shown.returncode, shown.stderr), (0, ''))
        script = folder / 'bash-completion' / 'completions' / 'freespace'
        for typed, offered in (('freespace cont', ['contour']), ('freespace -q contour maps.vtm --cel', ['--cells']),
                               ('freespace stereo --thr', ['--threads'])):
            words = typed.split()
            asked = subprocess.run(
                ['bash', '-c', f'. {script}; COMP_WORDS=({typed}); COMP_CWORD={len(words) - 1}; _freespace; '
                               'echo "${COMPREPLY[@]}"'], capture_output=True, text=True)
            self.assertEqual(asked.stdout.split(), offered, asked.stderr)
        if shutil.which('zsh'):
            zsh = folder / 'zsh' / 'vendor-completions' / '_freespace'
            checked = subprocess.run(['zsh', '-n', zsh], capture_output=True, text=True)
            self.assertEqual((checked.returncode, checked.stderr), (0, ''))

    def test_no_command_and_unknown_option(self):
        for arguments in ((), ('stereo', '--no-such-option'), ('no-such-command',)):
            with self.subTest(arguments=arguments):
                result = run(*arguments)
                self.assertLess(len(result.stderr), 300)
                self.assertNotEqual(result.returncode, 0)
                self.assertTrue(result.stderr.startswith('freespace: '), result.stderr)


class TestStages(WithFolder):
    def test_stages_alone_are_the_whole(self):
        scene = self.small_scene()
        self.succeed('stereo', scene, '-o', 'features.vtm')
        self.succeed('triangulate', 'features.vtm', '-o', 'maps.vtm')
        self.succeed('contour', 'maps.vtm', '-o', 'stages.ply', '--cells', 48)
        self.succeed('reconstruct', scene, '-o', 'whole.ply', '--cells', 48, '--picture', 'whole.png')
        self.assertEqual((self.folder / 'stages.ply').read_bytes(), (self.folder / 'whole.ply').read_bytes())
        self.assertEqual((self.folder / 'whole.png').read_bytes()[:8], b'\x89PNG\r\n\x1a\n')
        self.succeed('render', 'whole.ply', '-o', 'view.png', '--scene', scene, '--view', 'cluster1_c.jpg')
        self.succeed('render', 'whole.ply', '-o', 'novel.png', '--model', SCENE / 'novel', '--view', 'novel1')

    def test_threads_and_config_repeat_a_run_exactly(self):
        scene = self.small_scene()
        self.succeed('--threads', 1, '--save-config', 'run.ini', 'reconstruct', scene, '-o', 'a.ply', '--cells', 40)
        first = (self.folder / 'a.ply').read_bytes()
        self.succeed('--threads', 2, 'reconstruct', scene, '-o', 'b.ply', '--cells', 40)
        self.assertEqual((self.folder / 'b.ply').read_bytes(), first)
        (self.folder / 'a.ply').unlink()
        self.succeed('--config', 'run.ini')
        self.assertEqual((self.folder / 'a.ply').read_bytes(), first)

    def test_the_command_line_goes_before_the_config(self):
        scene = self.small_scene()
        self.succeed('--save-config', 'run.ini', 'stereo', scene, '-o', 'a.vtm')
        quiet = self.succeed('--quiet', '--config', 'run.ini', 'stereo', scene, '-o', 'b.vtm')
        self.assertEqual(quiet.stderr, '')
        self.assertTrue((self.folder / 'b.vtm').exists())
        self.succeed('--config', 'run.ini', 'triangulate', 'a.vtm', '-o', 'maps.vtm')   # of another command

    def test_every_format(self):
        self.succeed('stereo', self.small_scene(), '-o', 'features.vtm')
        self.succeed('triangulate', 'features.vtm', '-o', 'maps.vtm')
        for ending in ('ply', 'stl', 'obj', 'vtp', 'PLY'):
            self.succeed('contour', 'maps.vtm', '-o', f'mesh.{ending}', '--cells', 24)
            self.succeed('render', f'mesh.{ending}', '-o', f'{ending}.png')

    def test_overlay(self):
        self.succeed('stereo', self.small_scene(), '-o', 'features.vtm', '--overlay', 'pictures',
                     '--every-image', 'off')
        self.assertEqual(os.listdir(self.folder / 'pictures'), ['cluster1.png'])

    def test_quiet_and_log(self):
        scene = self.small_scene()
        self.assertEqual(self.succeed('--quiet', 'stereo', scene, '-o', 'features.vtm').stderr, '')
        log = self.succeed('stereo', scene, '-o', 'features.vtm').stderr
        self.assertIn('stereo: ', log)
        self.assertNotIn('\r', log)


class TestBadInput(WithFolder):
    def expect_error(self, mentions, *arguments, output=None):
        before = sorted(os.listdir(self.folder))
        result = run(*arguments, cwd=self.folder)
        self.assertGreater(result.returncode, 0, f'{result.returncode} {result.stderr}')
        lines = [line for line in result.stderr.splitlines() if line.startswith('freespace: ')]
        self.assertEqual(len(lines), 1, result.stderr)
        self.assertTrue(result.stderr.rstrip().endswith(lines[0]), result.stderr)
        self.assertIn(mentions, lines[0])
        self.assertEqual(sorted(os.listdir(self.folder)), before, 'something half-written is left')

    def stereo_fails(self, mentions, scene):
        self.expect_error(mentions, 'stereo', scene, '-o', 'features.vtm')

    def test_warnings_are_summed_up_and_errors_when_strict(self):
        model = self.folder / 'model'
        shutil.copytree(SCENE / 'sparse', model)
        points = [(x / 10 - .5, y / 10 - .5, 0.0) for x in range(10) for y in range(10)]
        images = []
        for i in range(4):
            shift = 0.05 * i + (0.3 if i == 2 else 0)  # the third camera is not where it was
            seen = ' '.join(f'{400 * (x + .05 * i) / 2 + 320} {400 * y / 2 + 240} {k + 1}'
                            for k, (x, y, _) in enumerate(points))
            images.append(f'{i + 1} 1 0 0 0 {shift} 0 2 1 {i}.jpg\n{seen}\n')
        for file in model.iterdir():
            file.unlink()
        (model / 'cameras.txt').write_text('1 PINHOLE 640 480 400 400 320 240\n')
        (model / 'images.txt').write_text(''.join(images))
        (model / 'points3D.txt').write_text(
            ''.join(f'{k + 1} {x} {y} {z} 0 0 0 0\n' for k, (x, y, z) in enumerate(points)))
        told = self.succeed('sparse', model, '-o', 'views.vtm').stderr
        self.assertIn('warning: 1 of 4 images is left out', told)
        self.assertRegex(told, r'freespace: 1 warning:\n  1 of 4 images .*2.jpg \(60 pixels\)\n$')
        self.assertEqual(self.succeed('-q', 'sparse', model, '-o', 'views.vtm').stderr, '')
        strict = run('--strict', 'sparse', model, '-o', 'strict.vtm', cwd=self.folder)
        self.assertEqual(strict.returncode, 1)
        self.assertIn('2.jpg (60 pixels)', strict.stderr)
        self.assertFalse((self.folder / 'strict.vtm').exists())
        self.succeed('--strict', 'sparse', model, '-o', 'kept.vtm', '--wrong-images', 'keep')

    def test_config_that_is_none(self):
        for text, mentions in (('', ''), ('[reconstruct]\nbogus=1\n', "'reconstruct.bogus'"), ('[bogus]\na=1\n', "'bogus'"),
                               ('nonsense', "'nonsense'"),
                               ('[contour]\nmaps="a"\noutput="b"\ncells=many\n', '--cells'), ('threads=-4\n', '--threads')):
            with self.subTest(text=text):
                (self.folder / 'run.ini').write_text(text)
                self.expect_error('freespace: run.ini', '--config', 'run.ini')
                self.expect_error(mentions, '--config', 'run.ini')
        for name in ('none.ini', '.'):
            result = run('--config', name, cwd=self.folder)
            self.assertEqual(result.stderr.count('freespace'), 1, result.stderr)
            self.assertIn(name, result.stderr)
        (self.folder / 'run.ini').write_text('[contour]\ncells=40\n')
        self.expect_error('freespace: --cells', '--config', 'run.ini', 'contour', 'a', '-o', 'b', '--cells', 'many')

    def test_unknown_command(self):
        self.expect_error('foo', 'foo')

    def test_numbers_that_are_none(self):
        scene = self.small_scene()
        for option in ('--min-depth', '--tolerance', '--longest-edge'):
            for value in ('nan', 'inf', '-1', 'x'):
                with self.subTest(option=option, value=value):
                    self.expect_error(option, 'reconstruct', scene, '-o', 'mesh.ply', option, value)

    def test_picture_that_cannot_be_written(self):
        scene = self.small_scene()
        for picture in ('mesh.jpg', 'nowhere/mesh.png'):
            with self.subTest(picture=picture):
                self.expect_error(picture, 'reconstruct', scene, '-o', 'mesh.ply', '--picture', picture)

    def test_depths_the_wrong_way_round(self):
        self.expect_error('--max-depth 1', 'stereo', self.small_scene(), '-o', 'out.vtm', '--min-depth', 5, '--max-depth', 1)

    def test_maps_in_place_of_features(self):
        self.succeed('stereo', self.small_scene(), '-o', 'features.vtm')
        self.succeed('triangulate', 'features.vtm', '-o', 'maps.vtm')
        self.expect_error('maps.vtm', 'triangulate', 'maps.vtm', '-o', 'out.vtm')
        self.expect_error('maps.vtm', 'report', 'scene.json', '--features', 'maps.vtm', '-o', 'out')

    def test_densify_without_photographs(self):
        model = Path(os.environ.get('FREESPACE_SHARED', ROOT.parent / 'shared')) / 'data' / 'buddha' / 'sparse'
        if not model.is_dir():
            self.skipTest('the shared data are not here')
        (self.folder / 'none').mkdir()
        self.expect_error('none', 'reconstruct', model, '--densify', 'none', '-o', 'out.ply')

    def test_missing_scene(self):
        self.stereo_fails('none.json', 'none.json')

    def test_broken_json(self):
        (self.folder / 'scene.json').write_text('{ "images": ')
        self.stereo_fails('scene.json', 'scene.json')

    def test_unknown_key(self):
        self.stereo_fails('colour', self.small_scene(colour='red'))

    def test_missing_image(self):
        scene = self.small_scene()
        (self.folder / 'images' / 'cluster1_l.jpg').unlink()
        self.stereo_fails('cluster1_l.jpg', scene)

    def test_unreadable_image(self):
        scene = self.small_scene()
        (self.folder / 'images' / 'cluster1_l.jpg').write_text('not an image')
        self.stereo_fails('cluster1_l.jpg', scene)

    def test_truncated_image(self):
        scene = self.small_scene()
        path = self.folder / 'images' / 'cluster1_l.jpg'
        whole = path.read_bytes()
        for size in (len(whole) // 2, len(whole) - 1):
            path.write_bytes(whole[:size])
            self.expect_error('cluster1_l.jpg', 'stereo', scene, '-o', 'out.vtm')
            self.expect_error('cluster1_l.jpg', 'calibrate', path, path, '--board', 'chessboard:9x6:1', '-o', 'out')
        path.write_bytes(whole + b'what a telephone adds')
        self.succeed('stereo', scene, '-o', 'out.vtm')

    def test_libraries_have_no_word(self):
        """What decoders print by themselves, beside telling that they failed."""
        scene = self.small_scene()
        path = self.folder / 'images' / 'cluster1_l.jpg'
        for damaged in (b'P5 -4 9999999 255\n', b'#?RADIANCE\nnone\n\n', b'\x89PNG\r\n\x1a\n' + 40 * b'\0'):
            path.write_bytes(damaged)
            result = run('-q', 'stereo', scene, '-o', 'out.vtm', cwd=self.folder)
            self.assertEqual(result.returncode, 1)
            self.assertRegex(result.stderr, r'^freespace: [^\n]*cluster1_l.jpg[^\n]*\n$')

    def test_image_of_another_size(self):
        scene = self.small_scene()
        cameras = self.folder / 'sparse' / 'cameras.txt'
        cameras.write_text(cameras.read_text().replace('1134 756', '1134 755'))
        self.stereo_fails('cluster1_', scene)

    def test_unsupported_camera_model(self):
        scene = self.small_scene()
        cameras = self.folder / 'sparse' / 'cameras.txt'
        cameras.write_text(cameras.read_text().replace('PINHOLE', 'FISHEYE'))
        self.stereo_fails('FISHEYE', scene)

    def test_unknown_image_in_a_cluster(self):
        triplets = [['x.jpg', 'cluster1_c.jpg', 'cluster1_r.jpg']]
        scene = self.small_scene(
            clusters=[{'name': 'a', 'reference': 'cluster1_c.jpg', 'triplets': triplets}])
        self.stereo_fails('x.jpg', scene)

    def test_triplet_without_overlap(self):
        scene = self.small_scene()
        images = self.folder / 'sparse' / 'images.txt'
        lines = images.read_text().splitlines()
        for i, line in enumerate(lines):
            if line.endswith('cluster1_l.jpg'):
                fields = line.split()
                fields[1:8] = ['0', '0', '1', '0', '0', '0', '-50']   # far away, looking elsewhere
                lines[i] = ' '.join(fields)
        images.write_text('\n'.join(lines) + '\n')
        self.stereo_fails('cluster1', scene)

    def test_truncated_features(self):
        scene = self.small_scene()
        run('--quiet', 'stereo', scene, '-o', 'features.vtm', cwd=self.folder)
        block = next((self.folder / 'features').iterdir())
        block.write_bytes(block.read_bytes()[:1000])
        self.expect_error(block.name, 'triangulate', 'features.vtm', '-o', 'maps.vtm')
        (self.folder / 'features.vtm').write_text('<VTKFile')
        self.expect_error('features.vtm', 'triangulate', 'features.vtm', '-o', 'maps.vtm')

    def test_truncated_binary_model(self):
        scene = self.small_scene()
        for name in ('cameras', 'images', 'points3D'):
            (self.folder / 'sparse' / f'{name}.bin').write_bytes(b'\x05\0\0\0\0\0\0\0\1')
        self.stereo_fails('cameras.bin', scene)

    def test_output_folder_that_is_not_there(self):
        self.expect_error('nowhere', 'stereo', self.small_scene(), '-o', 'nowhere/features.vtm')

    def test_surface_of_unknown_ending(self):
        self.expect_error('mesh.xyz', 'reconstruct', self.small_scene(), '-o', 'mesh.xyz')

    def test_mesh_that_is_none(self):
        (self.folder / 'mesh.ply').write_text('ply\nformat ascii 1.0\nelement vertex 5\n')
        self.expect_error('mesh.ply', 'render', 'mesh.ply', '-o', 'out.png')
        self.expect_error('none.ply', 'render', 'none.ply', '-o', 'out.png')

    def test_truncated_mesh(self):
        self.small_scene()
        self.succeed('stereo', 'scene.json', '-o', 'features.vtm')
        self.succeed('triangulate', 'features.vtm', '-o', 'maps.vtm')
        for ending in ('ply', 'stl', 'vtp'):
            mesh = self.folder / f'mesh.{ending}'
            self.succeed('contour', 'maps.vtm', '-o', mesh, '--cells', 16)
            whole = mesh.read_bytes()
            for part in (0, 5, 90, len(whole) // 3, len(whole) // 2, len(whole) - 40):
                with self.subTest(ending=ending, part=part):
                    mesh.write_bytes(whole[:part])
                    self.expect_error(mesh.name, 'render', mesh, '-o', 'out.png')

    def test_view_that_is_none(self):
        scene = self.small_scene()
        (self.folder / 'mesh.ply').write_text(
            'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n'
            'element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n')
        self.expect_error('nobody.jpg', 'render', 'mesh.ply', '-o', 'out.png', '--scene', scene, '--view', 'nobody.jpg')


if __name__ == '__main__':
    unittest.main()
