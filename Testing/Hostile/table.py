# SPDX-License-Identifier: BSD-3-Clause
"""Bad inputs over all commands, as data. run.py runs them.

A row is (name, files, arguments, status, sentence): `files` maps a file's name to its content, made in an empty
folder beside the good inputs; `sentence` is a regular expression for the one line of the standard error. The good
inputs, which rows may name, are made once: scene.json with images/ and sparse/, model (a COLMAP model of text),
features.vtm, maps.vtm, mesh.ply, points.csv. Nothing may be written, and a run takes 5 s of the processor and
500 MB at most.
"""
import json
import struct

FAILED, MISUSED = 1, 2
ROWS = []


def row(name, files, arguments, sentence, status=FAILED):
    ROWS.append((name, files, arguments, status, sentence))


# Surfaces, by the name of their file.

PLY = ('ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n'
       'element face 1\nproperty list uchar int vertex_indices\nend_header\n')
CORNERS = '0 0 0\n1 0 0\n0 1 0\n'
OBJ = 'v 0 0 0\nv 1 0 0\nv 0 1 0\n'


def vtp(points='0 0 0 1 0 0 0 1 0', connectivity='0 1 2', offsets='3', count=3, polys=1):
    return ('<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt32"><PolyData>'
            f'<Piece NumberOfPoints="{count}" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" '
            f'NumberOfPolys="{polys}"><Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">'
            f'{points}</DataArray></Points><Polys><DataArray type="Int64" Name="connectivity" format="ascii">'
            f'{connectivity}</DataArray><DataArray type="Int64" Name="offsets" format="ascii">{offsets}'
            '</DataArray></Polys></Piece></PolyData></VTKFile>')


SURFACES = {
    'empty.ply': '', 'empty.stl': '', 'empty.obj': '', 'empty.vtp': '',
    'noise.ply': b'\x93\x00\xff' * 100, 'noise.stl': b'\x93\x00\xff' * 100, 'noise.obj': b'\x93\x00\xff\n' * 100,
    'noise.vtp': b'\x93\x00\xff' * 100,
    'index.ply': PLY + CORNERS + '3 0 1 99999999\n', 'negative.ply': PLY + CORNERS + '3 0 1 -1\n',
    'list.ply': PLY + CORNERS + '255 0 1 2\n', 'two.ply': PLY + CORNERS + '2 0 1\n',
    'short.ply': PLY + '0 0 0\n', 'word.ply': PLY + '0 0 zero\n1 0 0\n0 1 0\n3 0 1 2\n',
    'nan.ply': PLY + 'nan 0 0\n1 0 0\n0 1 0\n3 0 1 2\n',
    'many.ply': PLY.replace('vertex 3', 'vertex 4000000000') + CORNERS,
    'faces.ply': PLY.replace('face 1', 'face 4000000000') + CORNERS + '3 0 1 2\n',
    'format.ply': PLY.replace('ascii', 'ebcdic') + CORNERS + '3 0 1 2\n',
    'header.ply': PLY[:60], 'none.ply': PLY.replace('face 1', 'face 0') + CORNERS,
    'count.stl': b' ' * 80 + struct.pack('<I', 4000000000) + bytes(50),
    'cut.stl': b' ' * 80 + struct.pack('<I', 2) + bytes(50), 'text.stl': 'solid a\nvertex 0 0 0\n',
    'zero.obj': OBJ + 'f 0 0 0\n', 'beyond.obj': OBJ + 'f 1 2 4\n', 'before.obj': OBJ + 'f -4 -2 -1\n',
    'two.obj': OBJ + 'f 1 2\n', 'word.obj': 'v 0 0 zero\n', 'points.obj': OBJ,
    'negative.vtp': vtp(connectivity='0 1 -9999999'), 'index.vtp': vtp(connectivity='0 1 3'),
    'offset.vtp': vtp(offsets='30000000'), 'backwards.vtp': vtp(connectivity='0 1 2 0', offsets='3 -3', polys=2),
    'count.vtp': vtp(count=2000000000), 'cells.vtp': vtp(polys=2000000000), 'cut.vtp': vtp()[:300],
    'deep.vtp': '<VTKFile type="PolyData">' + '<a>' * 300000, 'open.vtp': vtp().replace('</Polys>', ''),
    'nothing.vtp': vtp(polys=0, connectivity='', offsets=''), 'mesh.xyz': '0 0 0\n', 'mesh': '',
}
for name, content in SURFACES.items():
    sentence = f"Cannot read '?{name}'?: "
    row(f'render {name}', {name: content}, ['render', name, '-o', 'out.png'], sentence)
    row(f'texture {name}', {name: content}, ['texture', name, '--scene', 'scene.json', '-o', 'out.glb'], sentence)
    row(f'view {name}', {name: content}, ['view', 'scene.json', '--mesh', name, '-o', 'out.png'], sentence)
    row(f'mesh {name}', {name: content}, ['mesh', name, '--normals', '-o', 'out.ply'], sentence)
    row(f'compare {name}', {name: content}, ['compare', name, 'mesh.ply', '--json', 'out.json'], sentence)
    row(f'compare with {name}', {name: content}, ['compare', 'mesh.ply', name, '-o', 'out.ply'], sentence)
    if name not in ('mesh.xyz', 'mesh'):
        row(f'info {name}', {name: content}, ['info', name, '--json', 'out.json'], sentence)

# Features and disparity maps.


def vtm(inside):
    return ('<VTKFile type="vtkMultiBlockDataSet" version="1.0" byte_order="LittleEndian" header_type="UInt32">'
            f'<vtkMultiBlockDataSet>{inside}</vtkMultiBlockDataSet></VTKFile>')


BLOCK = '<DataSet index="{}" name="a" file="a.vtp"/>'
BLOCKS = {
    'empty': {'a.vtm': ''}, 'noise': {'a.vtm': b'\x93\x00\xff' * 100}, 'text': {'a.vtm': 'hello'},
    'cut': {'a.vtm': vtm(BLOCK.format(0))[:-12]}, 'none': {'a.vtm': vtm('')},
    'missing block': {'a.vtm': vtm(BLOCK.format(0))},
    'index': {'a.vtm': vtm(BLOCK.format(100000000)), 'a.vtp': vtp()},
    'index of minus one': {'a.vtm': vtm(BLOCK.format(-1)), 'a.vtp': vtp()},
    'index that is a word': {'a.vtm': vtm(BLOCK.format('x')), 'a.vtp': vtp()},
    'deep': {'a.vtm': '<VTKFile type="vtkMultiBlockDataSet">' + '<Block index="0">' * 300000},
    'no arrays': {'a.vtm': vtm(BLOCK.format(0)), 'a.vtp': vtp()},
    'block of noise': {'a.vtm': vtm(BLOCK.format(0)), 'a.vtp': b'\x93\x00\xff' * 100},
    'block that counts too much': {'a.vtm': vtm(BLOCK.format(0)), 'a.vtp': vtp(count=2000000000)},
    'block of bad indices': {'a.vtm': vtm(BLOCK.format(0)), 'a.vtp': vtp(connectivity='0 1 7')},
    'itself as a block': {'a.vtm': vtm(BLOCK.format(0).replace('a.vtp', 'a.vtm'))},
}
USERS_OF_BLOCKS = {'triangulate': ['-o', 'out.vtm'], 'contour': ['-o', 'out.ply'],
                   'query': ['--points', 'points.csv'], 'occupancy': ['-o', 'out.bt'],
                   'info': ['--json', 'out.json'], 'export': ['-o', 'out.csv']}
for command, options in USERS_OF_BLOCKS.items():
    for name, files in BLOCKS.items():
        row(f'{command} with {name}', files, [command, 'a.vtm', *options], r'a\.vt[mp]')
    row(f'{command} without a file', {}, [command, 'absent.vtm', *options], r'absent\.vtm')
    row(f'{command} of a folder', {}, [command, 'images', *options], 'images')

# Scenes.


def scene(**changes):
    whole = {'images': 'images', 'model': 'sparse', 'clusters': [
        {'name': 'one', 'reference': 'cluster1_c.jpg',
         'triplets': [['cluster1_l.jpg', 'cluster1_c.jpg', 'cluster1_r.jpg']]}]}
    whole.update(changes)
    return json.dumps({key: value for key, value in whole.items() if value is not None})


def cluster(**changes):
    one = json.loads(scene())['clusters'][0]
    one.update(changes)
    return scene(clusters=[one])


SCENES = {
    'empty': '', 'noise': b'\x93\x00\xff' * 100, 'a list': '[]', 'cut': scene()[:40], 'a number': '1',
    'deep': '[' * 100000, 'a number too large': scene(board={'type': 'chessboard', 'corners': [9, 6],
                                                             'square_m': 1}).replace('"square_m": 1', '"square_m": 1e999'),
    'an unknown key': scene(colour=1), 'no images': scene(images=None), 'no model': scene(model=None),
    'images of a number': scene(images=1), 'an absent model': scene(model='absent'),
    'clusters of a number': scene(clusters=3), 'a cluster that leaves its folder': cluster(name='../../x'),
    'a cluster at the root': cluster(name='/x'), 'an unknown image': cluster(reference='x.jpg',
                                                                            triplets=[['a.jpg', 'x.jpg', 'b.jpg']]),
    'a triplet of two': cluster(triplets=[['cluster1_l.jpg', 'cluster1_c.jpg']]),
    'a triplet without its reference': cluster(triplets=[['cluster1_c.jpg', 'cluster1_l.jpg', 'cluster1_r.jpg']]),
    'no triplets': cluster(triplets=[]), 'a board of no kind': scene(board={'type': 'dots'}),
}
USERS_OF_SCENES = {'stereo': ['-o', 'out.vtm'], 'reconstruct': ['-o', 'out.ply'], 'refine': ['-o', 'out'],
                   'clusters': ['-o', 'out.json'], 'view': ['--mesh', 'mesh.ply', '-o', 'out.png'],
                   'report': ['-o', 'out'], 'info': ['--json', 'out.json'], 'export': ['-o', 'out.ply']}
for command, options in USERS_OF_SCENES.items():
    for name, content in SCENES.items():
        # The command that chooses the clusters does not look at those that are there.
        if command == 'clusters' and name == 'an unknown image':
            continue
        row(f'{command} of a scene with {name}', {'bad.json': content}, [command, 'bad.json', *options],
            r'bad\.json|absent')
    row(f'{command} without a scene', {}, [command, 'absent.json', *options], r'absent\.json')

# Camera models.

MODEL = {'cameras.txt': '1 PINHOLE 640 480 500 500 320 240\n',
         'images.txt': '1 1 0 0 0 0 0 0 1 a.jpg\n10 10 1\n', 'points3D.txt': '1 0 0 5 0 0 0 0 1 0\n'}


def model(**changes):
    files = dict(MODEL)
    for name, content in changes.items():
        files[name + '.txt'] = content
    return {f'bad/{name}': content for name, content in files.items() if content is not None}


MODELS = {
    'no cameras': model(cameras=None), 'no images': model(images=None), 'no points': model(points3D=None),
    'empty cameras': model(cameras=''), 'a word for a number': model(cameras='1 PINHOLE 640 480 f 500 320 240\n'),
    'a panorama': model(cameras='1 EQUIRECTANGULAR 640 480\n'),
    'a fisheye with too few parameters': model(cameras='1 OPENCV_FISHEYE 640 480 500 500 320 240 0 0 0\n'),
    'an unknown lens': model(cameras='1 EGG 640 480 500\n'), 'too few parameters': model(cameras='1 PINHOLE 640 480 500\n'),
    'a camera of no size': model(cameras='1 PINHOLE 0 480 500 500 320 240\n'),
    'a focal length of nan': model(cameras='1 PINHOLE 640 480 nan 500 320 240\n'),
    'a negative focal length': model(cameras='1 PINHOLE 640 480 -500 500 320 240\n'),
    'an image of no camera': model(images='1 1 0 0 0 0 0 0 7 a.jpg\n10 10 1\n'),
    'a rotation of zeros': model(images='1 0 0 0 0 0 0 0 1 a.jpg\n10 10 1\n'),
    'an image cut off': model(images='1 1 0 0 0 0 0\n'), 'noise': model(images=b'\x93\x00\xff\n' * 100),
    'binary noise': {'bad/cameras.bin': b'\xff' * 64, 'bad/images.bin': b'\xff' * 64, 'bad/points3D.bin': b'\xff' * 64},
    'binary emptiness': {'bad/cameras.bin': b'', 'bad/images.bin': b'', 'bad/points3D.bin': b''},
    'a number too large': model(points3D='1 1e999 0 5 0 0 0 0 1 0\n'),
}
for name, files in MODELS.items():
    row(f'sparse with {name}', files, ['sparse', 'bad', '-o', 'out.vtm'], 'bad')
    row(f'clusters with {name}', files, ['clusters', 'bad', '--images', 'images', '-o', 'out.json'], 'bad')
    row(f'reconstruct with {name}', files, ['reconstruct', 'bad', '-o', 'out.ply'], 'bad')
    if name != 'no points': # which is a model of cameras
        row(f'info with {name}', files, ['info', 'bad', '--json', 'out.json'], 'bad')
for name, content in {'empty.nvm': '', 'noise.nvm': b'\x93\x00\xff' * 50, 'cut.nvm': 'NVM_V3\n\n5\n', 'empty.out': '',
                      'noise.out': b'\x93\x00\xff' * 50, 'many.out': '# Bundle file v0.3\n2000000000 2000000000\n',
                      'many.nvm': 'NVM_V3\n\n2000000000\n', 'fixed.nvm': 'NVM_V3 FixedK 1 2\n',
                      'many.bundle.out': '1 1\n1 0 0\n1 0 0\n0 1 0\n0 0 1\n0 0 0\n1 2 3\n0 0 0\n2000000000\n'}.items():
    row(f'sparse {name}', {name: content}, ['sparse', name, '-o', 'out.vtm'], name)

# Models of other programs.

SFM = ('{"version": ["1", "2", "6"], "views": [{"viewId": "1", "poseId": "1", "intrinsicId": "1", "path": "/a.jpg"}], '
       '"intrinsics": [{"intrinsicId": "1", "width": "9", "height": "9", "type": "KIND", "focalLength": "1", '
       '"principalPoint": ["0", "0"], "distortionParams": ["0", "0", "0"]}], "poses": [{"poseId": "1", "pose": '
       '{"transform": {"rotation": ["1", "0", "0", "0", "1", "0", "0", "0", "1"], "center": ["0", "0", "0"]}}}]}')
FRAME = ('{"w": 9, "h": 9, "fl_x": 9, "frames": [{"file_path": "a.png", "transform_matrix": '
         '[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}]}')
XML = ('<document><chunk><sensors><sensor id="0" type="KIND"><resolution width="9" height="9"/><calibration><f>9</f>'
       '</calibration></sensor></sensors><cameras><camera sensor_id="0" label="a"><transform>1 0 0 0 0 1 0 0 0 0 1 0 0 0 '
       '0 1</transform></camera></cameras></chunk></document>')
FOREIGN = {
    'empty.sfm': '', 'noise.sfm': b'\x93\x00\xff' * 100, 'deep.sfm': '[' * 300000, 'none.sfm': '{}',
    'panorama.sfm': SFM.replace('KIND', 'equirectangular'), 'egg.sfm': SFM.replace('KIND', 'egg'),
    'word.sfm': SFM.replace('KIND', 'radial3').replace('"focalLength": "1"', '"focalLength": "x"'),
    'nan.sfm': SFM.replace('KIND', 'radial3').replace('"focalLength": "1"', '"focalLength": "nan"'),
    'large.sfm': SFM.replace('KIND', 'radial3').replace('"width": "9"', '"width": "99999999999999"'),
    'transforms.json': FRAME.replace('"fl_x"', '"f"'), 'matrix.json': FRAME.replace('[0,0,1,0]', '[0,0,1]'),
    'rotation.json': FRAME.replace('[0,0,1,0]', '[0,0,9,0]'), 'size.json': FRAME.replace('"w": 9', '"w": 1e30'),
    'word.json': FRAME.replace('"fl_x": 9', '"fl_x": "x"'), 'cut.json': FRAME[:-9], 'frames.json': '{"frames": 3}',
    'panorama.json': FRAME.replace('{"w"', '{"camera_model": "EQUIRECTANGULAR", "w"'), 'points.json': FRAME,
    'sfm_data.json': '{"sfm_data_version": "0.3"}', 'list.json': '{"sfm_data_version": "0.3", "intrinsics": [3]}',
    'empty_par.txt': '', 'many_par.txt': '2000000000\n', 'word_par.txt': '1\na.png x\n',
    'rotation_par.txt': '1\na.png 9 0 4 0 9 4 0 0 1 2 0 0 0 1 0 0 0 1 0 0 0\n',
    'panorama.xml': XML.replace('KIND', 'spherical'), 'cut.xml': XML.replace('KIND', 'frame')[:200],
    'deep.xml': '<document>' + '<a>' * 300000, 'none.xml': '<document/>', 'points.xml': XML.replace('KIND', 'frame'),
    'laughs.xml': '<!DOCTYPE a [<!ENTITY b "' + 'c' * 9999 + '">]><document>' + '&b;' * 9999 + '</document>',
    'word.xml': XML.replace('KIND', 'frame').replace('1 0 0 0 0', '1 0 x 0 0'),
}
for name, content in FOREIGN.items():
    row(f'sparse {name}', {name: content}, ['sparse', name, '-o', 'out.vtm'], name)
    if 'points' not in name:
        row(f'reconstruct {name}', {name: content}, ['reconstruct', name, '-o', 'out.ply'], name)
        row(f'texture by {name}', {name: content}, ['texture', 'mesh.ply', '--scene', name, '-o', 'out.glb'], name)
for name, sentence in {'a.psx': 'Metashape', 'a.rcproj': 'RealityCapture', 'a.abc': 'Alembic', 'a.mvs': 'OpenMVS',
                       'poses_bounds.npy': 'LLFF', 'database.db': 'database', 'a.mg': 'Meshroom'}.items():
    row(f'sparse {name}', {name: 'x'}, ['sparse', name, '-o', 'out.vtm'], sentence)
    row(f'view {name}', {name: 'x'}, ['view', name, '--mesh', 'mesh.ply', '-o', 'out.png'], sentence)
row('sparse of OpenSfM', {'reconstruction.json': '[{"cameras": {}, "shots": {}}]'},
    ['sparse', 'reconstruction.json', '-o', 'out.vtm'], 'export_colmap')

# Depth maps, of the only image of a model.

DEPTHS = {'empty.bin': b'', 'noise.bin': b'\x93\x00\xff' * 100, 'cut.bin': b'640&480&1&' + bytes(99),
          'three.bin': b'1&1&3&' + bytes(12), 'many.bin': b'65536&65536&1&', 'negative.bin': b'-1&480&1&',
          'none.bin': b'4&3&1&' + bytes(48), 'shape.bin': b'3&4&1&' + bytes(48), 'empty.pfm': b'',
          'noise.pfm': b'\x93\x00\xff' * 100, 'cut.pfm': b'Pf\n4 3\n-1\n' + bytes(47),
          'colour.pfm': b'PF\n1 1\n-1\n' + bytes(12), 'scale.pfm': b'Pf\n1 1\n0\n' + bytes(4),
          'empty.png': b'', 'noise.png': b'\x93\x00\xff' * 100, 'head.png': b'\x89PNG\r\n\x1a\n' + bytes(40),
          'a.exr': b'x'}
for name, content in DEPTHS.items():
    file = 'a.jpg' + name[name.index('.'):]
    row(f'depth {name}', {file: content, **model()}, ['depth', file, '--scene', 'bad', '-o', 'out.vtm'], r'a\.jpg')
row('depth of an unknown image', {'x.pfm': b'Pf\n4 3\n-1\n' + bytes(48), **model()},
    ['depth', 'x.pfm', '--scene', 'bad', '-o', 'out.vtm'], r'x\.pfm')
row('depth twice', {'a.pfm': b'Pf\n4 3\n-1\n' + bytes(48), 'a.jpg.pfm': b'', **model()},
    ['depth', 'a.pfm', 'a.jpg.pfm', '--scene', 'bad', '-o', 'out.vtm'], 'two depth maps')
row('depth without a map', model(), ['depth', 'absent.pfm', '--scene', 'bad', '-o', 'out.vtm'], r'absent\.pfm')
row('depth without cameras', {'a.pfm': ''}, ['depth', 'a.pfm', '--scene', 'absent', '-o', 'out.vtm'], 'absent')

# Points and segments.

TABLES = {'an empty table': '', 'a heading alone': 'x,y,z', 'two columns': '1,2\n', 'four columns': '1,2,3,4\n',
          'a word': '1,2,x\n', 'nan': '1,nan,3\n', 'infinity': 'inf,2,3\n', 'noise': b'\x93\x00\xff' * 100,
          'a long line': '1 ' * 1000000, 'a late fault': '1,2,3\n' * 10 + '1,2\n'}
for name, content in TABLES.items():
    for option in ('--points', '--segments'):
        if name != 'a heading alone':
            row(f'query {option} with {name}', {'bad.csv': content}, ['query', 'maps.vtm', option, 'bad.csv'],
                r'bad\.csv')
for name in ('/dev/zero', '/dev/urandom', 'absent.csv', 'images'):
    row(f'query of {name}', {}, ['query', 'maps.vtm', '--points', name], name)

# Outputs: their folder, ending and kind.

OUTPUTS = {'reconstruct': ['scene.json'], 'sparse': ['model'], 'stereo': ['scene.json'],
           'triangulate': ['features.vtm'], 'contour': ['maps.vtm'], 'render': ['mesh.ply'],
           'texture': ['mesh.ply', '--scene', 'scene.json'], 'occupancy': ['maps.vtm'],
           'view': ['scene.json', '--mesh', 'mesh.ply'], 'clusters': ['scene.json'], 'refine': ['scene.json'],
           'mesh': ['mesh.ply'], 'export': ['features.vtm'],
           'calibrate': ['images/cluster1_c.jpg', '--board', 'chessboard:9x6:1'], 'report': ['scene.json']}
ENDINGS = {'reconstruct': '.ply', 'sparse': '.vtm', 'stereo': '.vtm', 'triangulate': '.vtm', 'contour': '.ply',
           'render': '.png', 'texture': '.glb', 'occupancy': '.bt', 'view': '.png', 'clusters': '.json',
           'mesh': '.ply', 'export': '.ply'}
for command, inputs in OUTPUTS.items():
    ending = ENDINGS.get(command)
    if not ending:
        continue
    row(f'{command} into an absent folder', {}, [command, *inputs, '-o', f'absent/out{ending}'], 'absent')
    row(f'{command} onto a folder', {f'out{ending}/inside': ''}, [command, *inputs, '-o', f'out{ending}'], 'out')
    if command != 'clusters':
        row(f'{command} with another ending', {}, [command, *inputs, '-o', 'out.xyz'], r'out\.xyz')
        row(f'{command} without an ending', {}, [command, *inputs, '-o', 'out'], 'out')

# Masks that are asked to be free space.

for command in ('stereo', 'reconstruct', 'report'):
    row(f'{command} with free masks and no masks', {},
        [command, 'scene.json', '--mask-is-free', '-o', f'out{ENDINGS.get(command, "")}'], r'scene\.json')
row('reconstruct of a model with free masks', {}, ['reconstruct', 'model', '--mask-is-free', '-o', 'out.ply'],
    '--mask-is-free .*model')

# Boards, options and files of options.

for board in ('', 'charuco', 'dots:9x6:1', 'chessboard:9:1', 'chessboard:9x6', 'chessboard:ax6:1', 'chessboard:9x6:0',
              'chessboard:9x-6:1', 'chessboard:8x6:1', 'chessboard:7x7:1', 'chessboard:99999x6:1',
              'charuco:7x5:0.02:0.03:DICT_5X5_250', 'charuco:7x5:0.03:0.02:DICT_3X3', 'charuco:99x99:3:2:DICT_4X4_50'):
    row(f'calibrate with the board {board}', {},
        ['calibrate', 'images/cluster1_c.jpg', '--board', board, '-o', 'out'], '.')
for name, content in {'empty.png': b'', 'noise.jpg': b'\xff\xd8\xff' + b'\x93' * 99, 'text.png': b'hello'}.items():
    row(f'calibrate {name}', {name: content}, ['calibrate', name, '--board', 'chessboard:9x6:1', '-o', 'out'], name)
for arguments, sentence in (
        (['contour', 'maps.vtm', '-o', 'out.ply', '--cells', '0'], 'cells'),
        (['contour', 'maps.vtm', '-o', 'out.ply', '--cells', '-5'], 'cells'),
        (['contour', 'maps.vtm', '-o', 'out.ply', '--cells', 'x'], 'cells'),
        (['contour', 'maps.vtm', '-o', 'out.ply', '--region', '1,2,3'], 'region'),
        (['contour', 'maps.vtm', '-o', 'out.ply', '--region', '2,1,0,1,0,1'], 'region'),
        (['contour', 'maps.vtm', '-o', 'out.ply', '--hull-margin', 'nan'], 'hull-margin'),
        (['query', 'maps.vtm', '--points'], '--points'),
        (['occupancy', 'maps.vtm', '-o', 'out.bt', '--resolution', 'inf'], 'resolution'),
        (['render', 'mesh.ply', '-o', 'out.png', '--no-such'], 'no-such'), (['contuor'], 'contuor'), ([], 'command'),
        (['--threads', '-1', 'sparse', 'model', '-o', 'out.vtm'], 'threads'),
        (['triangulate', 'features.vtm', '-o', 'out.vtm', '--tolerance', '-1'], 'tolerance')):
    row(f'misuse: {" ".join(arguments)}', {}, arguments, sentence, MISUSED)
row('query of nothing', {}, ['query', 'maps.vtm'], '--points')
for name, content in {'noise': b'\x93\x00\xff' * 50, 'an unknown key': 'colour=1\n', 'an unknown command': '[cook]\na=1\n',
                      'a bad value': '[contour]\ncells=x\n'}.items():
    row(f'options of {name}', {'bad.ini': content}, ['--config', 'bad.ini', 'contour', 'maps.vtm', '-o', 'out.ply'], '.',
        MISUSED)
for name in ('/dev/zero', 'images', 'absent.ini'):
    row(f'options of {name}', {}, ['--config', name, 'contour', 'maps.vtm', '-o', 'out.ply'], '.', MISUSED)

# Meshes: values of the operations, matrices; batches.

for option, values in {'--crop': ('1,2,3', '1,0,0,1,0,1', 'a', 'nan,1,0,1,0,1'), '--largest': ('0', '-1', '1.5', 'x'),
                       '--crumbs': ('-1', 'nan', ''), '--smooth': ('0', 'inf'), '--simplify': ('0', '-1', 'x'),
                       '--triangles': ('0', '99999999999'), '--fill': ('-1',), '--scale': ('0', '-2', 'x'),
                       '--shift': ('1,2', '1,2,3,4', '1,2,x', '1,,2'),
                       '--global-shift': ('1,2', '1,2,nan', 'x')}.items():
    for value in values:
        row(f'mesh {option} {value}', {}, ['mesh', 'mesh.ply', f'{option}={value}', '-o', 'out.ply'], option, MISUSED)
for name, content in {'an empty matrix': '', 'a matrix of words': 'a b c', 'a matrix of noise': b'\x93\x00\xff' * 100,
                      'three rows': '1 0 0 0 ' * 3, '17 numbers': '1 ' * 17, 'a flat matrix': '0 ' * 15 + '1',
                      'a perspective': '1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 1', 'nan': 'nan ' * 16}.items():
    row(f'mesh --transform of {name}', {'bad.txt': content}, ['mesh', 'mesh.ply', '--transform', 'bad.txt', '-o', 'out.ply'],
        r'bad\.txt')
for name in ('/dev/zero', 'images', 'absent.txt'):
    row(f'mesh --transform of {name}', {}, ['mesh', 'mesh.ply', '--transform', name, '-o', 'out.ply'], name)
row('mesh of which nothing is left', {}, ['mesh', 'mesh.ply', '--crop', '9e9,9.1e9,0,1,0,1', '-o', 'out.ply'], 'crop')
row('mesh coloured from no scene', {}, ['mesh', 'mesh.ply', '--colour-from', 'absent.json', '-o', 'out.ply'], 'absent')
for arguments in (['--distances', '0'], ['--distances', '1,x'], ['--samples', '-1'], ['--bins', '0']):
    row(f'compare {" ".join(arguments)}', {}, ['compare', 'mesh.ply', 'mesh.ply', *arguments], arguments[0], MISUSED)
for option, name in (('-o', 'absent/out.ply'), ('-o', 'out.xyz'), ('--json', 'absent/out.json'), ('--json', 'images'),
                     ('--histogram', 'absent/out.csv')):
    row(f'compare {option} {name}', {}, ['compare', 'mesh.ply', 'mesh.ply', option, name], name)
row('info into a folder', {}, ['info', 'mesh.ply', '--json', 'images'], 'images')
for name, content in {'nothing': '', 'noise': b'\x93\x00\xff' * 100, 'a list': '[]', 'deep': '[' * 100000, 'no steps': '{}',
                      'an unknown key': '{"steps": ["info x"], "a": 1}', 'an unknown command': '{"steps": ["cook"]}',
                      'itself': '{"steps": ["run a"]}', 'a number': '{"steps": [1]}', 'an empty step': '{"steps": [""]}',
                      'a bad column': '{"steps": ["info x"], "table": {"a": "b"}}'}.items():
    row(f'run with {name}', {'bad.json': content}, ['run', 'bad.json', 'scene.json', '-o', 'out'], r'bad\.json')
row('run without a batch', {}, ['run', 'absent.json', 'scene.json', '-o', 'out'], r'absent\.json')
row('run without the scene', {'a.json': '{"steps": ["info x"]}'}, ['run', 'a.json', 'absent', '-o', 'out'], 'absent')
row('run of a scene twice', {'a.json': '{"steps": ["info x"]}'}, ['run', 'a.json', 'mesh.ply', 'mesh.ply', '-o', 'out'], 'mesh')
