# SPDX-License-Identifier: BSD-3-Clause
"""A .vtm and its parts are the old or the new ones, wherever the process that writes them is killed.

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


def content(vtm):
    """The index without the names of the parts, and the parts that it refers to."""
    text = vtm.read_text()
    parts = re.findall(r'file="([^"]*)"', text)
    return re.sub(r'file="[^"]*"', '', text), [(vtm.parent / part).read_bytes() for part in parts]


class TestKills(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix='freespace-test-'))
        self.addCleanup(shutil.rmtree, self.folder)
        for name in ('images', 'sparse'):
            (self.folder / name).symlink_to(SCENE / name)
        scene = json.loads((SCENE / 'scene.json').read_text())
        scene['clusters'] = scene['clusters'][:2]
        (self.folder / 'scene.json').write_text(json.dumps(scene))
        self.run_program('stereo', 'scene.json', '-o', 'features.vtm', '--every-image', 'off', '--refine-cameras', 'off')

    def run_program(self, *arguments, kill_at=None):
        environment = dict(os.environ)
        if kill_at is not None:
            environment.update(LD_PRELOAD=KILLPOINT, KILL_AT=str(kill_at))
        code = subprocess.run([PROGRAM, '-q', *arguments], cwd=self.folder, env=environment).returncode
        if kill_at is None:
            self.assertEqual(code, 0)
        return code

    def triangulate(self, output, neighbors, kill_at=None):
        return self.run_program('triangulate', 'features.vtm', '-o', output, '--neighbors', str(neighbors), kill_at=kill_at)

    def work_folders(self):
        return [path.name for path in self.folder.iterdir() if path.name.startswith('.freespace-')]

    def test_the_old_or_the_new_is_whole(self):
        maps = self.folder / 'maps.vtm'
        self.triangulate('new.vtm', 0)
        new = content(self.folder / 'new.vtm')
        self.triangulate('maps.vtm', 3)
        old = content(maps)
        self.assertNotEqual(old, new)
        left, kills = 0, 0
        while self.triangulate('maps.vtm', 0, kill_at=kills + 1) != 0:
            kills += 1
            self.assertIn(content(maps), (old, new), f'killed at {kills}')
            left += bool(self.work_folders())
            self.triangulate('maps.vtm', 3)
            self.assertEqual(content(maps), old)
            self.assertEqual(self.work_folders(), [], 'the next run removes what a killed one left')
            self.assertEqual(len(list((self.folder / 'maps').iterdir())), len(old[1]))
        self.assertEqual(content(maps), new)
        self.assertGreaterEqual(kills, 4)
        self.assertGreater(left, 0)


if __name__ == '__main__':
    unittest.main()
