# SPDX-License-Identifier: BSD-3-Clause
"""Images or features to a surface, in one call."""
import os

from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet

from .classes import vtkDelaunayDisparityFilter, vtkEdgeStereoReader, vtkFreespaceSurfaceFilter
from .update import update


def reconstruct(scene, *, cells=0, **properties):
    """The surface of a scene, a vtkPolyData of triangles in the unit of the camera model.

    scene: the path of a scene.json, or the views themselves, a vtkMultiBlockDataSet as make_views and
    the readers have it. cells: lattice cells along the longest side, 0: as many as show what the features
    tell. properties: further ones of vtkFreespaceSurfaceFilter, for instance minimum_views=2.

    Raises freespace.Error, as update does.
    """
    maps = vtkDelaunayDisparityFilter()
    if isinstance(scene, vtkMultiBlockDataSet):
        maps.SetInputDataObject(scene)
    else:
        stereo = vtkEdgeStereoReader(file_name=os.fspath(scene))
        maps.SetInputConnection(stereo.GetOutputPort())
    surface = vtkFreespaceSurfaceFilter(cells=cells, **properties)
    surface.SetInputConnection(maps.GetOutputPort())
    return update(surface)
