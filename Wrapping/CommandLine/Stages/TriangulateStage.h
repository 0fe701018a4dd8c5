// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_TriangulateStage_h
#define freespace_TriangulateStage_h

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
  double SupportRadius = 4;
  int SupportNeighbors = 0;
  double Tolerance = 0.0002;
  int SupportingNeighbors = 2;
  int SeeThroughViews = 0;
  int ViolatingFeatures = 0;
  double LongestEdge = 0;
  double GreatestDepthRatio = 0;
  bool KeepEdges = false;
  std::string Background = "auto";
};

}

#endif
