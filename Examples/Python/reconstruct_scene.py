#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""From photographs to a surface: reconstruct_scene.py SCENE.json OUT.ply [CELLS]"""
import sys

import freespace


def main(scene, out, cells=256):
    stereo = freespace.vtkEdgeStereoReader()
    stereo.SetFileName(scene)
    support = freespace.vtkFeatureSupportFilter()
    support.SetInputConnection(stereo.GetOutputPort())
    maps = freespace.vtkDelaunayDisparityFilter()
    maps.SetInputConnection(support.GetOutputPort())
    maps.Update()
    for name, view in freespace.views(maps.GetOutput()).items():
        print(f"{name}: {len(view['points'])} points, {len(view['triangles'])} triangles")

    phi = freespace.vtkFreespaceUnion()
    phi.SetMaps(maps.GetOutput())
    surface = freespace.vtkBisectionContourFilter()
    surface.SetImplicitFunction(phi)
    surface.SetCells(int(cells))
    writer = freespace.vtkSurfaceWriter()
    writer.SetInputConnection(surface.GetOutputPort())
    writer.SetFileName(out)
    return 0 if writer.Write() else 1


if __name__ == '__main__':
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
