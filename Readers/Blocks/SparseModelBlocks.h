// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SparseModelBlocks_h
#define freespace_SparseModelBlocks_h

#include "SparseModel/SparseModel.h"
#include "SparseModel/SparseViews.h"
#include "vtkFreespaceReadersModule.h"

class vtkMultiBlockDataSet;

namespace freespace
{

/// Structure-from-motion models as blocks of a vtkMultiBlockDataSet, and back. The one place that
/// knows the arrays which, beside those of ViewBlocks.h, keep what a model has more than views
/// have; they are listed at vtkSparseModelReader.

/// Fills the blocks with the views and what the model knows of their images and points.
VTKFREESPACEREADERS_EXPORT void BlocksFromModel(
  const SparseModel& model, const std::vector<SparseView>& views, vtkMultiBlockDataSet* blocks);

/// The model of blocks. Those that no model was the source of become images with a pinhole camera
/// each and points that one image sees. Throws Error, naming the view, when a block is no view,
/// when two have the same image, or when a camera is no pinhole camera.
VTKFREESPACEREADERS_EXPORT SparseModel ModelFromBlocks(vtkMultiBlockDataSet* blocks);

}

#endif
