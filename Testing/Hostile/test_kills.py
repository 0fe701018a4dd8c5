# SPDX-License-Identifier: BSD-3-Clause
"""An output is the old or the new one, wherever the process that writes it is killed, and the next run cleans up."""
import unittest

from outputs import OUTPUTS, OutputTest, content


class TestKills(OutputTest):
    def test_the_old_or_the_new_is_whole(self):
        all_kills, left = 0, 0
        for name, (make_old, make_new) in OUTPUTS.items():
            with self.subTest(name=name):
                old, new = self.made(name)
                self.run_program(make_old)
                kills = 0
                while self.run_program(make_new, status=None, KILL_AT=str(kills + 1))[0] != 0:
                    kills += 1
                    self.assertIn(content(self.folder / name), (old, new), f'killed at {kills}')
                    left += bool(self.work_folders())
                    self.run_program(make_old)
                    self.assertEqual(content(self.folder / name), old)
                    self.assertEqual(self.work_folders(), [], 'the next run removes what a killed one left')
                    if name.endswith('.vtm'):
                        parts = list((self.folder / name).with_suffix('').iterdir())
                        self.assertEqual(len(parts), len(old[1]), 'and former parts')
                self.assertEqual(content(self.folder / name), new)
                self.assertGreaterEqual(kills, 2)
                all_kills += kills
        print(f'{all_kills} kills')
        self.assertGreater(left, 0)

    def test_a_first_output_is_whole_or_absent(self):
        for name, (_, make_new) in OUTPUTS.items():
            with self.subTest(name=name):
                new = self.made(name)[1]
                kills = 0
                while self.run_program(make_new, status=None, KILL_AT=str(kills + 1))[0] != 0:
                    kills += 1
                    path = self.folder / name
                    if path.exists():
                        self.assertEqual(content(path), new, f'killed at {kills}')
                        path.unlink()
                self.assertGreaterEqual(kills, 1)


if __name__ == '__main__':
    unittest.main()
