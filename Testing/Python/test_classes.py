# SPDX-License-Identifier: BSD-3-Clause
"""Every class is wrapped, prints its settings and loses no setter to the wrapper."""
import re
import unittest
from pathlib import Path

import freespace

ROOT = Path(__file__).resolve().parents[2]
HEADERS = sorted(path for folder in ('Filters', 'Readers', 'Writers', 'Rendering')
                 for path in (ROOT / folder).glob('vtk*.h') if '@class' in path.read_text())
# Macros that declare Set methods, and Set methods that are written out; those that take a class of the core are for C++.
SETTERS = re.compile(r'vtkSet(?:Clamp|Vector[234]|Object|FilePathString)?Macro\(\s*(\w+)|'
                     r'(?:void|virtual void) Set(\w+)\((?!freespace::)')


class TestClasses(unittest.TestCase):
    def test_headers_are_found(self):
        self.assertGreater(len(HEADERS), 5)

    def test_every_class_is_wrapped_with_its_setters(self):
        for header in HEADERS:
            with self.subTest(header=header.name):
                made = getattr(freespace, header.stem)()
                for match in SETTERS.finditer(header.read_text().split('protected:')[0]):
                    setter = 'Set' + (match[1] or match[2])
                    self.assertTrue(hasattr(made, setter), f'{header.stem} has no {setter} in Python')

    def test_every_class_prints_its_settings(self):
        for header in HEADERS:
            with self.subTest(header=header.name):
                text = str(getattr(freespace, header.stem)())
                for match in re.finditer(r'vtkGet(?:FilePathString)?Macro\(\s*(\w+)', header.read_text()):
                    self.assertIn(match[1], text)


if __name__ == '__main__':
    unittest.main()
