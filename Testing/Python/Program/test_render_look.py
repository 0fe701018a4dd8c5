# SPDX-License-Identifier: BSD-3-Clause
"""How a picture of the program looks: zoom, up, background, edges, colours, size, and the comparison of pictures."""
import os
import subprocess
import unittest

import numpy as np

from test_pictures import PROGRAM, WithScene, picture, run, write_triangle


class TestLook(WithScene):
    def render(self, *options, mesh='mesh.ply'):
        self.succeed('render', mesh, '-o', 'out.png', *options)
        return picture(self.folder / 'out.png')

    def test_zoom_shows_the_middle_larger(self):
        write_triangle(self.folder / 'triangle.ply')
        areas = []
        for zoom in (0.25, 0.5):
            self.succeed('render', 'triangle.ply', '-o', 'a.png', '--size', '200x200', '--azimuth', 0, '--elevation', 90,
                         '--zoom', zoom)
            areas.append((picture(self.folder / 'a.png') < 250).any(axis=2).sum())
        self.assertGreater(areas[0], 100)
        self.assertAlmostEqual(areas[1] / areas[0], 4, delta=0.4)

    def test_up_turns_the_picture(self):
        # Seen from above with z up as from behind with y up: the same triangle, turned with the axis.
        write_triangle(self.folder / 'triangle.ply')
        write_triangle(self.folder / 'turned.ply')
        text = (self.folder / 'turned.ply').read_text()
        text = text.replace('0.1 0 0\n', '0.1 0 0\n').replace('0.0 0.1 0\n', '0.0 0 -0.1\n')
        (self.folder / 'turned.ply').write_text(text)
        for file, up in (('triangle', '+z'), ('turned', 'y')):
            self.succeed('render', file + '.ply', '-o', file + '.png', '--size', '200x200', '--azimuth', -60,
                         '--elevation', 50, '--up', up)
        self.succeed('render', 'turned.ply', '-o', 'other.png', '--size', '200x200', '--azimuth', -60, '--elevation',
                     50, '--up', '0,0,2')
        expected, turned = picture(self.folder / 'triangle.png'), picture(self.folder / 'turned.png')
        self.assertLess(np.abs(expected - turned).mean(), 0.5)
        self.assertGreater(np.abs(expected - picture(self.folder / 'other.png')).mean(), 5)

    def test_background_and_edges(self):
        write_triangle(self.folder / 'triangle.ply')
        looks = {}
        for name, options in (('plain', ()), ('green', ('--background', '0,1,0')), ('edges', ('--edges',))):
            self.succeed('render', 'triangle.ply', '-o', name + '.png', '--size', '200x200', '--azimuth', 0,
                         '--elevation', 90, *options)
            looks[name] = picture(self.folder / (name + '.png'))
        self.assertEqual(tuple(looks['green'][0, 0]), (0, 255, 0))
        darker = (looks['plain'] - looks['edges']).max(axis=2) > 50
        self.assertGreater(darker.sum(), 100)
        self.assertLess(darker.sum(), 2000)  # lines, not the triangle

    def test_color_by_an_array_with_a_bar(self):
        self.succeed('contour', 'maps.vtm', '-o', 'mesh.vtp', '--cells', 24)
        look = self.render('--color-by', 'Kind', mesh='mesh.vtp')
        blue = (look[..., 2] > look[..., 0] + 60).sum()
        red = (look[..., 0] > look[..., 2] + 60).sum()
        self.assertGreater(min(blue, red), 200)
        (self.folder / 'out.png').unlink()
        self.fails("no array 'nonsense'", 'render', 'mesh.vtp', '-o', 'out.png', '--color-by', 'nonsense')

    def test_size_of_a_calibrated_view(self):
        look = self.render('--scene', 'scene.json', '--view', 'cluster1_c.jpg', '--size', '120x90')
        self.assertEqual(look.shape, (90, 120, 3))
        self.succeed('view', 'scene.json', '--mesh', 'mesh.ply', '-o', 'view.png', '--size', '90x120')
        self.assertEqual(picture(self.folder / 'view.png').shape, (120, 90, 3))

    def test_comparison_with_a_reference(self):
        write_triangle(self.folder / 'triangle.ply')
        options = ('--size', '200x200', '--azimuth', 0, '--elevation', 90)
        self.succeed('render', 'triangle.ply', '-o', 'reference.png', *options)
        self.succeed('render', 'triangle.ply', '-o', 'same.png', *options, '--ref', 'reference.png')
        for other, fault in ((options + ('--background', '0,0,0'), 'differs from'), (options[2:], 'of different sizes')):
            result = run('render', 'triangle.ply', '-o', 'other.png', *other, '--ref', 'reference.png',
                         '--diff', 'difference.png', cwd=self.folder)
            self.assertEqual(result.returncode, 1)
            self.assertIn(fault, result.stderr)
        self.assertGreater(picture(self.folder / 'difference.png').max(), 100)
        self.assertEqual(run('render', 'triangle.ply', '-o', 'a.png', '--ref', 'triangle.ply',
                             cwd=self.folder).returncode, 1)

    def test_without_opengl_there_is_one_sentence_and_no_picture(self):
        write_triangle(self.folder / 'triangle.ply')
        result = subprocess.run([PROGRAM, 'render', 'triangle.ply', '-o', 'out.png', '--quiet'], cwd=self.folder,
                                env={**os.environ, 'MESA_GL_VERSION_OVERRIDE': '2.1'}, capture_output=True, text=True,
                                timeout=60)
        self.assertEqual(result.returncode, 1)
        self.assertEqual(result.stderr, 'freespace: libOSMesa gave no OpenGL 3.2 context.\n')
        self.assertFalse((self.folder / 'out.png').exists())


if __name__ == '__main__':
    unittest.main()
