# SPDX-License-Identifier: BSD-3-Clause
"""A surface and its features in PyVista, without a display: pyvista_surface.py SCENE.json OUT.png

Every output of Freespace is a VTK data object, which pyvista.wrap takes as it is, without a copy. Needs
python3-pyvista. Import freespace before the first window: it makes pictures possible without a display.
"""
import sys

import freespace
import pyvista


def show(scene, picture):
    stereo = freespace.vtkEdgeStereoReader(file_name=scene)
    features = pyvista.wrap(freespace.update(stereo))             # a MultiBlock, one PolyData for each view
    maps = freespace.vtkDelaunayDisparityFilter()
    maps.SetInputConnection(stereo.GetOutputPort())
    filter = freespace.vtkFreespaceSurfaceFilter()
    filter.SetInputConnection(maps.GetOutputPort())
    filter.GetContour().SetComputeNormals(True)
    surface = pyvista.wrap(freespace.update(filter))

    plotter = pyvista.Plotter(off_screen=True, window_size=(800, 600))
    plotter.add_mesh(surface, color='lightgrey')
    plotter.add_points(features.combine().points, scalars=features.combine()['RGB'], rgb=True, point_size=3)
    plotter.camera_position = 'iso'
    plotter.screenshot(picture)
    return surface


if __name__ == '__main__':
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    surface = show(*sys.argv[1:])
    print(f'{surface.n_points} vertices, {surface.n_cells} triangles, volume {surface.volume:.6f}')
