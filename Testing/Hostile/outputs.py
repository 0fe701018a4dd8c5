# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of outputs share: a folder with inputs, each command that writes with an old and a new output.

FREESPACE_PROGRAM is the program, FREESPACE_KILLPOINT the library killpoint.c.
"""
import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM, KILLPOINT = os.environ['FREESPACE_PROGRAM'], os.environ['FREESPACE_KILLPOINT']
SCENE = Path(__file__).resolve().parents[2] / 'Examples' / 'Data' / 'blocks'

# The output, and the arguments that make the old one and the new one.
OUTPUTS = {
    'features.vtm': [['sparse', 'model', '-o', 'features.vtm', '--min-track', '3'], ['sparse', 'model', '-o', 'features.vtm']],
    'maps.vtm': [['triangulate', 'few.vtm', '-o', 'maps.vtm'], ['triangulate', 'points.vtm', '-o', 'maps.vtm']],
    'mesh.ply': [['contour', 'views.vtm', '-o', 'mesh.ply', '--no-fit', '--cells', '10'],
                 ['contour', 'views.vtm', '-o', 'mesh.ply', '--no-fit', '--cells', '8']],
    'mesh.vtp': [['contour', 'views.vtm', '-o', 'mesh.vtp', '--no-fit', '--cells', '10'],
                 ['contour', 'views.vtm', '-o', 'mesh.vtp', '--no-fit', '--cells', '8']],
    'map.bt': [['occupancy', 'views.vtm', '-o', 'map.bt', '--resolution', '0.4'],
               ['occupancy', 'views.vtm', '-o', 'map.bt', '--resolution', '0.5']],
    'again.json': [['clusters', 'scene.json', '-o', 'again.json', '--partners', '2'],
                   ['clusters', 'scene.json', '-o', 'again.json', '--partners', '4']],
    'picture.png': [['render', 'good.ply', '-o', 'picture.png', '--size', '32x24'],
                    ['render', 'good.ply', '-o', 'picture.png', '--size', '24x32']],
    'run.ini': [['--save-config', 'run.ini', 'sparse', 'model', '-o', 'other.vtm', '--min-track', '3'],
                ['--save-config', 'run.ini', 'sparse', 'model', '-o', 'other.vtm']]}


def write_model(folder):
    """A wavy wall before three cameras in a row, the last of which does not see all points."""
    folder.mkdir()
    (folder / 'cameras.txt').write_text('1 PINHOLE 640 480 500 500 320 240\n')
    points = [((i % 9 - 4) * 0.25, (i // 9 - 4) * 0.2, 4 + 0.1 * (i % 3)) for i in range(81)]
    images, tracks = '', [[] for _ in points]
    for image, shift in enumerate((-0.5, 0.0, 0.5)):
        seen = [i for i in range(len(points)) if image < 2 or i % 4 > 0]
        images += f'{image + 1} 1 0 0 0 {-shift} 0 0 1 {image}.jpg\n'
        images += ' '.join(f'{320 + 500 * (points[i][0] - shift) / points[i][2]} {240 + 500 * points[i][1] / points[i][2]} {i + 1}'
                           for i in seen) + '\n'
        for at, i in enumerate(seen):
            tracks[i].append(f'{image + 1} {at}')
    (folder / 'images.txt').write_text(images)
    (folder / 'points3D.txt').write_text(''.join(
        f'{i + 1} {x} {y} {z} 9 9 9 0.1 {" ".join(tracks[i])}\n' for i, (x, y, z) in enumerate(points)))


def content(path):
    """Of a .vtm the index without the names of the parts, and the parts that it refers to; the bytes of others."""
    if path.suffix != '.vtm':
        return path.read_bytes()
    text = path.read_text()
    parts = re.findall(r'file="([^"]*)"', text)
    return re.sub(r'file="[^"]*"', '', text), [(path.parent / part).read_bytes() for part in parts]


class OutputTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.inputs = Path(tempfile.mkdtemp(prefix='freespace-test-'))
        for name in ('images', 'sparse'): # read only: no output has their names
            (cls.inputs / name).symlink_to(SCENE / name)
        write_model(cls.inputs / 'model')
        scene = json.loads((SCENE / 'scene.json').read_text())
        scene['clusters'] = scene['clusters'][:2]
        (cls.inputs / 'scene.json').write_text(json.dumps(scene))
        for arguments in (['sparse', 'model', '-o', 'points.vtm'],
                          ['sparse', 'model', '-o', 'few.vtm', '--min-track', '3'], ['triangulate', 'points.vtm', '-o', 'views.vtm'],
                          ['contour', 'views.vtm', '-o', 'good.ply', '--no-fit', '--cells', '8']):
            subprocess.run([PROGRAM, '-q', *arguments], cwd=cls.inputs, check=True)
        cls.addClassCleanup(shutil.rmtree, cls.inputs)

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix='freespace-test-'))
        self.addCleanup(shutil.rmtree, self.folder)
        self.link_inputs(self.folder)

    def link_inputs(self, folder):
        for path in self.inputs.iterdir():
            (folder / path.name).symlink_to(path)

    def start(self, arguments, folder=None, **environment):
        if environment:
            environment['LD_PRELOAD'] = KILLPOINT
        return subprocess.Popen([PROGRAM, '-q', *arguments], cwd=folder or self.folder, stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, text=True,
                                env={**os.environ, **environment})

    def run_program(self, arguments, folder=None, status=0, **environment):
        process = self.start(arguments, folder, **environment)
        words = process.communicate()[1]
        if status is not None:
            self.assertEqual(process.returncode, status, words)
        return process.returncode, words

    def made(self, name):
        """The content of the old and of the new output, made in a folder of their own."""
        contents = []
        for arguments in OUTPUTS[name]:
            with tempfile.TemporaryDirectory(prefix='freespace-test-') as text:
                folder = Path(text)
                self.link_inputs(folder)
                self.run_program(arguments, folder)
                contents.append(content(folder / name))
        self.assertNotEqual(*contents)
        return contents

    def added(self):
        """The names of what is in the folder beside the inputs."""
        return sorted(path.name for path in self.folder.iterdir() if not path.is_symlink())

    def work_folders(self):
        return [name for name in self.added() if name.startswith('.freespace-')]
