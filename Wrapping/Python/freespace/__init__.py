# SPDX-License-Identifier: BSD-3-Clause
"""Freespace: surfaces from calibrated images by feature based stereo, as VTK algorithms.

    import freespace
    surface = freespace.reconstruct('scene.json')                # a vtkPolyData
    vertices, triangles = freespace.surface_arrays(surface)      # (n, 3) float64, (m, 3) int64

Every class is a VTK class: it connects to those of vtkmodules and takes part in their pipelines. Lengths
are in the unit of the camera model, image points in pixels, (0.5, 0.5) the centre of the first.
Importing this package also makes pictures possible without a display.
"""
from . import classes, queries
from .arrays import make_image, make_view, make_views, surface_arrays, view_arrays, views
from .classes import *
from .reconstruction import reconstruct
from .update import Error, update
from .version import __version__

__all__ = ['Error', 'make_image', 'make_view', 'make_views', 'queries', 'reconstruct', 'surface_arrays', 'update',
           'view_arrays', 'views', '__version__', *classes.__all__]
