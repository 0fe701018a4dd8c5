// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SparseModelBlocks_h
#define freespace_SparseModelBlocks_h

#include "SparseModel/SparseModel.h"
#include "SparseModel/SparseViews.h"
#include "vtkFreespaceReadersModule.h"

class vtkMultiBlockDataSet;

namespace freespace
{

/// Converts structure-from-motion models to blocks of a vtkMultiBlockDataSet and back. Only this file
/// knows the arrays that hold what a model has beyond the arrays of ViewBlocks.h; they are listed at
/// vtkSparseModelReader.

/// Fills the blocks with the views and the model's data of their images and points.
VTKFREESPACEREADERS_EXPORT void BlocksFromModel(
  const SparseModel& model, const std::vector<SparseView>& views, vtkMultiBlockDataSet* blocks);

/// The model of blocks. Blocks that do not come from a model become images with a pinhole camera
/// each, and points that one image sees. Throws Error, naming the view, when a block is no view,
/// when two have the same image, or when a camera is no pinhole camera.
VTKFREESPACEREADERS_EXPORT SparseModel ModelFromBlocks(vtkMultiBlockDataSet* blocks);

}

#endif
