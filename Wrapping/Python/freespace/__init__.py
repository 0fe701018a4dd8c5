# SPDX-License-Identifier: BSD-3-Clause
"""Freespace: surfaces from calibrated photographs by feature based stereo, as VTK algorithms.

    import freespace
    stereo = freespace.vtkEdgeStereoReader()

Every class is a VTK class: it connects to those of vtkmodules and takes part in their pipelines.
Importing this package also makes pictures possible without a display.
"""
from .vtkFreespaceFilters import *
from .vtkFreespaceReaders import *
from .vtkFreespaceWriters import *
from .vtkFreespaceRendering import *
from .arrays import make_view, make_views, surface_arrays, view_arrays, views
from .update import Error, update
