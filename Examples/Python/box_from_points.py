#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Features that do not come from Freespace's own stereo: a box on a floor, from numpy arrays.

Six cameras around a box see points along its edges and along the lines of a chequered floor. Which
points a camera sees is known here, because the box is. The surface is cut by a plane, and its volume
is compared with the box's.

    box_from_points.py [OUT.ply]
"""
import sys

import numpy as np
from vtkmodules.vtkFiltersCore import vtkMassProperties

import freespace

HALF, HEIGHT, FLOOR = 0.5, 0.8, 1.5   # the box is 2 HALF wide; the floor reaches from -FLOOR to FLOOR
STEP = 0.02                           # between points along an edge
K = np.array([[900., 0, 400], [0, 900, 300], [0, 0, 1]])
SIZE = (800, 600)


def edge(a, b):
    a, b = np.asarray(a, float), np.asarray(b, float)
    n = int(np.ceil(np.linalg.norm(b - a) / STEP)) + 1
    return a + np.linspace(0, 1, n)[:, None] * (b - a)


def scene_points():
    """Points on the edges of the box and on the floor's lines outside of it."""
    corners = [(-HALF, -HALF), (HALF, -HALF), (HALF, HALF), (-HALF, HALF)]
    edges = []
    for (x0, y0), (x1, y1) in zip(corners, corners[1:] + corners[:1]):
        edges += [edge((x0, y0, 0), (x1, y1, 0)), edge((x0, y0, HEIGHT), (x1, y1, HEIGHT)),
                  edge((x0, y0, 0), (x0, y0, HEIGHT))]
    for c in np.arange(-FLOOR, FLOOR + .01, .25):
        edges += [edge((c, -FLOOR, 0), (c, FLOOR, 0)), edge((-FLOOR, c, 0), (FLOOR, c, 0))]
    points = np.vstack(edges)
    under = (np.abs(points[:, :2]) < HALF - 1e-9).all(1) & (points[:, 2] < 1e-9)
    return points[~under]


def camera_at(position, target):
    """cam_from_world of a camera that looks at the target, x to the right and y down."""
    z = target - position
    z /= np.linalg.norm(z)
    x = np.cross(z, [0, 0, 1])
    x /= np.linalg.norm(x)
    R = np.array([x, np.cross(z, x), z])
    return np.column_stack([R, -R @ position])


def is_visible(position, points):
    """Whether the segment from the position to each point stays out of the box's inside."""
    direction = points - position
    low, high = np.array([-HALF, -HALF, 0]) + 1e-6, np.array([HALF, HALF, HEIGHT]) - 1e-6
    with np.errstate(divide='ignore', invalid='ignore'):
        near, far = (low - position) / direction, (high - position) / direction
    enter, leave = np.minimum(near, far).max(1), np.maximum(near, far).min(1)
    return ~((enter < leave) & (enter < 1 - 1e-9))


def make_view(position, points):
    cam_from_world = camera_at(position, np.array([0, 0, .3]))
    seen = points[is_visible(position, points)]
    image = (seen @ cam_from_world[:, :3].T + cam_from_world[:, 3]) @ K.T
    pixels = image[:, :2] / image[:, 2:]
    inside = ((pixels > 0) & (pixels < SIZE)).all(1)
    return freespace.make_view(seen[inside], pixels[inside], K, cam_from_world, SIZE)


def main():
    points = scene_points()
    angles = np.radians(np.arange(30, 390, 60))
    blocks = {f'view{i}': make_view(np.array([3 * np.cos(a), 3 * np.sin(a), 2.5]), points)
              for i, a in enumerate(angles)}

    maps = freespace.vtkDelaunayDisparityFilter()
    maps.SetInputDataObject(freespace.make_views(blocks))
    maps.Update()

    phi = freespace.vtkFreespaceUnion()
    phi.SetMaps(maps.GetOutput())
    print('Phi above the box:', 'free' if phi.EvaluateFunction(0, 0, HEIGHT + .1) > 0 else 'matter')
    print('Phi inside the box:', 'free' if phi.EvaluateFunction(0, 0, HEIGHT / 2) > 0 else 'matter')

    surface = freespace.vtkBisectionContourFilter()
    surface.SetImplicitFunction(phi)
    surface.SetCells(96)
    surface.Update()
    vertices, triangles = freespace.surface_arrays(surface.GetOutput())
    top = vertices[(np.abs(vertices[:, :2]) < .8 * HALF).all(1), 2].max()
    print(f'{len(vertices)} vertices, {len(triangles)} triangles; the box is {top:.3f} high, truly {HEIGHT}')

    volume = vtkMassProperties()
    volume.SetInputConnection(surface.GetOutputPort())
    print(f'volume of box and floor: {volume.GetVolume():.3f}')
    if len(sys.argv) > 1:
        writer = freespace.vtkSurfaceWriter()
        writer.SetInputConnection(surface.GetOutputPort())
        writer.SetFileName(sys.argv[1])
        return 0 if writer.Write() else 1
    return 0 if abs(top - HEIGHT) < .02 else 1


if __name__ == '__main__':
    sys.exit(main())
