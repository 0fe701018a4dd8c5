# SPDX-License-Identifier: BSD-3-Clause
"""The batch program with models of other programs and with depth maps."""
import json
import struct
import unittest

from test_program import SCENE, WithFolder, run


def rotation(w, x, y, z):
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]


def transforms():
    """nerfstudio's transforms.json of the example's cameras."""
    camera = (SCENE / 'sparse' / 'cameras.txt').read_text().splitlines()[1].split()
    width, height, fx, fy, cx, cy = map(float, camera[2:8])
    frames = []
    for line in (SCENE / 'sparse' / 'images.txt').read_text().splitlines():
        fields = line.split()
        if len(fields) == 10 and fields[0] != '#':
            R, t = rotation(*map(float, fields[1:5])), list(map(float, fields[5:8]))
            center = [-sum(R[k][i] * t[k] for k in range(3)) for i in range(3)]
            matrix = [[R[0][i], -R[1][i], -R[2][i], center[i]] for i in range(3)] + [[0, 0, 0, 1]]
            frames.append({'file_path': f'images/{fields[9]}', 'transform_matrix': matrix})
    return {'w': width, 'h': height, 'fl_x': fx, 'fl_y': fy, 'cx': cx, 'cy': cy, 'frames': frames}


class TestModels(WithFolder):
    def setUp(self):
        super().setUp()
        (self.folder / 'images').symlink_to(SCENE / 'images')
        (self.folder / 'transforms.json').write_text(json.dumps(transforms()))
        (self.folder / 'mesh.obj').write_text('v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\n'
                                              'f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n')

    def test_clusters_are_those_of_the_same_colmap_model(self):
        expected = self.succeed('clusters', SCENE / 'sparse', '--images', SCENE / 'images').stdout
        for model in ('transforms.json', '.'):
            found = self.succeed('clusters', model, '--images', '.').stdout
            self.assertEqual(found.replace('images/', ''), expected)

    def test_every_option_takes_it(self):
        for arguments in (['view', 'transforms.json', '--mesh', 'mesh.obj', '-o', 'a.png', '--size', '64x48'],
                          ['texture', 'mesh.obj', '--scene', 'transforms.json', '-o', 'a.ply'],
                          ['render', 'mesh.obj', '--model', 'transforms.json', '--view', 'images/cluster1_c.jpg', '-o', 'b.png'],
                          ['render', 'mesh.obj', '--scene', 'transforms.json', '--view', 'images/cluster1_c.jpg', '-o', 'c.png'],
                          ['render', 'mesh.obj', '--model', SCENE / 'sparse', '--view', 'cluster1_c.jpg', '-o', 'd.png']):
            with self.subTest(command=arguments[0]):
                self.succeed(*arguments)
        pictures = [(self.folder / f'{name}.png').read_bytes() for name in 'bcd']
        self.assertEqual(pictures[0], pictures[1])
        self.assertEqual(pictures[0], pictures[2])

    def test_a_model_without_points_says_what_to_do(self):
        result = run('sparse', 'transforms.json', '-o', 'f.vtm', cwd=self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertIn('clusters', result.stderr)


class TestDepth(WithFolder):
    def test_scans_of_a_corner_make_it_free(self):
        """Three cameras look along z at a wall, z = 2, over a floor, y = 0.5, whose ranges a scanner gives."""
        frames, depths = [], []
        for row in reversed(range(60)):
            for column in range(80):
                x, y = (column + 0.5 - 40) / 50, (row + 0.5 - 30) / 50
                depths.append((0.5 / y if y > 0.25 else 2) * (x * x + y * y + 1) ** 0.5)
        for i in range(3):
            (self.folder / f'{i}.pfm').write_bytes(b'Pf\n80 60\n-1\n' + struct.pack('<4800f', *depths))
            frames.append({'file_path': f'{i}.png', 'transform_matrix': [[1, 0, 0, 0.2 * i], [0, -1, 0, 0], [0, 0, -1, 0],
                                                                         [0, 0, 0, 1]]})
        (self.folder / 'transforms.json').write_text(json.dumps({'w': 80, 'h': 60, 'fl_x': 50, 'frames': frames}))
        result = self.succeed('depth', '0.pfm', '1.pfm', '2.pfm', '--range', '--scene', 'transforms.json', '-o', 'f.vtm')
        self.assertIn('3 views', result.stderr)
        self.succeed('triangulate', 'f.vtm', '-o', 'm.vtm')
        (self.folder / 'points.csv').write_text('0.2,0.3,1.5\n0.2,0.4,1.9\n0.2,0.48,1.5\n0.2,9,9\n')
        answers = self.succeed('query', 'm.vtm', '--points', 'points.csv').stdout.splitlines()
        self.assertEqual(answers, ['free', '1', '1', '1', 'unknown'])  # a heading first


if __name__ == '__main__':
    unittest.main()
