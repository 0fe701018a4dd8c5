// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_DensifyStage_h
#define freespace_DensifyStage_h

#include <CLI/CLI.hpp>

#include <vtkSmartPointer.h>

#include <string>

class vtkMultiBlockDataSet;

namespace freespace
{

class Session;
class StereoStage;

/// Features of a structure-from-motion model -> the same with those that edge stereo finds in the
/// images at the model's own poses: vtkClusterProposal, vtkEdgeStereoReader, vtkMergeViewsFilter.
/// Like the other stages (Stages.h).
class DensifyStage
{
public:
  void AddOptions(CLI::App& command);
  bool IsWanted() const { return !this->Images.empty(); }
  const std::string& Folder() const { return this->Images; }
  vtkSmartPointer<vtkMultiBlockDataSet> Run(Session& session, const std::string& model,
    vtkMultiBlockDataSet* sparse, const StereoStage& stereo) const;

private:
  std::string Images;
};

}

#endif
