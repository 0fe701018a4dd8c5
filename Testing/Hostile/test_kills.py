# SPDX-License-Identifier: BSD-3-Clause
"""An output is the old or the new one, wherever the process that writes it is killed, and the next run cleans up."""
import os
import signal
import time
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


class TestTwoWriters(OutputTest):
    def test_one_of_the_two_is_there(self):
        """One stops at each point where a file moves; meanwhile the other one begins to write the same output, and waits
        for the first one where that holds the folder."""
        waited = 0
        for name, (make_old, make_new) in OUTPUTS.items():
            with self.subTest(name=name):
                old, new = self.made(name)
                stops, is_stopped = 0, True
                while is_stopped:
                    first = self.start(make_old, STOP_AT=str(stops + 1))
                    is_stopped = self.wait_until_stopped(first)
                    second = self.start(make_new) if is_stopped else None
                    if is_stopped:
                        stops += 1
                        waited += self.is_waiting(second)
                        first.send_signal(signal.SIGCONT)
                    for process in filter(None, (first, second)):
                        words = process.communicate()[1]
                        self.assertEqual(process.returncode, 0, words)
                    self.assertIn(content(self.folder / name), (old, new), f'stopped at {stops}')
                    self.assertEqual(self.work_folders(), [])
                self.assertGreaterEqual(stops, 2)
        self.assertGreater(waited, 0)

    def wait_until_stopped(self, process):
        """False where it ended instead."""
        _, status = os.waitpid(process.pid, os.WUNTRACED)
        if os.WIFSTOPPED(status):
            return True
        process.returncode = os.waitstatus_to_exitcode(status)
        return False

    def is_waiting(self, process):
        """Waits until a process has ended (False) or waits for a lock (True)."""
        while process.poll() is None:
            with open('/proc/locks') as locks:
                if any('->' in line and f' {process.pid} ' in line for line in locks):
                    return True
            time.sleep(0.05)
        return False


if __name__ == '__main__':
    unittest.main()
