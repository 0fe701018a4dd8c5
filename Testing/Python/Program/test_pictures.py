# SPDX-License-Identifier: BSD-3-Clause
"""The commands that show a surface or hand it on: view, texture, occupancy, and what is wrong at their doors."""
import json
import os
import resource
import re
import shutil
import struct
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

ROOT = Path(__file__).resolve().parents[3]
PROGRAM = os.environ['FREESPACE_PROGRAM']
SCENE = ROOT / 'Examples' / 'Data' / 'blocks'
ROOT_USER = os.geteuid() == 0   # may write anywhere


def run(*arguments, cwd=None):
    return subprocess.run([PROGRAM, *map(str, arguments)], cwd=cwd, capture_output=True, text=True, timeout=300)


def picture(path):
    """The pixels of a PNG, (height, width, 3)."""
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1).astype(int)


def write_triangle(path, faces='3 0 1 2\n', shift=0.0):
    count = faces.count('\n')
    path.write_text('ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n'
                    f'element face {count}\nproperty list uchar int vertex_indices\nend_header\n'
                    f'{shift} 0 0\n{shift + 0.1} 0 0\n{shift} 0.1 0\n{faces}')


def film_packets(path):
    """The packets of an Ogg file with one stream, as (size, first bytes)."""
    data, at, packets, open_packet = path.read_bytes(), 0, [], b''
    while at < len(data):
        assert data[at:at + 4] == b'OggS'
        laces = data[at + 27:at + 27 + data[at + 26]]
        at += 27 + len(laces)
        for lace in laces:
            open_packet += data[at:at + lace]
            at += lace
            if lace < 255:
                packets.append(open_packet)
                open_packet = b''
    return packets


class WithScene(unittest.TestCase):
    """A scene of one cluster with its maps and mesh, made once; each test has a folder of links to it."""

    @classmethod
    def setUpClass(cls):
        cls.made = Path(tempfile.mkdtemp(prefix='freespace-test-'))
        cls.addClassCleanup(shutil.rmtree, cls.made)
        scene = json.loads((SCENE / 'scene.json').read_text())
        scene['clusters'] = scene['clusters'][:1]
        (cls.made / 'scene.json').write_text(json.dumps(scene))
        shutil.copytree(SCENE / 'sparse', cls.made / 'sparse')
        (cls.made / 'images').mkdir()
        for image in (SCENE / 'images').glob('cluster1_*'):
            shutil.copy(image, cls.made / 'images')
        for command in (('stereo', 'scene.json', '-o', 'features.vtm', '--every-image', 'off'),
                        ('triangulate', 'features.vtm', '-o', 'maps.vtm'),
                        ('contour', 'maps.vtm', '-o', 'mesh.ply', '--cells', 40)):
            result = run(*command, cwd=cls.made)
            assert result.returncode == 0, result.stderr

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix='freespace-test-'))
        self.addCleanup(shutil.rmtree, self.folder)
        shutil.copytree(self.made, self.folder, dirs_exist_ok=True)

    def succeed(self, *arguments):
        result = run(*arguments, cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def fails(self, mentions, *arguments):
        """One sentence that names what is wrong, a status, and nothing changed in the folder."""
        def state():
            return {path: path.is_file() and path.read_bytes() for path in self.folder.rglob('*')}
        before = state()
        result = run(*arguments, cwd=self.folder)
        self.assertGreater(result.returncode, 0, f'{arguments} {result.stderr}')
        lines = [line for line in result.stderr.splitlines() if line.startswith('freespace: ')]
        self.assertEqual(len(lines), 1, result.stderr)
        self.assertTrue(result.stderr.rstrip().endswith(lines[0]), result.stderr)
        self.assertIn(mentions, lines[0])
        self.assertEqual(state().keys(), before.keys(), 'something half-written is left')
        self.assertEqual(state(), before)


class TestView(WithScene):
    def test_view_of_a_camera_is_its_photograph(self):
        self.succeed('view', 'scene.json', '--mesh', 'mesh.ply', '--view', 'cluster1_c.jpg', '-o', 'c.png')
        seen = picture(self.folder / 'c.png')
        from vtkmodules.vtkIOImage import vtkJPEGReader
        reader = vtkJPEGReader()
        reader.SetFileName(str(self.folder / 'images' / 'cluster1_c.jpg'))
        reader.Update()
        photograph = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(seen.shape).astype(int)
        difference = np.abs(seen - photograph).max(axis=2)
        self.assertGreater((difference < 12).mean(), 0.7, 'where the surface is, the photograph is')

    def test_model_gives_one_picture_for_each_camera_named_after_it(self):
        self.succeed('view', 'scene.json', '--mesh', 'mesh.ply', '--model', SCENE / 'novel', '-o', 'novel')
        names = sorted(os.listdir(self.folder / 'novel'))
        self.assertEqual(names, [f'novel{i + 1}.png' for i in range(6)])
        pictures = [picture(self.folder / 'novel' / name) for name in names]
        for i, one in enumerate(pictures):
            self.assertEqual(one.shape, (756, 1134, 3))
            self.assertGreater(one.std(), 20, 'blank')
            for other in pictures[:i]:
                self.assertGreater(np.abs(one - other).mean(), 5)

    def test_turntable_numbers_its_pictures_in_order(self):
        self.succeed('view', 'scene.json', '--mesh', 'mesh.ply', '--turntable', 11, '-o', 'deep/turn')
        names = sorted(os.listdir(self.folder / 'deep' / 'turn'))
        self.assertEqual(names, [f'{i:02}.png' for i in range(11)])

    def test_turntable_as_a_film_has_every_picture(self):
        self.succeed('view', 'scene.json', '--mesh', 'mesh.ply', '--turntable', 7, '-o', 'turn.ogv', '--rate', 5)
        headers, pictures = film_packets(self.folder / 'turn.ogv')[:3], film_packets(self.folder / 'turn.ogv')[3:]
        self.assertEqual([packet[:7] for packet in headers], [b'\x80theora', b'\x81theora', b'\x82theora'])
        self.assertEqual(len(pictures), 7)
        self.assertGreater(min(map(len, pictures)), 1000, 'each shows something else')
        identification = headers[0][7:]
        picture_size = (int.from_bytes(identification[7:10], 'big'), int.from_bytes(identification[10:13], 'big'))
        self.assertEqual(picture_size, (1134, 756))
        self.assertEqual(identification[34] >> 3 & 3, 0, 'colours are 4:2:0')
        rate = struct.unpack('>II', identification[15:23])
        self.assertEqual(rate[0] / rate[1], 5)

    def test_film_that_cannot_be(self):
        (self.folder / 'folder.ogv').mkdir()
        self.fails_to_view('nowhere/turn.ogv', at=('--turntable', '3'), output='nowhere/turn.ogv')
        self.fails_to_view('none.ply', mesh='none.ply', at=('--turntable', '3'), output='turn.ogv')
        self.fails_to_view('folder.ogv', at=('--turntable', '3'), output='folder.ogv')
        self.fails_to_view('turn.mp4', at=('--turntable', '3'), output='turn.mp4')
        self.fails_to_view('all.png', at=('--model', SCENE / 'novel'), output='all.png')
        self.fails_to_view('--rate', at=('--turntable', '3', '--rate', '0'), output='turn.ogv')

    def test_without_a_viewpoint_from_near_the_cameras(self):
        self.succeed('view', 'scene.json', '--mesh', 'mesh.ply', '-o', 'near.png')
        seen = picture(self.folder / 'near.png')
        self.assertEqual(seen.shape, (756, 1134, 3))
        self.assertLess((seen == 255).all(axis=2).mean(), 0.6)

    def test_photographs_in_use_are_told(self):
        log = self.succeed('view', 'scene.json', '--mesh', 'mesh.ply', '--view', 'cluster1_c', '-o', 'c.png').stderr
        self.assertIn('colours from 5 of 5 images', log)
        quiet = self.succeed('--quiet', 'view', 'scene.json', '--mesh', 'mesh.ply', '--view', 'cluster1_c',
                             '-o', 'c.png')
        self.assertEqual(quiet.stderr, '')

    def fails_to_view(self, mentions, *, scene='scene.json', mesh='mesh.ply', at=('--view', 'cluster1_c.jpg'),
                      output='c.png'):
        self.fails(mentions, 'view', scene, '--mesh', mesh, *at, '-o', output)

    def test_scene_that_is_none(self):
        self.fails_to_view('none.json', scene='none.json')
        (self.folder / 'broken.json').write_text('{')
        self.fails_to_view('broken.json', scene='broken.json')

    def test_scene_without_photographs(self):
        shutil.rmtree(self.folder / 'images')
        self.fails_to_view('images', at=('--model', SCENE / 'novel'), output='out')
        (self.folder / 'images').mkdir()
        self.fails_to_view('scene.json')

    def test_damaged_photograph(self):
        path = self.folder / 'images' / 'cluster1_l.jpg'
        path.write_bytes(path.read_bytes()[:200])
        self.fails_to_view('cluster1_l.jpg')
        path.write_text('none')
        self.fails_to_view('cluster1_l.jpg', at=('--turntable', '3'), output='out')

    def test_mesh_that_is_none(self):
        for at, output in ((('--view', 'cluster1_c.jpg'), 'c.png'), (('--turntable', '3'), 'out'),
                           (('--model', SCENE / 'novel'), 'out')):
            with self.subTest(at=at):
                self.fails_to_view('none.ply', mesh='none.ply', at=at, output=output)
                self.fails_to_view('scene.json', mesh='scene.json', at=at, output=output)
                self.fails_to_view('maps.vtm', mesh='maps.vtm', at=at, output=output)

    def test_mesh_without_triangles(self):
        write_triangle(self.folder / 'points.ply', faces='')
        self.fails_to_view('points.ply', mesh='points.ply')
        self.fails_to_view('points.ply', mesh='points.ply', at=('--turntable', '3'), output='out')

    def test_view_that_is_none(self):
        self.fails_to_view('nobody.jpg', at=('--view', 'nobody.jpg'))

    def test_model_that_is_none(self):
        self.fails_to_view('nowhere', at=('--model', 'nowhere'), output='out')
        self.fails_to_view('images', at=('--model', 'images'), output='out')

    def test_no_viewpoint_and_two(self):
        self.fails_to_view('--view', at=('--view', 'cluster1_c.jpg', '--turntable', '3'))
        self.fails_to_view('--turntable', at=('--turntable', '0'), output='out')

    def test_output_that_cannot_be(self):
        (self.folder / 'file').write_text('precious')
        (self.folder / 'folder.png').mkdir()
        self.fails_to_view('c.jpg', output='c.jpg')
        self.fails_to_view('nowhere/c.png', output='nowhere/c.png')
        self.fails_to_view('folder.png', output='folder.png')
        for at in (('--turntable', '3'), ('--model', SCENE / 'novel')):
            self.fails_to_view('file', at=at, output='file')
            self.fails_to_view('file/deep', at=at, output='file/deep')

    @unittest.skipIf(ROOT_USER, 'root may write anywhere')
    def test_output_folder_that_may_not_be_written(self):
        (self.folder / 'locked').mkdir(mode=0o555)
        self.fails_to_view('locked', output='locked/c.png')
        self.fails_to_view('locked', at=('--turntable', '3'), output='locked')


class TestRender(WithScene):
    def render(self, *options, mesh='mesh.ply'):
        self.succeed('render', mesh, '-o', 'out.png', *options)
        return picture(self.folder / 'out.png')

    def test_size(self):
        self.assertEqual(self.render().shape, (960, 1280, 3))
        self.assertEqual(self.render('--size', '300x200').shape, (200, 300, 3))

    def test_viewpoint(self):
        size = ('--size', '240x180')
        (self.folder / 'foreign.ply').write_bytes(re.sub(rb'comment freespace[^\n]*\n', b'', self.mesh_bytes()))
        usual = self.render(*size, mesh='foreign.ply')
        np.testing.assert_array_equal(self.render(*size, '--azimuth', 237, '--elevation', 33), usual)
        for options in (('--azimuth', 30), ('--elevation', 80), ('--elevation', -20)):
            with self.subTest(options=options):
                self.assertGreater(np.abs(self.render(*size, *options) - usual).mean(), 4)

    def mesh_bytes(self):
        return (self.folder / 'mesh.ply').read_bytes()

    def test_a_surface_knows_its_viewpoint(self):
        size = ('--size', '240x180')
        own = self.render(*size)
        self.assertGreater(np.abs(self.render(*size, '--azimuth', -123) - own).mean(), 4)
        self.succeed('contour', 'maps.vtm', '-o', 'same.vtp', '--cells', 40)
        np.testing.assert_array_equal(self.render(*size, mesh='same.vtp'), own)
        damaged = re.sub(rb'(freespace-viewpoint) \S+', rb'\1 nan', self.mesh_bytes())
        self.assertNotEqual(damaged, self.mesh_bytes())
        (self.folder / 'damaged.ply').write_bytes(damaged)
        np.testing.assert_array_equal(
            self.render(*size, mesh='damaged.ply'), self.render(*size, '--azimuth', -123))

    def test_default_picture_is_upright_whatever_way_the_axes_go(self):
        """Turns the world by turning the model, and expects the same picture."""
        own = self.render('--size', '240x180').astype(float)
        turned = self.folder / 'turned'
        shutil.copytree(self.folder / 'sparse', turned)
        # x' = y, y' = z, z' = x: a camera's quaternion then is multiplied by (1, 1, 1, 1) / 2.
        lines = []
        for line in (turned / 'images.txt').read_text().splitlines():
            words = line.split()
            if len(words) == 10 and words[-1].endswith('.jpg'):
                w, x, y, z = map(float, words[1:5])
                words[1:5] = map(str, ((w - x - y - z) / 2, (w + x + y - z) / 2, (w - x + y + z) / 2,
                                       (w + x - y + z) / 2))
                line = ' '.join(words)
            lines.append(line)
        (turned / 'images.txt').write_text('\n'.join(lines) + '\n')
        points = [line.split() for line in (turned / 'points3D.txt').read_text().splitlines() if line[0] != '#']
        (turned / 'points3D.txt').write_text(
            ''.join(' '.join([p[0], p[2], p[3], p[1], *p[4:]]) + '\n' for p in points))
        scene = json.loads((self.folder / 'scene.json').read_text())
        scene['model'] = 'turned'
        (self.folder / 'turned.json').write_text(json.dumps(scene))
        self.succeed('reconstruct', 'turned.json', '-o', 'turned.ply', '--cells', 40, '--every-image', 'off')
        seen = self.render('--size', '240x180', mesh='turned.ply').astype(float)
        self.assertLess(np.abs(seen - own).mean(), 3)

    def test_scene_of_another_place(self):
        write_triangle(self.folder / 'far.ply', shift=1e4)
        self.fails('scene.json', 'render', 'far.ply', '-o', 'out.png', '--scene', 'scene.json')

    def test_between_the_cameras(self):
        seen = self.render('--scene', 'scene.json')
        self.assertEqual(seen.shape, (756, 1134, 3), "the first camera's size")
        self.assertLess((seen == 255).all(axis=2).mean(), 0.5, 'the surface fills the picture')
        self.assertGreater(np.abs(self.render('--scene', 'scene.json', '--view', 'cluster1_c') - seen).mean(), 2)

    def test_picture_of_a_reconstruction_is_from_between_the_cameras(self):
        self.succeed('reconstruct', 'scene.json', '-o', 'whole.ply', '--cells', 40, '--picture', 'whole.png')
        seen = picture(self.folder / 'whole.png')
        self.assertEqual(seen.shape, (756, 1134, 3))
        self.assertLess((seen == 255).all(axis=2).mean(), 0.5)

    def test_observed_leaves_out_what_was_not_seen(self):
        self.succeed('contour', 'maps.vtm', '-o', 'mesh.vtp', '--cells', 40)
        view = ('--scene', 'scene.json', '--view', 'cluster1_c')
        whole, seen = self.render(*view, mesh='mesh.vtp'), self.render(*view, '--observed', mesh='mesh.vtp')
        np.testing.assert_array_equal(whole, self.render(*view))
        self.assertGreater(np.abs(whole - seen).mean(), 1)
        self.fails('mesh.ply', 'render', 'mesh.ply', '-o', 'out2.png', '--observed')

    def test_options_that_cannot_be(self):
        for options in (('--size', '0x5'), ('--size', '10'), ('--size', '10x10x10'), ('--size', '9999x10'),
                        ('--size', 'x'), ('--azimuth', 'x'), ('--elevation', '91'),
                        ('--up', '0,0,0'), ('--up', 'w'), ('--up', '1,2'), ('--background', '2,0,0'), ('--zoom', '0'),
                        ('--diff', 'd.png'), ('--azimuth', '3', '--view', 'c')):
            with self.subTest(options=options):
                self.fails(options[0], 'render', 'mesh.ply', '-o', 'out.png', *options)
        self.fails('--azimuth', 'render', 'mesh.ply', '-o', 'out.png', '--azimuth', 'nan')
        self.fails('--view', 'render', 'mesh.ply', '-o', 'out.png', '--view', 'cluster1_c.jpg')

    def test_output_that_cannot_be(self):
        (self.folder / 'folder.png').mkdir()
        write_triangle(self.folder / 'points.ply', faces='')
        for output in ('out.jpg', 'nowhere/out.png', 'folder.png'):
            self.fails(output, 'render', 'mesh.ply', '-o', output)
        self.fails('points.ply', 'render', 'points.ply', '-o', 'out.png')


class TestTexture(WithScene):
    def test_memory_limit_is_checked_before_the_images_are_read(self):
        self.fails('--memory-limit', 'texture', 'mesh.ply', '--scene', 'scene.json', '-o', 'model.glb',
                   '--memory-limit', 1)

    def test_glb_has_geometry_and_texture(self):
        self.succeed('texture', 'mesh.ply', '--scene', 'scene.json', '-o', 'model.glb', '--largest', 512)
        data = (self.folder / 'model.glb').read_bytes()
        magic, version, length = struct.unpack('<4sII', data[:12])
        self.assertEqual((magic, version, length), (b'glTF', 2, len(data)))
        size, kind = struct.unpack('<I4s', data[12:20])
        self.assertEqual(kind, b'JSON')
        gltf = json.loads(data[20:20 + size])
        primitive = gltf['meshes'][0]['primitives'][0]
        self.assertIn('TEXCOORD_0', primitive['attributes'])
        self.assertEqual(len(gltf['images']), 1)
        self.assertNotIn('uri', gltf['images'][0], 'the picture is within')
        positions = gltf['accessors'][primitive['attributes']['POSITION']]
        self.assertGreater(positions['count'], 1000)

    def test_obj_has_its_material_and_picture(self):
        self.succeed('texture', 'mesh.ply', '--scene', 'scene.json', '-o', 'model.obj', '--largest', 512)
        lines = (self.folder / 'model.obj').read_text().splitlines()
        material = next(line.split()[1] for line in lines if line.startswith('mtllib'))
        image = re.search(r'map_Kd (\S+)', (self.folder / material).read_text())[1]
        self.assertEqual((material, image), ('model.mtl', 'model.png'))
        height, width, _ = picture(self.folder / image).shape
        self.assertGreater(min(height, width), 16)
        self.assertLessEqual(max(height, width), 512)
        kinds = {line.split()[0] for line in lines if line and line[0] != '#'}
        self.assertLessEqual({'v', 'vt', 'f'}, kinds)

    def test_ply_has_colours(self):
        self.succeed('texture', 'mesh.ply', '--scene', 'scene.json', '-o', 'model.ply', '--largest', 256)
        header = (self.folder / 'model.ply').read_bytes().split(b'end_header')[0]
        self.assertIn(b'property uchar red', header)

    def test_texture_too_large(self):
        self.fails('texels of side', 'texture', 'mesh.ply', '--scene', 'scene.json', '-o', 'model.glb', '--texel', 1e-9)

    def test_scene_of_another_place(self):
        write_triangle(self.folder / 'far.ply', shift=1e4)
        self.fails('another place', 'texture', 'far.ply', '--scene', 'scene.json', '-o', 'model.glb')

    def test_texel_is_as_asked(self):
        log = self.succeed('texture', 'mesh.ply', '--scene', 'scene.json', '-o', 'model.glb', '--texel', 0.004).stderr
        self.assertIn('texels of side 0.004', log)

    def fails_to_texture(self, mentions, *more, mesh='mesh.ply', scene='scene.json', output='model.glb'):
        self.fails(mentions, 'texture', mesh, '--scene', scene, '-o', output, *more)

    def test_mesh_that_is_none(self):
        write_triangle(self.folder / 'points.ply', faces='')
        for mesh in ('none.ply', 'scene.json', 'points.ply', 'maps.vtm'):
            self.fails_to_texture(mesh, mesh=mesh)

    def test_scene_that_is_none(self):
        self.fails_to_texture('none.json', scene='none.json')
        shutil.rmtree(self.folder / 'images')
        self.fails_to_texture('images', scene='scene.json')

    def test_output_that_cannot_be(self):
        (self.folder / 'folder.glb').mkdir()
        (self.folder / 'file').write_text('precious')
        for output in ('model.xyz', 'nowhere/model.glb', 'folder.glb', 'file/model.glb'):
            with self.subTest(output=output):
                self.fails_to_texture(output, output=output)

    def test_numbers_that_are_none(self):
        for value in ('-1', 'nan', 'inf', 'x'):
            with self.subTest(value=value):
                self.fails_to_texture('--texel', '--texel', value)
        for value in ('0', '99999999', 'x'):
            with self.subTest(value=value):
                self.fails_to_texture('--largest', '--largest', value)


class TestOccupancy(WithScene):
    def test_both_formats_are_octomaps(self):
        for name, first in (('map.bt', '# Octomap OcTree binary file'), ('map.ot', '# Octomap OcTree file')):
            self.succeed('occupancy', 'maps.vtm', '-o', name, '--resolution', 0.02)
            header = (self.folder / name).read_bytes()[:400].decode('latin-1')
            self.assertTrue(header.startswith(first), header)
            self.assertIn('\nres 0.02\n', header)

    def test_finer_cells_make_more_of_them(self):
        sizes = []
        for resolution in (0.04, 0.02, 0.01):
            self.succeed('occupancy', 'maps.vtm', '-o', 'map.bt', '--resolution', resolution)
            header = (self.folder / 'map.bt').read_bytes()[:400].decode('latin-1')
            sizes.append(int(re.search(r'\nsize (\d+)', header)[1]))
        self.assertLess(2 * sizes[0], sizes[1])
        self.assertLess(2 * sizes[1], sizes[2])

    def test_quiet_is_quiet(self):
        for name in ('map.bt', 'map.ot'):
            quiet = self.succeed('--quiet', 'occupancy', 'maps.vtm', '-o', name, '--resolution', 0.03)
            self.assertEqual(quiet.stderr + quiet.stdout, '')
        log = self.succeed('occupancy', 'maps.vtm', '-o', 'map.bt', '--resolution', 0.03).stderr
        self.assertIn('wrote map.bt', log)

    def fails_to_map(self, mentions, *more, maps='maps.vtm', output='map.bt'):
        self.fails(mentions, 'occupancy', maps, '-o', output, *more)

    def test_maps_that_are_none(self):
        (self.folder / 'empty.vtm').write_text('')
        for maps in ('none.vtm', 'empty.vtm', 'features.vtm', 'scene.json', 'mesh.ply'):
            with self.subTest(maps=maps):
                self.fails_to_map(maps, maps=maps)

    def test_output_that_cannot_be(self):
        (self.folder / 'folder.bt').mkdir()
        (self.folder / 'file').write_text('precious')
        for output in ('map.xyz', 'nowhere/map.bt', 'folder.bt', 'file/map.bt'):
            with self.subTest(output=output):
                self.fails_to_map(output, output=output)

    def test_numbers_that_are_none(self):
        for option in ('--resolution', '--hull-margin', '--min-views'):
            for value in ('-1', 'nan', 'inf', 'x'):
                with self.subTest(option=option, value=value):
                    self.fails_to_map(option, option, value)
        self.fails_to_map('', '--resolution', '1e-9')



class TestFullDisk(WithScene):
    """What a writer could not write to the end is not taken for a file."""

    def cut_off(self, *arguments):
        before = sorted(self.folder.rglob('*'))
        result = subprocess.run([PROGRAM, '-q', *map(str, arguments)], cwd=self.folder, capture_output=True,
                                text=True, timeout=300, preexec_fn=lambda: resource.setrlimit(
                                    resource.RLIMIT_FSIZE, (20000, 20000)))
        self.assertEqual(result.returncode, 1, result.stderr)
        # One sentence, with the name that was asked for, and none of a library's words.
        name = arguments[arguments.index('-o') + 1]
        self.assertRegex(result.stderr, rf'^freespace: Cannot write {re.escape(name)}[^\n]*\n$')
        self.assertEqual(sorted(self.folder.rglob('*')), before)

    def test_surfaces_maps_and_models(self):
        for name in ('cut.ply', 'cut.stl', 'cut.obj', 'cut.vtp'):
            with self.subTest(name=name):
                self.cut_off('contour', 'maps.vtm', '--cells', 40, '-o', name)
        self.cut_off('triangulate', 'features.vtm', '-o', 'cut.vtm')
        self.cut_off('occupancy', 'maps.vtm', '-o', 'cut.ot')
        for name in ('cut.glb', 'cut.obj', 'cut.ply'):
            self.cut_off('texture', 'mesh.ply', '--scene', 'scene.json', '-o', name)

    def test_pictures_and_films(self):
        self.cut_off('render', 'mesh.ply', '-o', 'cut.png')
        self.cut_off('view', 'scene.json', '--mesh', 'mesh.ply', '-o', 'cut.png')
        self.cut_off('view', 'scene.json', '--mesh', 'mesh.ply', '--turntable', 3, '-o', 'cut.ogv')
        self.cut_off('view', 'scene.json', '--mesh', 'mesh.ply', '--turntable', 3, '-o', 'cut')

    def test_standard_output(self):
        (self.folder / 'points.csv').write_text('0,0,0\n')
        with open('/dev/full', 'w') as full:
            result = subprocess.run([PROGRAM, '-q', 'query', 'maps.vtm', '--points', 'points.csv'],
                                    cwd=self.folder, stdout=full, stderr=subprocess.PIPE, text=True, timeout=300)
        self.assertEqual(result.returncode, 1)
        self.assertIn('standard output', result.stderr)


if __name__ == '__main__':
    unittest.main()
