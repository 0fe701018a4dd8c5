# SPDX-License-Identifier: BSD-3-Clause
"""A picture of a surface from a calibrated camera, in Python."""
import os
import tempfile
import numpy as np
from freespace.vtkFreespaceRendering import vtkSurfacePicture
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.util.numpy_support import vtk_to_numpy

plane = vtkPlaneSource()  # the unit square around the origin in z = 0
intrinsics = np.array([[100, 0, 40], [0, 100, 60], [0, 0, 1.]])
pose = np.array([[1, 0, 0, 0], [0, -1, 0, 0], [0, 0, -1, 2.]])  # from z = 2: 50 pixels to the unit

picture = vtkSurfacePicture()
picture.SetInputConnection(plane.GetOutputPort())
picture.SetView(intrinsics.ravel(), pose.ravel(), (160, 120))
picture.Update()
colours = vtk_to_numpy(picture.GetOutput().GetPointData().GetScalars()).reshape(120, 160, 3)[::-1]
seen = (colours != 255).any(axis=2)
assert seen[35:85, 15:65].all()
assert seen.sum() == 50 * 50, seen.sum()

with tempfile.TemporaryDirectory() as folder:
    assert picture.WritePNG(folder + '/picture.png') == 1
    assert os.listdir(folder) == ['picture.png']
