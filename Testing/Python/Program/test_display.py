# SPDX-License-Identifier: BSD-3-Clause
"""Pictures do not depend on a display: with an X server (Xvfb) they are those without, byte by byte."""
import os
import shutil
import subprocess
import sys
import tempfile

import unittest
from pathlib import Path

PROGRAM = os.environ['FREESPACE_PROGRAM']
XVFB = shutil.which('Xvfb')

MESH = ('ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n'
        'element face 4\nproperty list uchar int vertex_indices\nend_header\n'
        '0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n')

# A window of VTK's for the screen and pictures of ours, by turns.
BOTH = '''
import sys
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow
import vtkmodules.vtkRenderingOpenGL2
from vtkmodules.vtkFiltersSources import vtkConeSource
import freespace

def shown(source):
    mapper, actor, renderer, window = vtkPolyDataMapper(), vtkActor(), vtkRenderer(), vtkRenderWindow()
    mapper.SetInputConnection(source.GetOutputPort())
    actor.SetMapper(mapper)
    renderer.AddActor(actor)
    window.AddRenderer(renderer)
    window.SetSize(100, 100)
    return window

source = vtkConeSource()
window = shown(source)
picture = freespace.vtkSurfacePicture()
picture.SetInputConnection(source.GetOutputPort())
picture.SetSize(60, 40)
for resolution in (6, 7, 8):
    source.SetResolution(resolution)
    window.Render()
    freespace.update(picture)
    assert picture.GetOutput().GetNumberOfPoints() == 2400
    window.Render()
print(window.GetClassName())
picture.WritePNG(sys.argv[1])
del picture
window.Render()
'''


@unittest.skipUnless(XVFB, 'Xvfb is not installed')
class TestDisplay(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        read, write = os.pipe()
        cls.server = subprocess.Popen([XVFB, '-displayfd', str(write), '-screen', '0', '640x480x24', '-nolisten', 'tcp'],
                                      pass_fds=[write], stderr=subprocess.DEVNULL)
        cls.addClassCleanup(cls.server.wait)
        cls.addClassCleanup(cls.server.terminate)
        os.close(write)
        number = b''
        while not number.endswith(b'\n'):
            byte = os.read(read, 1)
            if not byte:
                raise unittest.SkipTest('Xvfb does not start here')
            number += byte
        os.close(read)
        cls.display = f':{number.decode().strip()}'

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix='freespace-test-')
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / 'mesh.ply').write_text(MESH)

    def environment(self, **more):
        known = {name: value for name, value in os.environ.items() if name not in ('DISPLAY', 'FREESPACE_WINDOW')}
        return {**known, **more}

    def rendered(self, **more):
        out = self.folder / 'out.png'
        done = subprocess.run([PROGRAM, 'render', 'mesh.ply', '-o', out, '--size', '200x150'], cwd=self.folder,
                              env=self.environment(**more), capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        return out.read_bytes()

    def test_program(self):
        without = self.rendered()
        self.assertEqual(self.rendered(DISPLAY=self.display), without)
        self.assertEqual(self.rendered(DISPLAY=self.display, FREESPACE_WINDOW='osmesa'), without)
        self.assertGreater(len(self.rendered(DISPLAY=self.display, FREESPACE_WINDOW='display')), 500)

    def python(self, script, *arguments, **more):
        done = subprocess.run([sys.executable, '-c', script, *map(str, arguments)], env=self.environment(**more),
                              capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_windows_of_both_kinds_in_one_process(self):
        alone, beside = self.folder / 'alone.png', self.folder / 'beside.png'
        self.assertIn('OSMesa', self.python(BOTH, alone))
        self.assertIn('vtkXOpenGL', self.python(BOTH, beside, DISPLAY=self.display))
        self.assertEqual(beside.read_bytes(), alone.read_bytes())

    def test_variable_chooses_the_window(self):
        script = ('import freespace, vtkmodules.vtkRenderingOpenGL2\n'
                  'from vtkmodules.vtkRenderingCore import vtkRenderWindow\nprint(vtkRenderWindow().GetClassName())')
        self.assertIn('vtkXOpenGL', self.python(script, DISPLAY=self.display))
        self.assertIn('OSMesa', self.python(script, DISPLAY=self.display, FREESPACE_WINDOW='osmesa'))
        self.assertIn('OSMesa', self.python(script))
        self.assertIn('vtkXOpenGL', self.python(script, FREESPACE_WINDOW='display'))


if __name__ == '__main__':
    unittest.main()
