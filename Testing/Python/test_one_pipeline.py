# SPDX-License-Identifier: BSD-3-Clause
"""The VTK classes in Python, in C++ and the program make the same surface of the example scene."""
import os
import subprocess
import tempfile
import unittest

import freespace

PROGRAM = os.environ['FREESPACE_PROGRAM']
SCENE = os.environ['FREESPACE_SCENE']
CELLS = 128  # 0 is the default; a coarse lattice is enough here
CXX_PIPELINE = os.environ['FREESPACE_CXX_PIPELINE']


def body(file):
    """All of a PLY but the comments of its header, among which is the program's viewpoint."""
    with open(file, 'rb') as ply:
        header, body = ply.read().split(b'end_header\n', 1)
    return [line for line in header.split(b'\n') if not line.startswith(b'comment')], body


class TestOnePipeline(unittest.TestCase):
    def test_python_cxx_and_program_write_the_same_bytes(self):
        with tempfile.TemporaryDirectory() as folder:
            names = {name: os.path.join(folder, name + '.ply') for name in ('python', 'cxx', 'program')}
            subprocess.run([PROGRAM, '-q', 'reconstruct', SCENE, '-o', names['program'], '--cells', str(CELLS)],
                           check=True)
            subprocess.run([CXX_PIPELINE, SCENE, names['cxx'], str(CELLS)], check=True, stdout=subprocess.DEVNULL)
            stereo = freespace.vtkEdgeStereoReader()
            stereo.SetFileName(SCENE)
            maps = freespace.vtkDelaunayDisparityFilter()
            maps.SetInputConnection(stereo.GetOutputPort())
            surface = freespace.vtkFreespaceSurfaceFilter()
            surface.SetInputConnection(maps.GetOutputPort())
            surface.SetCells(CELLS)
            writer = freespace.vtkSurfaceWriter()
            writer.SetInputConnection(surface.GetOutputPort())
            writer.SetFileName(names['python'])
            freespace.update(writer)
            program = body(names['program'])
            self.assertGreater(len(program[1]), 1e5)
            self.assertTrue(body(names['python']) == program, 'Python and the program differ')
            self.assertTrue(body(names['cxx']) == program, 'C++ and the program differ')


if __name__ == '__main__':
    unittest.main()
