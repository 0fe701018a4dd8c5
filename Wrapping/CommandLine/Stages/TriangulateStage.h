// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_TriangulateStage_h
#define freespace_TriangulateStage_h

#include "Disparity/Maps/DisparityMaps.h"
#include "Options/SupportOption.h"

#include <CLI/CLI.hpp>

#include <vtkSmartPointer.h>

#include <string>

class vtkMultiBlockDataSet;

namespace freespace
{

class Session;

/// features -> disparity maps: vtkDelaunayDisparityFilter.
///
/// Has the options that its own command and `reconstruct` share. Run throws Error when it fails.
class TriangulateStage
{
public:
  void AddOptions(CLI::App& command);
  vtkSmartPointer<vtkMultiBlockDataSet> Run(Session& session, vtkMultiBlockDataSet* features) const;

private:
  SupportOption Support;
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
  std::string SpatialFlips = DelaunayDisparityOptions().spatialFlips ? "on" : "off";
  std::string Background = "auto";
};

}

#endif
