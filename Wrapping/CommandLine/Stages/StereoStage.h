// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_StereoStage_h
#define freespace_StereoStage_h

#include "Options/ClusterChoice.h"
#include "Options/EdgeThresholds.h"
#include "Options/WrongImagesOption.h"

#include <CLI/CLI.hpp>

#include <vtkSmartPointer.h>

#include <string>

class vtkMultiBlockDataSet;

namespace freespace
{

class Session;

/// scene.json -> features: vtkEdgeStereoReader.
///
/// Has the options that its own command and `reconstruct` share. Run throws Error when it fails.
class StereoStage
{
public:
  void AddOptions(CLI::App& command);
  vtkSmartPointer<vtkMultiBlockDataSet> Run(Session& session, const std::string& scene) const;

  const ClusterChoice& Clusters() const { return this->Choice; }
  bool NeedsMasks() const { return this->MaskIsFree; }

private:
  double MinimumDepth = 0;
  double MaximumDepth = 0;
  std::string EveryImage = "auto";    // empty: on
  std::string RefineCameras = "auto"; // empty: on
  EdgeThresholds Thresholds;
  WrongImagesOption WrongImages;
  bool NoPatches = false;
  bool MaskIsFree = false;
  ClusterChoice Choice;
};

}

#endif
