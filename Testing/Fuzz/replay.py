#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Gives a door its seeds and all that was found before: replay.py PROGRAM DOOR"""
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import seeds


def main(program, door):
    with tempfile.TemporaryDirectory(prefix='freespace-fuzz-') as folder:
        seeds.write(door, Path(folder))
        done = subprocess.run([program, folder], env=dict(os.environ, FREESPACE_DOOR=door), stdout=subprocess.PIPE, text=True)
        lines = done.stdout.splitlines()
        print(lines[-1] if lines else 'nothing was read')
        if done.returncode == 0:
            return 0
        failed = Path(lines[-1]) if lines else None
        if failed and failed.is_file():
            print(failed.read_bytes()[:2000])
        return f'The door {door} failed with status {done.returncode}.'


if __name__ == '__main__':
    sys.exit(main(sys.argv[1], sys.argv[2]))
