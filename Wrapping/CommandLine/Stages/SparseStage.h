// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SparseStage_h
#define freespace_SparseStage_h

#include "SparseModel/SparseViews.h"
#include "Options/SupportOption.h"
#include "Options/WrongImagesOption.h"

#include <CLI/CLI.hpp>

#include <vtkSmartPointer.h>

#include <string>

class vtkMultiBlockDataSet;

namespace freespace
{

class Session;

/// Structure-from-motion model -> features: vtkSparseModelReader, vtkOutlierFilter. Like the other stages (Stages.h).
class SparseStage
{
public:
  void AddOptions(CLI::App& command);
  vtkSmartPointer<vtkMultiBlockDataSet> Run(Session& session, const std::string& model) const;

private:
  int MinimumTrackLength = SparseViewOptions().minimumTrackLength;
  double MaximumError = SparseViewOptions().maximumError;
  double MinimumAngle = SparseViewOptions().minimumAngle;
  SupportOption Support;
  WrongImagesOption WrongImages;
};

}

#endif
