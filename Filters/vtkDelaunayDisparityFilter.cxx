// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDelaunayDisparityFilter.h"

#include "Common/ParallelForWithProgress.h"
#include "Data/ViewBlocks.h"
#include "Data/ViewInput.h"
#include "Disparity/Background/BackgroundContinuation.h"
#include "Disparity/DelaunayDisparity.h"
#include "Disparity/FeatureCloud.h"
#include "Disparity/FeatureThinning.h"
#include "Disparity/LongTriangles.h"
#include "Disparity/OutlierRejection.h"
#include "Execution/AlgorithmErrors.h"
#include "Execution/AlgorithmProgress.h"
#include "Execution/SMPParallelFor.h"

#include <vtkErrorCode.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <optional>
#include <vector>

vtkStandardNewMacro(vtkDelaunayDisparityFilter);

vtkDelaunayDisparityFilter::vtkDelaunayDisparityFilter()
{
  const freespace::DelaunayDisparityOptions disparity;
  this->MinimumDisparity = disparity.minimumDisparity;
  this->Tolerance = disparity.tolerance;
  this->KeepEdges = disparity.keepEdges;
  this->PartnerViews = disparity.partners.most;
  const freespace::BackgroundContinuationOptions background;
  this->ContinueBackground = true;
  this->BackgroundViews = background.partners.most;
  this->GrazingAngle = background.grazingAngle;
  this->RefutingViews = background.views;
  const freespace::OutlierRejectionOptions outliers;
  this->SupportingNeighbors = outliers.neighbors;
  this->SeeThroughViews = outliers.seeThroughViews;
  this->ViolatingFeatures = outliers.violatingFeatures;
  this->FeatureSpacing = freespace::FeatureThinningOptions().spacing;
  const freespace::LongTrianglesOptions trim;
  this->LongestEdge = trim.longestEdge;
  this->GreatestDepthRatio = trim.greatestDepth;
}

int vtkDelaunayDisparityFilter::FillInputPortInformation(int, vtkInformation* info)
{
  freespace::AcceptViews(info);
  return 1;
}

int vtkDelaunayDisparityFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputVector);
  freespace::DelaunayDisparityOptions options;
  options.minimumDisparity = this->MinimumDisparity != 0;
  options.tolerance = this->Tolerance;
  options.keepEdges = this->KeepEdges != 0;
  freespace::BackgroundContinuationOptions background;
  background.grazingAngle = this->GrazingAngle;
  background.views = this->RefutingViews;
  options.partners.most = this->PartnerViews;
  background.partners.most = this->BackgroundViews;
  freespace::OutlierRejectionOptions outliers;
  outliers.neighbors = this->SupportingNeighbors;
  outliers.seeThroughViews = this->SeeThroughViews;
  outliers.violatingFeatures = this->ViolatingFeatures;
  freespace::FeatureThinningOptions thinning;
  thinning.spacing = this->FeatureSpacing;
  freespace::LongTrianglesOptions untrusted;
  untrusted.longestEdge = this->LongestEdge;
  untrusted.greatestDepth = this->GreatestDepthRatio;
  try
  {
    const auto input = freespace::ViewsOf(inputVector[0]);
    const freespace::Progress progress = freespace::AlgorithmProgress(this);
    untrusted.Check();
    thinning.Check();
    std::vector<freespace::View> views = freespace::ViewsFromBlocks(input);
    freespace::ParallelForWithProgress(views.size(), freespace::SMPParallelFor,
      progress.Part(0.0, 0.02),
      [&](std::size_t v, const freespace::CancellationFlag&)
      { views[v] = freespace::ThinFeatures(views[v], thinning); });
    if (this->SupportingNeighbors != 0 || this->SeeThroughViews != 0 ||
      this->ViolatingFeatures != 0)
    {
      freespace::DelaunayDisparityOptions own = options;
      own.minimumDisparity = false;
      const std::vector<freespace::DisparityMap> maps = freespace::TriangulateViews(
        views, own, freespace::SMPParallelFor, progress.Part(0.02, 0.15));
      views = freespace::RejectOutliers(
        views, maps, outliers, freespace::SMPParallelFor, progress.Part(0.15, 0.25));
    }
    std::optional<freespace::FeatureCloud> cloud;
    freespace::RunWithProgress(progress.Part(0.25, 0.3),
      [&](const freespace::CancellationFlag& stop) { cloud.emplace(views, stop); });
    std::vector<freespace::DisparityMap> maps = freespace::TriangulateViews(
      views, *cloud, options, freespace::SMPParallelFor, progress.Part(0.3, 0.65));
    views.clear();
    if (this->ContinueBackground)
    {
      freespace::ContinueBackground(
        maps, *cloud, background, freespace::SMPParallelFor, progress.Part(0.65, 0.95));
    }
    std::vector<vtkSmartPointer<vtkPolyData>> blocks(maps.size());
    freespace::ParallelForWithProgress(maps.size(), freespace::SMPParallelFor,
      progress.Part(0.95, 1.0),
      [&](std::size_t i, const freespace::CancellationFlag&)
      {
        freespace::RemoveLongTriangles(maps[i], untrusted);
        blocks[i] = freespace::BlockFromMap(maps[i]);
        // Not all of them twice in memory.
        freespace::DisparityMap named;
        named.name = maps[i].name;
        maps[i] = std::move(named);
      });
    for (std::size_t i = 0; i < maps.size(); ++i)
    {
      freespace::SetNamedBlock(output, static_cast<unsigned int>(i), maps[i].name, blocks[i]);
    }
  }
  catch (...)
  {
    return freespace::AfterException(this);
  }
  return 1;
}

void vtkDelaunayDisparityFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MinimumDisparity: " << this->MinimumDisparity << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "KeepEdges: " << this->KeepEdges << "\n";
  os << indent << "PartnerViews: " << this->PartnerViews << "\n";
  os << indent << "ContinueBackground: " << this->ContinueBackground << "\n";
  os << indent << "BackgroundViews: " << this->BackgroundViews << "\n";
  os << indent << "GrazingAngle: " << this->GrazingAngle << "\n";
  os << indent << "RefutingViews: " << this->RefutingViews << "\n";
  os << indent << "SupportingNeighbors: " << this->SupportingNeighbors << "\n";
  os << indent << "SeeThroughViews: " << this->SeeThroughViews << "\n";
  os << indent << "ViolatingFeatures: " << this->ViolatingFeatures << "\n";
  os << indent << "FeatureSpacing: " << this->FeatureSpacing << "\n";
  os << indent << "LongestEdge: " << this->LongestEdge << "\n";
  os << indent << "GreatestDepthRatio: " << this->GreatestDepthRatio << "\n";
}
