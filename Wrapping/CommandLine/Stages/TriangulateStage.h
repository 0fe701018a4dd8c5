// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_TriangulateStage_h
#define freespace_TriangulateStage_h

#include "Disparity/Maps/DisparityMaps.h"

#include <CLI/CLI.hpp>

#include <vtkSmartPointer.h>

#include <string>

class vtkMultiBlockDataSet;

namespace freespace
{

class Session;

/// The minimum support of a feature, of one name for all commands.
void AddSupportOption(CLI::App& command, int& support, const std::string& group);

/// features -> disparity maps: vtkDelaunayDisparityFilter.
///
/// Has the options that its own command and `reconstruct` share. Run throws Error when it fails.
class TriangulateStage
{
public:
  void AddOptions(CLI::App& command);
  vtkSmartPointer<vtkMultiBlockDataSet> Run(Session& session, vtkMultiBlockDataSet* features) const;

  /// Minimum number of neighbours that a feature needs.
  int MinimumSupport() const { return this->Support; }

private:
  int Support = OutlierOptions().support;
  int SharingViews = OutlierOptions().sharingViews;
  double SupportRadius = OutlierOptions().radius;
  int SeeThroughViews = OutlierOptions().seeThroughViews;
  int ViolatingFeatures = OutlierOptions().violatingFeatures;
  double FeatureSpacing = FeatureThinningOptions().spacing;
  double Tolerance = DelaunayDisparityOptions().tolerance;
  int PartnerViews = DelaunayDisparityOptions().partners.most;
  int BackgroundViews = BackgroundOptions().partners.most;
  double LongestEdge = TrimOptions().longestEdge;
  double GreatestDepthRatio = TrimOptions().greatestDepth;
  bool KeepEdges = DelaunayDisparityOptions().keepEdges;
  std::string Background = "auto";
};

}

#endif
