#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""From images to a surface: reconstruct_scene.py SCENE.json OUT.ply [CELLS]"""
import sys

import freespace


def main(scene, out, cells=-1):
    stereo = freespace.vtkEdgeStereoReader()
    stereo.SetFileName(scene)
    maps = freespace.vtkDelaunayDisparityFilter()
    maps.SetInputConnection(stereo.GetOutputPort())
    for name, view in freespace.views(freespace.update(maps)).items():
        print(f"{name}: {len(view['points'])} points, {len(view['triangles'])} triangles")

    surface = freespace.vtkFreespaceSurfaceFilter()
    surface.SetInputConnection(maps.GetOutputPort())
    surface.SetCells(int(cells))  # -1: automatic
    writer = freespace.vtkSurfaceWriter()
    writer.SetInputConnection(surface.GetOutputPort())
    writer.SetFileName(out)
    freespace.update(writer)


if __name__ == '__main__':
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    try:
        main(*sys.argv[1:])
    except freespace.Error as error:
        sys.exit(str(error))
