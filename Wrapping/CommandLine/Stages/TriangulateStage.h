// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_TriangulateStage_h
#define freespace_TriangulateStage_h

#include "Disparity/Background/BackgroundContinuation.h"
#include "Disparity/DelaunayDisparity.h"
#include "Disparity/FeatureSupport.h"
#include "Disparity/FeatureThinning.h"
#include "Disparity/LongTriangles.h"
#include "Disparity/OutlierRejection.h"

#include <CLI/CLI.hpp>

#include <vtkSmartPointer.h>

#include <string>

class vtkMultiBlockDataSet;

namespace freespace
{

class Session;

/// features -> disparity maps: vtkFeatureSupportFilter, vtkDelaunayDisparityFilter.
///
/// Has the options that its own command and `reconstruct` share. Run throws Error when it fails.
class TriangulateStage
{
public:
  void AddOptions(CLI::App& command);
  vtkSmartPointer<vtkMultiBlockDataSet> Run(Session& session, vtkMultiBlockDataSet* features) const;

private:
  double SupportRadius = FeatureSupportOptions().radius;
  int SupportNeighbors = FeatureSupportOptions().minimumNeighbors;
  double FeatureSpacing = FeatureThinningOptions().spacing;
  double Tolerance = DelaunayDisparityOptions().tolerance;
  int PartnerViews = DelaunayDisparityOptions().partners.most;
  int BackgroundViews = BackgroundContinuationOptions().partners.most;
  int SupportingNeighbors = OutlierRejectionOptions().neighbors;
  int SeeThroughViews = OutlierRejectionOptions().seeThroughViews;
  int ViolatingFeatures = OutlierRejectionOptions().violatingFeatures;
  double LongestEdge = LongTrianglesOptions().longestEdge;
  double GreatestDepthRatio = LongTrianglesOptions().greatestDepth;
  bool KeepEdges = DelaunayDisparityOptions().keepEdges;
  std::string Background = "auto";
};

}

#endif
