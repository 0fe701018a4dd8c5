# SPDX-License-Identifier: BSD-3-Clause
"""Runs the table of bad inputs: each row in a folder of its own, beside links to the good inputs.

    run.py [WORDS]       only rows whose name has the words

FREESPACE_PROGRAM is the program.
"""
import json
import os
import re
import subprocess
import sys
import tempfile
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from table import ROWS

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ['FREESPACE_PROGRAM']
SCENE = ROOT / 'Examples' / 'Data' / 'blocks'
MOST_SECONDS, MOST_MEGABYTES, PATIENCE = 5, 500, 60
# What libraries say by themselves, which is no sentence for people.
FOREIGN = ('json.exception', 'terminate called', 'what():', 'vtk', 'CLI11', 'filesystem error', 'std::', 'tbb', 'OpenCV',
           'libpng', 'XML', 'Traceback', 'basic_string')


def make_good_inputs(folder):
    for name in ('images', 'sparse'):
        (folder / name).symlink_to(SCENE / name)
    scene = json.loads((SCENE / 'scene.json').read_text())
    scene['clusters'] = scene['clusters'][:1]
    (folder / 'scene.json').write_text(json.dumps(scene))
    (folder / 'model').symlink_to(SCENE / 'sparse')
    (folder / 'points.csv').write_text('0,0,0\n')
    for arguments in (['stereo', 'scene.json', '-o', 'features.vtm', '--every-image', 'off', '--refine-cameras', 'off'],
                      ['triangulate', 'features.vtm', '-o', 'maps.vtm'],
                      ['contour', 'maps.vtm', '-o', 'mesh.ply', '--cells', '16', '--no-fit']):
        subprocess.run([PROGRAM, '-q', *arguments], cwd=folder, check=True)


def entries(folder):
    return {str(path.relative_to(folder)): None if path.is_dir() else path.read_bytes()
            for path in folder.rglob('*') if not path.is_symlink()}


def start(arguments, folder):
    """Runs the program; its exit status, standard error, seconds and megabytes."""
    with tempfile.TemporaryFile() as words:
        process = subprocess.Popen([PROGRAM, '-q', *arguments], cwd=folder, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=words)
        timer = threading.Timer(PATIENCE, process.kill)
        timer.start()
        _, status, usage = os.wait4(process.pid, 0)
        timer.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
        words.seek(0)
        return process.returncode, words.read().decode(errors='replace'), usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def faults(row, good):
    """What is wrong with the program's answer to a row."""
    name, files, arguments, status, sentence = row
    with tempfile.TemporaryDirectory(prefix='freespace-hostile-') as text:
        folder = Path(text)
        for path in good.iterdir():
            (folder / path.name).symlink_to(path)
        for file, content in files.items():
            (folder / file).parent.mkdir(parents=True, exist_ok=True)
            (folder / file).write_bytes(content if isinstance(content, bytes) else content.encode())
        before = entries(folder)
        code, words, seconds, megabytes = start(arguments, folder)
        wrong = [] if code == status else [f'status {code}, not {status}']
        lines = words.splitlines()
        if len(lines) != 1 or not lines[0].startswith('freespace: '):
            wrong.append(f'{len(lines)} lines')
        elif not re.search(sentence, lines[0]):
            wrong.append(f'not about {sentence}')
        wrong += [f'a word of a library: {word}' for word in FOREIGN if word in words.replace('.vtk', '')]
        wrong += ['a control character'] if re.search(r'[\x00-\x09\x0b-\x1f\x7f]', words) else []
        wrong += ['something was written'] if entries(folder) != before else []
        wrong += [f'{seconds:.1f} s'] if seconds > MOST_SECONDS else []
        wrong += [f'{megabytes:.0f} MB'] if megabytes > MOST_MEGABYTES else []
        return f'{name}: {", ".join(wrong)}: {words[:300]!r}' if wrong else ''


def main():
    chosen = [row for row in ROWS if all(word in row[0] for word in sys.argv[1:])]
    with tempfile.TemporaryDirectory(prefix='freespace-hostile-good-') as good:
        make_good_inputs(Path(good))
        with ThreadPoolExecutor(2) as pool:
            wrong = 0
            for fault in pool.map(lambda row: faults(row, Path(good)), chosen):
                wrong += bool(fault)
                if fault:
                    print(fault, flush=True)
    print(f'{len(chosen)} rows, {wrong} wrong')
    return 1 if wrong or not chosen else 0


if __name__ == '__main__':
    sys.exit(main())
