#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Seeds for the fuzzer, from the example scene, the table of bad inputs and what was found before (Seeds/).

    seeds.py FOLDER     writes FOLDER/DOOR/...
"""
import base64
import hashlib
import shutil
import struct
import sys
import zlib
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / 'Hostile'))
import table # noqa: E402

SCENE = HERE.parents[1] / 'Examples' / 'Data' / 'blocks'
MARK = b'%%%%\n' # as in FuzzFiles.cxx
MOST = 20000 # bytes of a seed


def as_bytes(content):
    return content if isinstance(content, bytes) else content.encode()


def joined(parts):
    return MARK.join(as_bytes(part) for part in parts)


def models():
    yield joined(['t\n', *(table.MODEL[name + '.txt'] for name in ('cameras', 'images', 'points3D'))])
    for files in table.MODELS.values():
        ending = '.bin' if any(name.endswith('.bin') for name in files) else '.txt'
        yield joined([ending[1] + '\n', *(files.get(f'bad/{name}{ending}', '') for name in ('cameras', 'images', 'points3D'))])
    yield joined(['t\n', *(small_model(name) for name in ('cameras', 'images', 'points3D'))])
    yield joined([b'b\n', *binary_model()])
    yield b'o# Bundle file v0.3\n1 1\n500 0 0\n1 0 0\n0 1 0\n0 0 1\n0 0 0\n0 0 5\n255 0 0\n1 0 0 10 10\n' + MARK + b'a.jpg\n'
    yield b'n' + MARK + b'NVM_V3\n\n1\na.jpg 500 1 0 0 0 0 0 0 0 0\n\n1\n0 0 5 255 0 0 1 0 0 10 10\n'


def small_model(name):
    """The first lines of a model that COLMAP wrote."""
    lines = (SCENE / 'sparse' / f'{name}.txt').read_text().splitlines(True)
    return ''.join(lines[:12])[:MOST // 3]


def binary_model():
    yield struct.pack('<QiiQQ4d', 1, 1, 1, 640, 480, 500, 500, 320, 240)
    yield struct.pack('<Qi7di', 1, 1, 1, 0, 0, 0, 0, 0, 0, 1) + b'a.jpg\0' + struct.pack('<Q2dq', 1, 10, 10, 1)
    yield struct.pack('<QQ3d3Bd', 1, 1, 0, 0, 5, 9, 9, 9, 0.5) + struct.pack('<Qii', 1, 1, 0)


def scenes():
    yield (SCENE / 'scene.json').read_bytes()
    yield table.scene()
    yield table.scene(board={'type': 'chessboard', 'corners': [9, 6], 'square_m': 0.03}, masks='masks')
    yield table.scene(board={'type': 'charuco', 'squares': [15, 15], 'square_m': 0.03, 'marker_m': 0.02,
                             'dictionary': 'DICT_5X5_250'})
    yield from table.SCENES.values()


def boards():
    yield 'charuco:15x15:0.03:0.0225:DICT_5X5_250'
    yield 'chessboard:9x6:0.025'
    for row in table.ROWS:
        if '--board' in row[2]:
            yield row[2][row[2].index('--board') + 1]


def tables():
    yield from table.TABLES.values()
    yield 'x,y,z\n1,2,3\n-4e-5 +6 7\n'
    yield b'\xef\xbb\xbfa;b\r\n\r\n1 2 3 4 5 6\r\n'


def array(name, kind, components, values, how):
    numbers = {'Float64': '<d', 'Int64': '<q', 'Int32': '<i'}
    if how == 'ascii':
        text = ' '.join(repr(value) for value in values)
    else:
        data = b''.join(struct.pack(numbers[kind], value) for value in values)
        packed = zlib.compress(data)
        text = (base64.b64encode(struct.pack('<4I', 1, len(data), 0, len(packed))) + base64.b64encode(packed)
                if how == 'zlib' else base64.b64encode(struct.pack('<I', len(data)) + data)).decode()
    return (f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" NumberOfTuples="'
            f'{len(values) // components}" format="{"ascii" if how == "ascii" else "binary"}">{text}</DataArray>')


def view_vtp(how='ascii', n=3):
    """A view of n x n features with its triangles, as a disparity map."""
    points, pixels, triangles = [], [], []
    for i in range(n * n):
        x, y, z = (i % n - 1) * 0.5, (i // n - 1) * 0.5, 4.0
        points += [x, y, z]
        pixels += [320 + 500 * x / z, 240 + 500 * y / z]
    for i in range((n - 1) * (n - 1)):
        a = i // (n - 1) * n + i % (n - 1)
        triangles += [a, a + 1, a + n, a + 1, a + n + 1, a + n]
    count = len(triangles) // 3
    field = (array('CameraIntrinsics', 'Float64', 9, [500., 0., 320., 0., 500., 240., 0., 0., 1.], how)
             + array('CameraFromWorld', 'Float64', 12, [1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., 0.], how)
             + array('ImageSize', 'Int32', 2, [640, 480], how)
             + '<Array type="String" Name="ImageFile" NumberOfTuples="1" format="ascii">97 46 106 0</Array>')
    compressor = ' compressor="vtkZLibDataCompressor"' if how == 'zlib' else ''
    return (f'<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt32"{compressor}>'
            f'<PolyData><FieldData>{field}</FieldData><Piece NumberOfPoints="{n * n}" NumberOfVerts="0" '
            f'NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="{count}"><PointData>'
            + array('ImagePoint', 'Float64', 2, pixels, how) + array('SourceView', 'Int32', 1, [0] * (n * n), how)
            + '</PointData><Points>' + array('Points', 'Float64', 3, points, how) + '</Points><Polys>'
            + array('connectivity', 'Int64', 1, triangles, how)
            + array('offsets', 'Int64', 1, [3 * i + 3 for i in range(count)], how) + '</Polys></Piece></PolyData></VTKFile>')


def blocks_of(count):
    return table.vtm(''.join(f'<DataSet index="{i}" name="{c}" file="{c}.vtp"/>' for i, c in enumerate('abcd'[:count])))


def view_files():
    for how in ('ascii', 'binary', 'zlib'):
        yield joined([blocks_of(1), view_vtp(how)])
    yield joined([blocks_of(2), view_vtp(), view_vtp('zlib')])
    for files in table.BLOCKS.values():
        yield joined([files['a.vtm'], files.get('a.vtp', '')])


def vtps():
    for name, content in table.SURFACES.items():
        if name.endswith('.vtp'):
            yield content
    for how in ('ascii', 'binary', 'zlib'):
        yield view_vtp(how)


def surfaces():
    binary = table.PLY.replace('ascii', 'binary_little_endian').replace('float x', 'double x')
    yield b'p' + as_bytes(binary) + struct.pack('<dff', 0, 0, 0) * 3 + struct.pack('<B3i', 3, 0, 1, 2)
    yield 'p' + table.PLY + table.CORNERS + '3 0 1 2\n'
    yield b's' + b' ' * 80 + struct.pack('<I', 1) + struct.pack('<12fH', *range(12), 0)
    yield 'ssolid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n'
    yield 'o' + table.OBJ + 'vt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 -1//1\n'
    for name, content in table.SURFACES.items():
        kind = name.rpartition('.')[2][:1]
        if kind in 'pso' and not name.endswith('.vtp'):
            yield kind.encode() + as_bytes(content)


def blocks():
    yield b''
    for change in range(1, 9): # of each array in turn
        for at in range(8):
            yield bytes([0, 0]) + bytes(60 * at) + bytes([change]) + bytes(40)
    for value in (1, 120, *range(240, 256)):
        yield bytes([1] + [0, value] * 200)


def configs():
    yield '[contour]\ncells=64\nsharp-edges=on\n'
    yield 'quiet=true\nthreads=2\n[reconstruct]\nscene="scene.json"\noutput="mesh.ply"\nregion="auto"\n'
    yield from ('colour=1\n', '[cook]\na=1\n', '[contour]\ncells=x\n', '[contour.deeper]\na=1\n', '"""', "a=[1,2,3]\n")


DOORS = {'models': models, 'scene': scenes, 'board': boards, 'table': tables, 'views': view_files, 'vtp': vtps,
         'surfaces': surfaces, 'blocks': blocks, 'config': configs}


def write(door, folder):
    folder.mkdir(parents=True, exist_ok=True)
    for content in DOORS[door]():
        content = as_bytes(content)[:MOST]
        (folder / hashlib.sha1(content).hexdigest()).write_bytes(content)
    kept = HERE / 'Seeds' / door
    for path in sorted(kept.iterdir()) if kept.is_dir() else []:
        shutil.copy(path, folder / path.name)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    for door in DOORS:
        write(door, Path(sys.argv[1]) / door)


if __name__ == '__main__':
    main()
