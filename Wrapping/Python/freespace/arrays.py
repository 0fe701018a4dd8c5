# SPDX-License-Identifier: BSD-3-Clause
"""Views and surfaces as numpy arrays, and views and images from numpy arrays."""
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkCompositeDataSet, vtkImageData, vtkMultiBlockDataSet, \
    vtkPolyData


def view_arrays(block):
    """The arrays of one view as a dict.

    points (n, 3) in the world, image_points (n, 2) in pixels, triangles (m, 3), K (3, 3),
    cam_from_world (3, 4), size (width, height), and every further point data array by its name.
    """
    field, point_data = block.GetFieldData(), block.GetPointData()
    arrays = {point_data.GetArrayName(i): vtk_to_numpy(point_data.GetArray(i))
              for i in range(point_data.GetNumberOfArrays())}
    arrays['image_points'] = arrays.pop('ImagePoint', np.zeros((0, 2)))
    arrays['points'] = vtk_to_numpy(block.GetPoints().GetData()) if block.GetPoints() else np.zeros((0, 3))
    arrays['triangles'] = _triangles(block)
    arrays['K'] = vtk_to_numpy(field.GetArray('CameraIntrinsics')).reshape(3, 3)
    arrays['cam_from_world'] = vtk_to_numpy(field.GetArray('CameraFromWorld')).reshape(3, 4)
    arrays['size'] = tuple(int(x) for x in vtk_to_numpy(field.GetArray('ImageSize')).ravel())
    return arrays


def views(blocks):
    """All views of a multi-block data set: a dict of name to view_arrays."""
    return {blocks.GetMetaData(i).Get(vtkCompositeDataSet.NAME()): view_arrays(blocks.GetBlock(i))
            for i in range(blocks.GetNumberOfBlocks())}


def make_view(points, image_points, K, cam_from_world, size, image_file='', *, copy=True):
    """A view's block from arrays of the shapes that view_arrays returns.

    With copy=False points and image_points that are contiguous rows of float64 are not copied: the block shows what is
    later written into them.

    Raises ValueError for other shapes, a K that is not upper triangular with positive focal lengths, and a
    cam_from_world that is no rotation with a translation.
    """
    points = rows(points, 3, 'points')
    image_points = rows(image_points, 2, 'image_points')
    K = np.asarray(K, np.float64)
    cam_from_world = np.asarray(cam_from_world, np.float64)
    _check_camera(K, cam_from_world)
    if len(points) != len(image_points):
        raise ValueError(f'{len(points)} points but {len(image_points)} image points')
    block = vtkPolyData()
    block.SetPoints(vtk_points(points, copy))
    n = len(points)
    vertices = vtkCellArray()
    vertices.SetData(_ids(np.arange(n + 1)), _ids(np.arange(n)))
    block.SetVerts(vertices)
    block.GetPointData().AddArray(_named(image_points, 'ImagePoint', copy))
    _add_camera(block, K, cam_from_world, size, image_file)
    return block


def make_image(pixels, K, cam_from_world, *, copy=True):
    """An image's block for vtkEdgeStereoReader, vtkTextureBaker or vtkViewDependentTextureMapper.

    pixels is (height, width) grey, (height, width, 3) red, green, blue or (height, width, 4) with alpha, the top row
    first, of uint8, uint16, float32 or float64. make_views makes a data set of several. VTK has the bottom row first: with
    copy=False the memory of such an image is not copied, so that pixels is a contiguous array turned by [::-1]. Raises
    ValueError as make_view does.
    """
    pixels = np.asarray(pixels)
    if pixels.ndim not in (2, 3) or pixels.size == 0 or (pixels.ndim == 3 and pixels.shape[2] not in (1, 3, 4)):
        raise ValueError(f'pixels has the shape {pixels.shape}, expected (height, width) and 1, 3 or 4 channels')
    if pixels.dtype not in (np.uint8, np.uint16, np.float32, np.float64):
        raise ValueError(f'pixels has the type {pixels.dtype}, expected uint8, uint16, float32 or float64')
    K = np.asarray(K, np.float64)
    cam_from_world = np.asarray(cam_from_world, np.float64)
    _check_camera(K, cam_from_world)
    height, width = pixels.shape[:2]
    image = vtkImageData()
    image.SetDimensions(width, height, 1)
    image.GetPointData().SetScalars(_named(pixels[::-1].reshape(height * width, -1), 'Pixels', copy))
    _add_camera(image, K, cam_from_world, (width, height), '')
    return image


def _add_camera(block, K, cam_from_world, size, image_file):
    field = block.GetFieldData()
    field.AddArray(_named(np.asarray(K, float).reshape(1, 9), 'CameraIntrinsics'))
    field.AddArray(_named(np.asarray(cam_from_world, float).reshape(1, 12), 'CameraFromWorld'))
    field.AddArray(_named(np.asarray(size, np.int32).reshape(1, 2), 'ImageSize'))
    file = vtkStringArray()
    file.SetName('ImageFile')
    file.InsertNextValue(image_file)
    field.AddArray(file)


def rows(array, columns, name):
    """The array as contiguous doubles of shape (n, columns); an empty one may have any shape."""
    array = np.ascontiguousarray(array, np.float64)
    if array.size == 0:
        return array.reshape(0, columns)
    if array.ndim != 2 or array.shape[1] != columns:
        raise ValueError(f'{name} has the shape {array.shape}, expected (n, {columns})')
    return array


def _check_camera(K, cam_from_world):
    if K.shape != (3, 3):
        raise ValueError(f'K has the shape {K.shape}, expected (3, 3)')
    if not np.isfinite(K).all() or K[0, 0] <= 0 or K[1, 1] <= 0 or K[2, 2] <= 0 \
            or K[1, 0] != 0 or K[2, 0] != 0 or K[2, 1] != 0:
        raise ValueError('K is not upper triangular with a positive diagonal; is it transposed?')
    if cam_from_world.shape != (3, 4):
        raise ValueError(f'cam_from_world has the shape {cam_from_world.shape}, expected (3, 4)')
    rotation = cam_from_world[:, :3]
    if not np.isfinite(cam_from_world).all() or np.linalg.det(rotation) <= 0 \
            or not np.allclose(rotation @ rotation.T, np.eye(3), atol=1e-4):
        raise ValueError('cam_from_world does not begin with a rotation')


def make_views(blocks):
    """A multi-block data set from a dict of name to block."""
    data = vtkMultiBlockDataSet()
    for i, (name, block) in enumerate(blocks.items()):
        data.SetBlock(i, block)
        data.GetMetaData(i).Set(vtkCompositeDataSet.NAME(), name)
    return data


def surface_arrays(surface):
    """Vertices (n, 3) and triangles (m, 3) of a surface.

    Raises ValueError where the surface has other cells than triangles.
    """
    if surface.GetNumberOfPoints() == 0:
        return np.zeros((0, 3)), np.zeros((0, 3), int)
    return vtk_to_numpy(surface.GetPoints().GetData()), _triangles(surface)


def _triangles(poly_data):
    cells = poly_data.GetPolys()
    if cells.GetNumberOfCells() == 0:
        return np.zeros((0, 3), int)
    if poly_data.GetNumberOfStrips() or not (np.diff(vtk_to_numpy(cells.GetOffsetsArray())) == 3).all():
        raise ValueError('the surface has other cells than triangles; vtkTriangleFilter makes them triangles')
    return vtk_to_numpy(cells.GetConnectivityArray()).reshape(-1, 3)


def vtk_array(array, copy=True):
    """A VTK array of a numpy array. Without a copy it shows the array's own memory, which it keeps alive; memory that is
    not contiguous or may not be written to is always copied."""
    array = np.ascontiguousarray(array)
    return numpy_to_vtk(array, deep=copy or not array.flags.writeable)


def vtk_points(array, copy=True):
    """vtkPoints of rows of three doubles, as vtk_array has them."""
    points = vtkPoints()
    points.SetData(vtk_array(array, copy))
    return points


def _named(array, name, copy=True):
    data = vtk_array(array, copy)
    data.SetName(name)
    return data


def _ids(array):
    return vtk_array(np.asarray(array, np.int64))
