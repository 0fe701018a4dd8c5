// SPDX-License-Identifier: BSD-3-Clause
#include "Stages/TriangulateStage.h"

#include "Session/NumberValidators.h"
#include "Session/Session.h"

#include <vtkDelaunayDisparityFilter.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

namespace freespace
{

namespace
{

// Whether features are points of a structure-from-motion model rather than of edges.
bool AreIsolated(vtkMultiBlockDataSet* features)
{
  for (unsigned int i = 0; i < features->GetNumberOfBlocks(); ++i)
  {
    auto* view = vtkPolyData::SafeDownCast(features->GetBlock(i));
    if (!view || !view->GetPointData()->HasArray("PointId"))
    {
      return false;
    }
  }
  return true;
}

}

void TriangulateStage::AddOptions(CLI::App& command)
{
  this->Support.AddTo(command, "Disparity maps");
  command
    .add_option("--support-radius", this->SupportRadius,
      "Neighbourhood of a feature in mean distances between features; 0: its six nearest in the "
      "triangulation")
    ->check(NonNegative())
    ->capture_default_str()
    ->group("Disparity maps");
  command
    .add_option("--feature-spacing", this->FeatureSpacing,
      "Features that are closer in the image, at one depth, become one, pixels; 0 keeps all")
    ->check(NonNegative())
    ->capture_default_str()
    ->group("Disparity maps");
  command
    .add_option("--tolerance", this->Tolerance,
      "Tolerance of the minimum disparity constraint, as a fraction of the depth")
    ->check(NonNegative())
    ->capture_default_str()
    ->group("Disparity maps");
  command
    .add_option("--partner-views", this->PartnerViews,
      "Number of other views whose features can be inserted into a view; 0: all")
    ->check(CLI::Range(0, 1000000))
    ->capture_default_str()
    ->group("Disparity maps");
  command
    .add_option("--see-through", this->SeeThroughViews,
      "A feature in the free space of this number of other views is an outlier; 0: none is")
    ->check(CLI::Range(0, 1000))
    ->capture_default_str()
    ->group("Disparity maps");
  command
    .add_option("--violating", this->ViolatingFeatures,
      "A triangle that this number of features of other views violate is wrong, and its farthest "
      "corner an outlier; 0: none is")
    ->check(CLI::Range(0, 1000))
    ->capture_default_str()
    ->group("Disparity maps");
  command
    .add_option("--longest-edge", this->LongestEdge,
      "Maximum edge length of a triangle in the image that claims free space, pixels; 0: no limit")
    ->check(NonNegative())
    ->capture_default_str()
    ->group("Disparity maps");
  command
    .add_option("--depth-ratio", this->GreatestDepthRatio,
      "Maximum ratio of the depths of a triangle that claims free space; 0: no limit")
    ->check(NonNegative())
    ->capture_default_str()
    ->group("Disparity maps");
  command
    .add_flag(
      "--keep-edges", this->KeepEdges, "Triangles do not cross the edges that the stereo found")
    ->group("Disparity maps");
  command
    .add_option("--spatial-flips", this->SpatialFlips,
      "Flip edges of triangles that are badly shaped in space: on, or off as in the paper")
    ->check(CLI::IsMember({ "on", "off" }))
    ->capture_default_str()
    ->group("Disparity maps");
  command
    .add_option("--background", this->Background,
      "Continue the background behind occluding edges: on, off, or auto, which is off for the "
      "isolated points of a structure-from-motion model")
    ->check(CLI::IsMember({ "auto", "on", "off" }))
    ->capture_default_str()
    ->group("Disparity maps");
  command
    .add_option("--background-views", this->BackgroundViews,
      "Number of other views that are used to continue the background; 0: all")
    ->check(CLI::Range(0, 1000000))
    ->capture_default_str()
    ->group("Disparity maps");
}

vtkSmartPointer<vtkMultiBlockDataSet> TriangulateStage::Run(
  Session& session, vtkMultiBlockDataSet* features) const
{
  vtkNew<vtkDelaunayDisparityFilter> maps;
  maps->SetInputDataObject(features);
  maps->SetSharedWork(session.Shared());
  maps->SetFeatureSpacing(this->FeatureSpacing);
  maps->SetPartnerViews(this->PartnerViews);
  maps->SetTolerance(this->Tolerance);
  maps->SetSupport(this->Support.Support());
  maps->SetSharingViews(this->Support.SharingViews());
  maps->SetSupportRadius(this->SupportRadius);
  maps->SetSeeThroughViews(this->SeeThroughViews);
  maps->SetViolatingFeatures(this->ViolatingFeatures);
  maps->SetLongestEdge(this->LongestEdge);
  maps->SetGreatestDepthRatio(this->GreatestDepthRatio);
  maps->SetKeepEdges(this->KeepEdges);
  maps->SetSpatialFlips(this->SpatialFlips == "on");
  maps->SetBackgroundViews(this->BackgroundViews);
  maps->SetContinueBackground(
    this->Background == "on" || (this->Background == "auto" && !AreIsolated(features)));
  session.Run(maps, "triangulate");
  vtkSmartPointer<vtkMultiBlockDataSet> result = maps->GetOutput();
  session.Log("triangulate: " + std::to_string(result->GetNumberOfPoints()) + " points, " +
    std::to_string(result->GetNumberOfCells()) + " triangles");
  return result;
}

}
