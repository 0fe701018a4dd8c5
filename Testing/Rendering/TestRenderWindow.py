# SPDX-License-Identifier: BSD-3-Clause
"""A window without an X server, in Python: TestRenderWindow.py rendering-first|rendering-last|alone"""
import sys

if sys.argv[1] == 'rendering-first':
    import vtkmodules.vtkRenderingOpenGL2
from freespace import vtkFreespaceRendering
if sys.argv[1] == 'rendering-last':
    import vtkmodules.vtkRenderingOpenGL2

import numpy as np
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkRenderWindowInteractor
from vtkmodules.util.numpy_support import vtk_to_numpy


def sphere_window(width, height, background):
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(width, height)
    renderer = vtkRenderer()
    renderer.SetBackground(background)
    window.AddRenderer(renderer)
    source = vtkSphereSource()
    source.SetRadius(1)
    source.SetThetaResolution(64)
    source.SetPhiResolution(64)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().LightingOff()
    actor.GetProperty().SetColor(0, 1, 0)
    renderer.AddActor(actor)
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetParallelScale(2)  # the height shows 4 units, so that the radius is height / 4
    return window


def check(window, background):
    window.Render()
    width, height = window.GetSize()
    pixels = vtkUnsignedCharArray()
    window.GetPixelData(0, 0, width - 1, height - 1, 1, pixels, 0)
    picture = vtk_to_numpy(pixels).reshape(height, width, 3)
    sphere = (picture == (0, 255, 0)).all(axis=2)
    area = np.pi * (height / 4) ** 2
    assert abs(sphere.sum() - area) < 0.02 * area, (sphere.sum(), area)
    assert (picture[~sphere] == np.multiply(background, 255)).all()


red, blue = (1, 0, 0), (0, 0, 1)
interacted = sphere_window(80, 60, (1, 0, 0))
interactor = vtkRenderWindowInteractor()  # of which vtkRenderingUI has an override
interactor.SetRenderWindow(interacted)
interactor.Initialize()
interactor.Render()
check(interacted, (1, 0, 0))

first, second = sphere_window(200, 160, red), sphere_window(120, 100, blue)
for repeat in range(2):
    check(first, red)
    check(second, blue)
first.SetSize(320, 240)
check(first, red)
check(second, blue)
del first
check(second, blue)
second.Finalize()
check(second, blue)
