#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that the source tree keeps the architecture that ARCHITECTURE.md describes.

    check_architecture.py SOURCE

- No file of a Core folder includes a VTK header.
- No include cycle between files, and none between folders; no import cycle between Python files.
- No code file has more than 500 lines, no folder more than 20 files, no function more than 80 lines.
- The files and functions of the table in ARCHITECTURE.md exist.

Prints each fault and exits with 1 if there is one.
"""
import ast
import os
import re
import sys

ROOTS = ['Filters', 'Readers', 'Rendering', 'Writers', 'Wrapping', 'ParaView']
INCLUDE_DIRS = ['Filters/Core', 'Readers/Core', 'Rendering/Core', 'Filters', 'Readers', 'Rendering',
                'Writers', 'Wrapping/CommandLine', 'ParaView/Phi', 'ParaView/Texture', 'Testing']
MOST_LINES = 500
MOST_FILES = 20
MOST_FUNCTION_LINES = 80
CODE = ('.h', '.cxx', '.py', '.js')
TEXT = CODE + ('.c', '.css', '.cmake', '.glsl', '.html', '.in', 'CMakeLists.txt') # and scripts without an ending


def code_files(source, roots):
    for root in roots:
        for folder, _, names in os.walk(os.path.join(source, root)):
            for name in sorted(names):
                if name.endswith(CODE):
                    yield os.path.relpath(os.path.join(folder, name), source)


def includes(source, file, known):
    """The project's own files that a file includes."""
    with open(os.path.join(source, file), encoding='utf-8') as text:
        for name in re.findall(r'^\s*#\s*include\s*["<]([^">]+)[">]', text.read(), re.M):
            for folder in [os.path.dirname(file)] + INCLUDE_DIRS:
                path = os.path.normpath(os.path.join(folder, name))
                if path in known:
                    yield path
                    break


def imports(source, file, known):
    """The Python files of its own folder that a Python file imports."""
    with open(os.path.join(source, file), encoding='utf-8') as text:
        tree = ast.parse(text.read())
    for node in ast.walk(tree):
        names = []
        if isinstance(node, ast.ImportFrom):
            names = [node.module] if node.module else [alias.name for alias in node.names]
        elif isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        for name in names:
            path = os.path.join(os.path.dirname(file), name + '.py')
            if path in known:
                yield path


def find_cycle(graph):
    """A cycle of a graph as a list of nodes, or None. Depth-first search."""
    done, path = set(), []

    def visit(node):
        if node in path:
            return path[path.index(node):] + [node]
        if node in done:
            return None
        path.append(node)
        for other in sorted(graph.get(node, ())):
            cycle = visit(other)
            if cycle:
                return cycle
        path.pop()
        done.add(node)
        return None

    for node in sorted(graph):
        cycle = visit(node)
        if cycle:
            return cycle
    return None


def check_core(source, faults):
    count = 0
    for file in code_files(source, ROOTS):
        if '/Core/' not in file:
            continue
        count += 1
        with open(os.path.join(source, file), encoding='utf-8') as text:
            for line in text:
                if re.match(r'\s*#\s*include\s*[<"]vtk', line):
                    faults.append(f'{file} is in the core but includes VTK: {line.strip()}')
    if count == 0:
        faults.append(f'No core files under {source}.')


def check_cycles(source, faults):
    files = list(code_files(source, ROOTS + ['Testing', 'Examples']))
    known = set(files)
    file_graph = {file: set((imports if file.endswith('.py') else includes)(source, file, known)) for file in files}
    folder_graph = {}
    for file, others in file_graph.items():
        folder = os.path.dirname(file)
        links = folder_graph.setdefault(folder, set())
        links.update(os.path.dirname(other) for other in others)
        links.discard(folder)
    for kind, graph in (('files', file_graph), ('folders', folder_graph)):
        cycle = find_cycle(graph)
        if cycle:
            faults.append(f'Include cycle between {kind}: ' + ' -> '.join(cycle))


def text_files(source):
    """All that is written by hand, the scripts among it."""
    for root in ROOTS + ['Testing', 'Examples', 'Packaging', '.ci']:
        for folder, _, names in os.walk(os.path.join(source, root)):
            for name in sorted(names):
                if name.endswith(TEXT) or ('.' not in name and os.access(os.path.join(folder, name), os.X_OK)):
                    yield os.path.relpath(os.path.join(folder, name), source)
    yield 'CMakeLists.txt'


def check_sizes(source, faults):
    for file in text_files(source):
        with open(os.path.join(source, file), encoding='utf-8', errors='replace') as text:
            lines = sum(1 for _ in text)
        if lines > MOST_LINES:
            faults.append(f'{file} has {lines} lines, more than {MOST_LINES}.')
    for root in ROOTS + ['Testing', 'Examples']:
        for folder, _, names in os.walk(os.path.join(source, root)):
            files = [name for name in names if name.endswith(CODE + ('.txt', '.html', '.css'))]
            if 'images' not in folder and '__pycache__' not in folder and len(files) > MOST_FILES:
                place = os.path.relpath(folder, source)
                faults.append(f'{place} has {len(files)} files, more than {MOST_FILES}.')


def cxx_functions(lines):
    """First and last line of each function, by the layout that clang-format keeps: the braces of a function
    stand alone, in the column of its first line."""
    for begin, line in enumerate(lines):
        brace = re.match(r'( *){$', line)
        if not brace:
            continue
        head = begin
        while head > 0 and re.search(r'\S', lines[head - 1]) and not re.search(r'[;{}]$|:$', lines[head - 1]):
            head -= 1
        while head < begin and re.match(r' *(//|/?\*)', lines[head]):
            head += 1
        words = ' '.join(lines[head:begin]).strip()
        if '(' not in words or re.match(r'(namespace|class|struct|union|enum|extern|template.*(class|struct) \w+$)\b', words):
            continue
        indent = brace.group(1)
        end = next((i for i in range(begin, len(lines)) if lines[i].startswith(indent + '}')), len(lines) - 1)
        yield head + 1, end + 1


def python_functions(text):
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.FunctionDef):
            yield node.lineno, node.end_lineno


def check_functions(source, faults):
    count = 0
    for file in code_files(source, ROOTS + ['Testing', 'Examples']):
        if file.endswith('.js'):
            continue
        with open(os.path.join(source, file), encoding='utf-8') as opened:
            text = opened.read()
        functions = python_functions(text) if file.endswith('.py') else cxx_functions(text.split('\n'))
        for begin, end in functions:
            count += 1
            if end - begin + 1 > MOST_FUNCTION_LINES:
                faults.append(f'{file}:{begin} is a function of {end - begin + 1} lines, '
                              f'more than {MOST_FUNCTION_LINES}.')
    if count == 0:
        faults.append(f'No functions under {source}.')


def check_table(source, faults):
    """The way of a feature: a row has files, those after the first perhaps without their folder, and functions."""
    with open(os.path.join(source, 'ARCHITECTURE.md'), encoding='utf-8') as text:
        rows = re.findall(r'^\| .* \| (`.*`) \| (.*`.*) \|$', text.read(), re.M)
    if not rows:
        faults.append('ARCHITECTURE.md has no table of files and functions.')
    for files, functions in rows:
        code, folder = '', ''
        for name in re.findall(r'`([^`]+)`', files):
            folder = os.path.dirname(name) or folder
            path = os.path.join(folder, os.path.basename(name))
            if not os.path.exists(os.path.join(source, path)):
                faults.append(f'ARCHITECTURE.md names {path}, which is not there.')
                continue
            for file in {path, path.replace('.cxx', '.h')}:
                if os.path.exists(os.path.join(source, file)):
                    with open(os.path.join(source, file), encoding='utf-8') as text:
                        code += text.read()
        for function in re.findall(r'`([^`]+)`', functions):
            if not re.search(r'\b' + re.escape(function.split('::')[-1]) + r'\b', code):
                faults.append(f'ARCHITECTURE.md names {function}, which is not in {files}.')


def main():
    source = sys.argv[1]
    faults = []
    check_core(source, faults)
    check_cycles(source, faults)
    check_sizes(source, faults)
    check_functions(source, faults)
    check_table(source, faults)
    print('\n'.join(faults) if faults else 'The architecture is kept.')
    sys.exit(1 if faults else 0)


if __name__ == '__main__':
    main()
