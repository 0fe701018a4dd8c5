// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ViewBlocks_h
#define freespace_ViewBlocks_h

#include "Common/DisparityMap.h"
#include "Common/View.h"
#include "vtkFreespaceFiltersModule.h"

#include <vtkSmartPointer.h>

class vtkDataObject;
class vtkMultiBlockDataSet;
class vtkPolyData;

namespace freespace
{

/// Conversion of views and disparity maps to blocks of a vtkMultiBlockDataSet, and back. The only place
/// that defines their arrays:
///
/// | where     | name             | type       |
/// |-----------|------------------|------------|
/// | Points    |                  | double     |
/// | PointData | ImagePoint       | double x2  |
/// | PointData | DisparityDeviation | double, of 1 / depth; 0: not known (optional) |
/// | PointData | SourceView       | int (maps) |
/// | PointData | RGB              | unsigned char x3 (edge stereo) |
/// | PointData | EdgeDirection    | double x3 (edge stereo)        |
/// | PointData | MatchingCost     | double (edge stereo)           |
/// | PointData | ChainId          | int (edge stereo)              |
/// | FieldData | CameraIntrinsics | double x9  |
/// | FieldData | CameraFromWorld  | double x12 |
/// | FieldData | ImageSize        | int x2     |
/// | FieldData | ImageFile        | string     |
///
/// Lines of a view are its edges: features that an image edge joins.

/// The block of a view, with a vertex cell for each feature so that it can be rendered.
VTKFREESPACEFILTERS_EXPORT vtkSmartPointer<vtkPolyData> BlockFromView(const View& view);

/// The same with the arrays of edge stereo, the chains as polylines.
VTKFREESPACEFILTERS_EXPORT vtkSmartPointer<vtkPolyData> BlockFromEdgeView(const EdgeView& view);

/// The block of a disparity map, with its triangles.
VTKFREESPACEFILTERS_EXPORT vtkSmartPointer<vtkPolyData> BlockFromMap(const DisparityMap& map);

/// The camera and image file alone, to and from the field data of any data object.
VTKFREESPACEFILTERS_EXPORT void AddCamera(
  vtkDataObject* block, const Camera& camera, const std::string& imageFile);
VTKFREESPACEFILTERS_EXPORT Camera CameraFromBlock(vtkDataObject* block, const std::string& name);

/// The view of a block. Throws Error, naming the block, when an array is missing or of a wrong shape.
VTKFREESPACEFILTERS_EXPORT View ViewFromBlock(vtkPolyData* block, const std::string& name);

/// The same with triangles and SourceView (the view's own index if the array is missing).
VTKFREESPACEFILTERS_EXPORT DisparityMap MapFromBlock(
  vtkPolyData* block, const std::string& name, int ownIndex);

/// The name of a block, or "block N" where it has none.
VTKFREESPACEFILTERS_EXPORT std::string BlockName(vtkMultiBlockDataSet* blocks, unsigned int index);

/// All views of a data set in its order. Throws Error when a block is not a vtkPolyData.
VTKFREESPACEFILTERS_EXPORT std::vector<View> ViewsFromBlocks(vtkMultiBlockDataSet* blocks);
VTKFREESPACEFILTERS_EXPORT DisparityMap MapFromBlocks(
  vtkMultiBlockDataSet* blocks, unsigned int index);
VTKFREESPACEFILTERS_EXPORT std::vector<DisparityMap> MapsFromBlocks(vtkMultiBlockDataSet* blocks);

/// Sets block `index` and its name.
VTKFREESPACEFILTERS_EXPORT void SetNamedBlock(
  vtkMultiBlockDataSet* blocks, unsigned int index, const std::string& name, vtkPolyData* block);

/// A copy of the blocks whose names and ImageFile went through a function, such as Utf8FromName for XML;
/// the other arrays are shared.
VTKFREESPACEFILTERS_EXPORT vtkSmartPointer<vtkMultiBlockDataSet> WithNames(
  vtkMultiBlockDataSet* blocks, std::string (*changed)(const std::string&));

}

#endif
