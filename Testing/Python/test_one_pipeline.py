# SPDX-License-Identifier: BSD-3-Clause
"""The VTK classes in Python, in C++ and the program make the same surface of the example scene."""
import os
import subprocess
import tempfile
import unittest

import freespace

PROGRAM = os.environ['FREESPACE_PROGRAM']
SCENE = os.environ['FREESPACE_SCENE']
CXX_PIPELINE = os.environ['FREESPACE_CXX_PIPELINE']


def body(file):
    """All of a PLY but the comments of its header, among which is the program's viewpoint."""
    with open(file, 'rb') as ply:
        header, body = ply.read().split(b'end_header\n', 1)
    return [line for line in header.split(b'\n') if not line.startswith(b'comment')], body


def pipeline(out):
    """Images to a file, all by connections and with the defaults of every class."""
    stereo = freespace.vtkEdgeStereoReader()
    stereo.SetFileName(SCENE)
    maps = freespace.vtkDelaunayDisparityFilter()
    maps.SetInputConnection(stereo.GetOutputPort())
    surface = freespace.vtkFreespaceSurfaceFilter()
    surface.SetInputConnection(maps.GetOutputPort())
    writer = freespace.vtkSurfaceWriter()
    writer.SetInputConnection(surface.GetOutputPort())
    writer.SetFileName(out)
    return stereo, maps, surface, writer


class TestOnePipeline(unittest.TestCase):
    def test_python_cxx_and_program_write_the_same_bytes(self):
        with tempfile.TemporaryDirectory() as folder:
            names = {name: os.path.join(folder, name + '.ply') for name in ('python', 'cxx', 'program', 'released')}
            subprocess.run([PROGRAM, '-q', 'reconstruct', SCENE, '-o', names['program']], check=True)
            subprocess.run([CXX_PIPELINE, SCENE, names['cxx']], check=True, stdout=subprocess.DEVNULL)
            freespace.update(pipeline(names['python'])[-1])
            program = body(names['program'])
            self.assertGreater(len(program[1]), 1e5)
            self.assertTrue(body(names['python']) == program, 'Python and the program differ')
            self.assertTrue(body(names['cxx']) == program, 'C++ and the program differ')
            self.check_released_data(names['released'], program)

    def check_released_data(self, out, expected):
        """Each stage lets go of its output when the next one has used it, and the file is the same."""
        stages = pipeline(out)
        for stage in stages[:-1]:
            stage.ReleaseDataFlagOn()
        freespace.update(stages[-1])
        self.assertTrue(body(out) == expected, 'released data change the surface')
        for stage in stages[:-1]:
            output = stage.GetOutputDataObject(0)
            self.assertTrue(output.GetDataReleased(), stage.GetClassName())
            self.assertEqual(output.GetNumberOfPoints(), 0, stage.GetClassName())
        # The writer has the surface made again from the start, which another file shows.
        os.remove(out)
        stages[2].SetCells(32)
        freespace.update(stages[-1])
        self.assertGreater(len(body(out)[1]), 1e4)
        self.assertTrue(stages[0].GetOutputDataObject(0).GetDataReleased())


if __name__ == '__main__':
    unittest.main()
