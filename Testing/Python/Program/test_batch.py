# SPDX-License-Identifier: BSD-3-Clause
"""freespace run: many scenes, killed in the middle, and bad batches."""
import csv
import json
import os
import signal
import subprocess
import time
import unittest

from test_program import PROGRAM, WithFolder, run
from test_surface_commands import sphere, write

STEPS = ['mesh {scene} --scale 2 -o large.ply', 'mesh large.ply --smooth 0.1 -o smooth.ply',
         ['compare', 'smooth.ply', '{folder}/{name}.ply', '--samples', '0', '--json', 'errors.json'], 'info smooth.ply --json info.json']
TABLE = {'triangles': 'info.json:/triangles', 'F': 'errors.json:/f/0'}


class TestBatch(WithFolder):
    def setUp(self):
        super().setUp()
        self.scenes = []
        for i in range(20):
            self.scenes.append(self.folder / f'scene{i:02}.ply')
            write(sphere(1 + 0.01 * i, resolution=12 + i), self.scenes[-1])
        self.batch(steps=STEPS, table=TABLE)

    def batch(self, **content):
        (self.folder / 'batch.json').write_text(json.dumps(content))

    def results(self, folder='results'):
        return {str(path.relative_to(self.folder / folder)): path.read_bytes()
                for path in (self.folder / folder).glob('*/*') if path.suffix in ('.ply', '.json') and path.name != 'steps.json'}

    def logs(self):
        return {path: path.stat().st_mtime_ns for path in (self.folder / 'results').glob('*/*.log')}

    def done(self):
        """The logs of the steps that are on record."""
        logs = {}
        for record in (self.folder / 'results').glob('*/steps.json'):
            for stage in json.loads(record.read_text())['stages']:
                log = record.parent / f'{stage}.log'
                logs[log] = log.stat().st_mtime_ns
        return logs

    def test_killed_in_its_middle_it_goes_on_where_it_was(self):
        whole = self.succeed('-q', 'run', 'batch.json', *self.scenes, '-o', 'whole')
        process = subprocess.Popen([PROGRAM, '-q', 'run', 'batch.json', *self.scenes, '-o', 'results', '--jobs', '2'],
                                   cwd=self.folder, stdout=subprocess.DEVNULL)
        while len(self.done()) < 25 and process.poll() is None:
            time.sleep(0.01)
        self.assertIsNone(process.poll(), 'it is killed before its end')
        process.send_signal(signal.SIGKILL)
        process.wait()
        deadline = time.monotonic() + 20
        before = self.done()
        while time.monotonic() < deadline:  # its steps end with it
            result = run('-q', 'run', 'batch.json', *self.scenes, '-o', 'results', '--table', 'table.csv', cwd=self.folder)
            if 'at work' not in result.stderr:
                break
        self.assertEqual(result.returncode, 0, result.stderr)
        after = self.logs()
        self.assertEqual(len(after), 80)
        self.assertGreaterEqual(len(before), 25)
        for log, when in before.items():
            self.assertEqual(after[log], when, f'{log} was done again')
        self.assertEqual(self.results(), self.results('whole'))
        rows = list(csv.DictReader((self.folder / 'table.csv').read_text().splitlines()))
        self.assertEqual([row['scene'] for row in rows], [scene.stem for scene in self.scenes])
        for row, scene in zip(rows, self.scenes):
            info = json.loads((self.folder / 'results' / scene.stem / 'info.json').read_text())
            self.assertEqual(row['triangles'], str(info['triangles']))
            self.assertEqual((row['steps'], row['fault']), ('4 of 4', ''))
        self.assertEqual(len(whole.stdout.splitlines()), 21)

    def test_does_again_what_is_no_longer_so(self):
        scenes = self.scenes[:2]
        self.succeed('run', 'batch.json', *scenes, '-o', 'results')
        before = self.logs()
        self.succeed('run', 'batch.json', *scenes, '-o', 'results')
        self.assertEqual(self.logs(), before, 'nothing to do')
        (self.folder / 'results' / 'scene00' / 'smooth.ply').unlink()
        self.succeed('run', 'batch.json', *scenes, '-o', 'results')
        changed = sorted(str(path.relative_to(self.folder / 'results')) for path, when in self.logs().items() if before[path] != when)
        self.assertEqual(changed, [f'scene00/{log}.log' for log in ('02-mesh', '03-compare', '04-info')])
        before = self.logs()
        self.batch(steps=[*STEPS[:3], 'info large.ply --json info.json'])
        self.succeed('run', 'batch.json', *scenes, '-o', 'results')
        self.assertEqual({path.name for path, when in self.logs().items() if before[path] != when}, {'04-info.log'})
        before = self.logs()
        os.utime(scenes[1])
        self.succeed('run', 'batch.json', *scenes, '-o', 'results')
        self.assertEqual({path.parent.name for path, when in self.logs().items() if before[path] != when}, {'scene01'})

    def test_a_scene_that_fails_stops_no_other(self):
        bad = self.folder / 'bad.ply'
        bad.write_text('no mesh')
        result = run('-q', 'run', 'batch.json', bad, *self.scenes[:2], '-o', 'results', cwd=self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertIn('1 of 3 scenes failed', result.stderr)
        rows = result.stdout.splitlines()
        self.assertRegex(rows[1], r'^bad +0 of 4 .*01-mesh: Cannot read ')
        self.assertRegex(rows[2], r'^scene00 +4 of 4 ')

    def test_bad_batches_are_one_sentence(self):
        for content, word in (('', 'batch.json'), ('[]', 'steps'), ('{"steps": []}', 'steps'), ('{"steps": ["cook x"]}', 'cook'),
                              ('{"steps": ["run batch.json"]}', "'run'"), ('{"steps": [[1]]}', 'word'), ('{"steps": [{}]}', 'step'),
                              ('{"steps": ["info x"], "tabel": {}}', 'tabel'),
                              ('{"steps": ["info x"], "table": {"a": "b.json"}}', "'a'")):
            (self.folder / 'batch.json').write_text(content)
            with self.subTest(content=content):
                result = run('run', 'batch.json', self.scenes[0], '-o', 'results', cwd=self.folder)
                self.assertEqual(result.returncode, 1)
                self.assertEqual(result.stderr.count('\n'), 1)
                self.assertIn(word, result.stderr)
                self.assertFalse((self.folder / 'results').exists())

    def test_scenes_have_names_of_their_own(self):
        result = run('run', 'batch.json', self.scenes[0], self.scenes[0], '-o', 'results', cwd=self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertIn("'scene00'", result.stderr)


if __name__ == '__main__':
    unittest.main()
