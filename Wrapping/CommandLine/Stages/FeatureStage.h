// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_FeatureStage_h
#define freespace_FeatureStage_h

#include "Stages/DensifyStage.h"
#include "Stages/SparseStage.h"
#include "Stages/StereoStage.h"

namespace freespace
{

/// A scene.json or a structure-from-motion model -> features: by stereo, or the points of the model, densified where
/// asked for.
///
/// Has the options that `reconstruct` and `report` share. Run throws Error when it fails, or when an option of the one
/// is given for the other.
class FeatureStage
{
public:
  void AddOptions(CLI::App& command);
  vtkSmartPointer<vtkMultiBlockDataSet> Run(Session& session, const std::string& source) const;

  static bool IsModel(const std::string& source);

  /// Of the images that densify a model; empty where none do.
  const std::string& DensifyFolder() const { return this->Densify.Folder(); }

private:
  StereoStage Stereo;
  SparseStage Sparse;
  DensifyStage Densify;
};

}

#endif
