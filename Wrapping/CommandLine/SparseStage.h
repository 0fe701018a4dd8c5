// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SparseStage_h
#define freespace_SparseStage_h

#include <CLI/CLI.hpp>

#include <vtkSmartPointer.h>

#include <string>

class vtkMultiBlockDataSet;

namespace freespace
{

class Session;

/// Structure-from-motion model -> features: vtkSparseModelReader. Like the other stages (Stages.h).
class SparseStage
{
public:
  void AddOptions(CLI::App& command);
  vtkSmartPointer<vtkMultiBlockDataSet> Run(Session& session, const std::string& model) const;

private:
  int MinimumTrackLength = 3;
  double MaximumError = 4;
  double MinimumAngle = 1;
};

}

#endif
