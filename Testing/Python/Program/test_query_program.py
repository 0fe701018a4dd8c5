# SPDX-License-Identifier: BSD-3-Clause
"""freespace query: points of a file and of the standard input."""
import subprocess
import unittest

from test_pictures import PROGRAM, WithScene

ROWS = 'x,y,z\n0,0,0\n100,0,0\n0 0 100\n'


class TestQuery(WithScene):
    def query(self, *arguments, text=''):
        return subprocess.run([PROGRAM, '-q', 'query', 'maps.vtm', *arguments], cwd=self.folder, input=text,
                              capture_output=True, text=True, timeout=300)

    def test_a_dash_is_the_standard_input(self):
        (self.folder / 'points.csv').write_text(ROWS)
        told = self.query('--points', 'points.csv')
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assertEqual(told.stdout.splitlines()[0], 'free')
        self.assertEqual(told.stdout.splitlines()[2:], ['unknown', 'unknown'])  # far beyond the hull
        self.assertEqual(self.query('--points', '-', text=ROWS).stdout, told.stdout)

    def test_a_standard_input_that_cannot_be(self):
        for text, fault in (('', 'is empty'), ('1,2\n', 'line 1')):
            told = self.query('--points', '-', text=text)
            self.assertEqual(told.returncode, 1)
            self.assertIn('the standard input', told.stderr)
            self.assertIn(fault, told.stderr)


if __name__ == '__main__':
    unittest.main()
