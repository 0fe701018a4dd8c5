# SPDX-License-Identifier: BSD-3-Clause
"""A contour that does not fit into the memory limit is written in pieces, or refused with an estimate."""
import json
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

SCENE = Path(__file__).resolve().parents[3] / 'Examples' / 'Data' / 'blocks'
PROGRAM = os.environ['FREESPACE_PROGRAM']


class TestMemoryLimit(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix='freespace-test-'))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        scene = json.loads((SCENE / 'scene.json').read_text())
        scene.update(clusters=scene['clusters'][:1], images=str(SCENE / 'images'), model=str(SCENE / 'sparse'))
        (cls.folder / 'scene.json').write_text(json.dumps(scene))
        cls.run_program('stereo', 'scene.json', '-o', 'features.vtm')
        cls.run_program('triangulate', 'features.vtm', '-o', 'maps.vtm')

    @classmethod
    def run_program(cls, *arguments):
        return subprocess.run([PROGRAM, *map(str, arguments)], cwd=cls.folder, capture_output=True, text=True,
                              timeout=300)

    def test_pieces_are_the_whole(self):
        # A surface that is written in pieces is not fitted and keeps its crumbs.
        for options in (('--no-fit', '--crumbs', 'keep'), ('--no-fit', '--crumbs', 'keep', '--no-sharp'),
                        ('--no-fit', '--crumbs', 'keep', '--global-shift', '1000,-2000,0.5')):
            with self.subTest(options=options):
                for name, limit in (('whole.ply', 0), ('pieces.ply', 3)):
                    result = self.run_program('contour', 'maps.vtm', '--cells', 200, '--memory-limit', limit,
                                              *options, '-o', name)
                    self.assertEqual(result.returncode, 0, result.stderr)
                    self.assertEqual('piece 2 of' in result.stderr, limit == 3, result.stderr)
                self.assertEqual((self.folder / 'pieces.ply').read_bytes(), (self.folder / 'whole.ply').read_bytes())

    def test_refused_with_an_estimate(self):
        for name, cells, limit in (('mesh.stl', 100, 1), ('mesh.ply', 65536, 1000)):
            with self.subTest(name=name):
                result = self.run_program('-q', 'contour', 'maps.vtm', '--cells', cells, '--memory-limit', limit,
                                          '-o', name)
                self.assertEqual(result.returncode, 1)
                self.assertRegex(result.stderr, r'^freespace: A surface of \d+ cells takes about \d+ MiB .* limit'
                                                r' is \d+ MiB: [^\n]*\n$')
                self.assertFalse((self.folder / name).exists())

    def test_limit_that_is_none(self):
        result = self.run_program('contour', 'maps.vtm', '--memory-limit', 'nan', '-o', 'mesh.ply')
        self.assertEqual(result.returncode, 2)


if __name__ == '__main__':
    unittest.main()
