#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Stereo of images that are not files: a textured plane, rendered into numpy arrays.

Five cameras in a cross look at a plane of coloured squares at a known depth. The features that
vtkEdgeStereoReader finds are compared with it.

    stereo_in_memory.py
"""
import sys

import numpy as np

import freespace

WIDTH, HEIGHT, DEPTH, SQUARE = 320, 240, 2.0, 0.08
K = np.array([[400., 0, 160], [0, 400, 120], [0, 0, 1]])
CENTERS = {'c': (0, 0), 'l': (-.2, 0), 'r': (.2, 0), 'u': (0, -.2), 'd': (0, .2)}


def render(center, colors, samples=4):
    """What a camera at the center sees, red, green and blue; each pixel is a mean, as in a real camera."""
    steps = (np.arange(samples * WIDTH) + .5) / samples, (np.arange(samples * HEIGHT) + .5) / samples
    x = (steps[0] - K[0, 2]) / K[0, 0] * DEPTH + center[0]
    y = (steps[1] - K[1, 2]) / K[1, 1] * DEPTH + center[1]
    column, row = (np.floor(it / SQUARE).astype(int) % len(colors) for it in (x, y))
    fine = colors[row[:, None], column[None, :]]
    return fine.reshape(HEIGHT, samples, WIDTH, samples, 3).mean((1, 3)).round().astype(np.uint8)


def main():
    colors = np.random.default_rng(3).uniform(20, 235, (64, 64, 3))
    images = {name: freespace.make_image(render((x, y), colors), K, np.column_stack([np.eye(3), [-x, -y, 0]]))
              for name, (x, y) in CENTERS.items()}
    stereo = freespace.vtkEdgeStereoReader()
    stereo.SetInputDataObject(freespace.make_views(images))
    stereo.AddTriplet('cross', 'l', 'c', 'r')
    stereo.AddTriplet('cross', 'u', 'c', 'd')
    views = freespace.views(freespace.update(stereo))
    for name, view in views.items():
        print(f"{name}: {len(view['points'])} features, "
              f"median error of their depth {np.median(np.abs(view['points'][:, 2] - DEPTH)):.5f}")
    points = np.vstack([view['points'] for view in views.values()])
    return 0 if len(points) > 1000 and np.median(np.abs(points[:, 2] - DEPTH)) < .002 else 1


if __name__ == '__main__':
    sys.exit(main())
