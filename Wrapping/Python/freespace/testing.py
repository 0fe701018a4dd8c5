# SPDX-License-Identifier: BSD-3-Clause
"""Regression pictures for tests: compare what is rendered with a baseline, as VTK's and this project's tests do.

    import freespace.testing
    freespace.testing.expect_picture(picture, 'baseline.png')
"""
import os
from pathlib import Path

from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkImagingCore import vtkImageDifference
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkRenderWindow, vtkWindowToImageFilter

from .update import update

__all__ = ['expect_picture', 'picture_error']


def _read(path):
    path = os.fspath(path)
    if not os.path.isfile(path):
        raise FileNotFoundError(f'There is no picture {path}.')
    reader = vtkPNGReader()
    reader.SetFileName(path)
    return update(reader)


def _write(image, path):
    writer = vtkPNGWriter()
    writer.SetInputData(image)
    writer.SetFileName(os.fspath(path))
    writer.Write()


def _image(picture):
    if isinstance(picture, vtkImageData):
        return picture
    if isinstance(picture, vtkRenderWindow):
        grab = vtkWindowToImageFilter()
        grab.SetInput(picture)
        grab.ReadFrontBufferOff()
        return update(grab)
    if hasattr(picture, 'GetOutputPort'):
        return update(picture)
    return _read(picture)


def _compare(image, reference):
    if image.GetDimensions() != reference.GetDimensions():
        return float('inf'), None
    if image.GetNumberOfScalarComponents() != 3 or reference.GetNumberOfScalarComponents() != 3:
        return float('inf'), None
    difference = vtkImageDifference()
    difference.SetInputData(image)
    difference.SetImageData(reference)
    difference.Update()
    return difference.GetThresholdedError(), difference.GetOutput()


def picture_error(picture, baseline):
    """VTK's regression measure of two pictures (vtkImageDifference, thresholded): 0 for alike, infinite where they
    differ in size or are not of three channels.

    Both are a vtkImageData, a vtkRenderWindow, an algorithm such as vtkSurfacePicture, or the path of a PNG.
    """
    return _compare(_image(picture), _image(baseline))[0]


def expect_picture(picture, baseline, max_error=10, folder='.'):
    """Raises AssertionError where a picture differs from a baseline, the path of a PNG, by more than max_error.

    Then the picture is left in the folder under the baseline's name, and the difference with -difference in it. A
    picture becomes the baseline by being copied, after somebody has looked at it. A baseline that is missing is an
    AssertionError, too.
    """
    image = _image(picture)
    seen = Path(folder) / Path(baseline).name
    if not os.path.isfile(baseline):
        _write(image, seen)
        raise AssertionError(f'There is no baseline {baseline}; the picture is in {seen}.')
    error, difference = _compare(image, _read(baseline))
    if error <= max_error:
        return
    _write(image, seen)
    if difference is not None:
        _write(difference, seen.with_name(f'{seen.stem}-difference.png'))
    raise AssertionError(f'{seen} differs from {baseline} by {error}, more than {max_error}.')
