# SPDX-License-Identifier: BSD-3-Clause
"""Queries of a vtkFreespaceUnion in batches over numpy arrays, on all threads.

    from freespace import queries
    queries.points_free(phi, points)            # (n,) bool
    queries.first_blocked(phi, first, last)     # (n,) fraction of each segment, inf where all is free
    queries.spheres_free(phi, centers, radii)   # (n,) bool

A batch that an observer of the union's ProgressEvent stopped, by SetAbortExecute, is empty.
"""
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints, vtkUnsignedCharArray


def points_free(phi, points):
    """Whether each of the points (n, 3) is in free space."""
    free = vtkUnsignedCharArray()
    phi.ArePointsFree(_points(points), free)
    return vtk_to_numpy(free).astype(bool)


def first_blocked(phi, first, last):
    """Where each segment from first (n, 3) to last (n, 3) first leaves free space, as a fraction."""
    first, last = _points(first), _points(last)
    if first.GetNumberOfPoints() != last.GetNumberOfPoints():
        raise ValueError(
            f'{first.GetNumberOfPoints()} first points but {last.GetNumberOfPoints()} last points')
    fractions = vtkDoubleArray()
    phi.FirstBlocked(first, last, fractions)
    return vtk_to_numpy(fractions)


def spheres_free(phi, centers, radii):
    """Whether each ball lies wholly in free space; radii is one number or one for each."""
    centers = np.asarray(centers, np.float64).reshape(-1, 3)
    radii = np.ascontiguousarray(np.broadcast_to(np.asarray(radii, np.float64), len(centers)))
    free = vtkUnsignedCharArray()
    phi.AreSpheresFree(_points(centers), numpy_to_vtk(radii, deep=True), free)
    return vtk_to_numpy(free).astype(bool)


def _points(array):
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(array, np.float64).reshape(-1, 3), deep=True))
    return points
