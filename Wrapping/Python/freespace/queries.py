# SPDX-License-Identifier: BSD-3-Clause
"""Queries of a vtkFreespaceUnion in batches over numpy arrays, on all threads.

    from freespace import queries
    queries.points_free(phi, points)            # (n,) bool
    queries.point_states(phi, points)           # (n,) MATTER, FREE (seen) or UNKNOWN (never seen)
    queries.first_blocked(phi, first, last)     # (n,) fraction of each segment, inf where all is free
    queries.spheres_free(phi, centers, radii)   # (n,) bool

Arrays of other shapes are a ValueError. What is not finite is not free. A union without valid maps is a
freespace.Error. Other Python threads go on meanwhile, Ctrl-C stops a batch, and what an observer raises is raised.

A batch that an observer of the union's ProgressEvent stopped, by SetAbortExecute, is empty.
"""
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkUnsignedCharArray

from . import _unlocked
from .arrays import rows, vtk_array, vtk_points
from .update import ErrorsRaised, check_valid

MATTER, FREE, UNKNOWN = 0, 1, 2


def points_free(phi, points):
    """Whether each of the points (n, 3) is in free space."""
    free = vtkUnsignedCharArray()
    _ask(_unlocked.points_free, phi, _points(points, 'points'), free)
    return vtk_to_numpy(free).astype(bool)


def point_states(phi, points):
    """What is known of each of the points (n, 3): MATTER, FREE, which was seen, or UNKNOWN, outside of the hull and
    never seen, which points_free counts as free."""
    states = vtkUnsignedCharArray()
    _ask(_unlocked.point_states, phi, _points(points, 'points'), states)
    return vtk_to_numpy(states).copy()


def first_blocked(phi, first, last):
    """Where each segment from first (n, 3) to last (n, 3) first leaves free space, as a fraction."""
    first, last = _points(first, 'first'), _points(last, 'last')
    if first.GetNumberOfPoints() != last.GetNumberOfPoints():
        raise ValueError(
            f'{first.GetNumberOfPoints()} first points but {last.GetNumberOfPoints()} last points')
    fractions = vtkDoubleArray()
    _ask(_unlocked.first_blocked, phi, first, last, fractions)
    return vtk_to_numpy(fractions)


def spheres_free(phi, centers, radii):
    """Whether each ball lies wholly in free space; radii is one number or one for each."""
    centers = rows(centers, 3, 'centers')
    radii = np.ascontiguousarray(np.broadcast_to(np.asarray(radii, np.float64), len(centers)))
    free = vtkUnsignedCharArray()
    _ask(_unlocked.spheres_free, phi, _points(centers, 'centers'), vtk_array(radii, copy=False), free)
    return vtk_to_numpy(free).astype(bool)


def _ask(batch, phi, *arguments):
    with ErrorsRaised(phi):
        batch(phi, *arguments)
    check_valid(phi)


def _points(array, name):
    return vtk_points(rows(array, 3, name), copy=False)
