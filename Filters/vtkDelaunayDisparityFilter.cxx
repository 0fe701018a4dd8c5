// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDelaunayDisparityFilter.h"

#include "AlgorithmProgress.h"
#include "ContinueBackground.h"
#include "DelaunayDisparity.h"
#include "RejectOutliers.h"
#include "SMPParallelFor.h"
#include "UntrustedTriangles.h"
#include "ViewBlocks.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

vtkStandardNewMacro(vtkDelaunayDisparityFilter);

int vtkDelaunayDisparityFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkMultiBlockDataSet* input = vtkMultiBlockDataSet::GetData(inputVector[0]);
  vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputVector);
  freespace::DelaunayDisparityOptions options;
  options.minimumDisparity = this->MinimumDisparity != 0;
  options.tolerance = this->Tolerance;
  options.keepEdges = this->KeepEdges != 0;
  freespace::ContinueBackgroundOptions background;
  background.grazingAngle = this->GrazingAngle;
  background.views = this->RefutingViews;
  freespace::RejectOutliersOptions outliers;
  outliers.neighbors = this->SupportingNeighbors;
  outliers.seeThroughViews = this->SeeThroughViews;
  outliers.violatingFeatures = this->ViolatingFeatures;
  freespace::UntrustedTrianglesOptions untrusted;
  untrusted.longestEdge = this->LongestEdge;
  untrusted.greatestDepth = this->GreatestDepthRatio;
  try
  {
    const freespace::Progress progress = freespace::AlgorithmProgress(this);
    untrusted.Check();
    std::vector<freespace::View> views = freespace::ViewsFromBlocks(input);
    if (this->SupportingNeighbors != 0 || this->SeeThroughViews != 0 ||
      this->ViolatingFeatures != 0)
    {
      freespace::DelaunayDisparityOptions own = options;
      own.minimumDisparity = false;
      const std::vector<freespace::DisparityMap> maps =
        freespace::TriangulateViews(views, own, freespace::SMPParallelFor, progress.Part(0.0, 0.2));
      views = freespace::RejectOutliers(
        views, maps, outliers, freespace::SMPParallelFor, progress.Part(0.2, 0.3));
    }
    std::vector<freespace::DisparityMap> maps = freespace::TriangulateViews(
      views, options, freespace::SMPParallelFor, progress.Part(0.3, 0.7));
    if (this->ContinueBackground)
    {
      freespace::ContinueBackground(
        maps, views, background, freespace::SMPParallelFor, progress.Part(0.7, 0.9));
    }
    views.clear();
    progress(0.9);
    for (std::size_t i = 0; i < maps.size(); ++i)
    {
      freespace::RemoveUntrustedTriangles(maps[i], untrusted);
      freespace::SetNamedBlock(
        output, static_cast<unsigned int>(i), maps[i].name, freespace::BlockFromMap(maps[i]));
      maps[i] = {}; // not all of them twice in memory
    }
  }
  catch (...)
  {
    return freespace::AfterException(this, output);
  }
  return 1;
}

void vtkDelaunayDisparityFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MinimumDisparity: " << this->MinimumDisparity << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "KeepEdges: " << this->KeepEdges << "\n";
  os << indent << "ContinueBackground: " << this->ContinueBackground << "\n";
  os << indent << "GrazingAngle: " << this->GrazingAngle << "\n";
  os << indent << "RefutingViews: " << this->RefutingViews << "\n";
  os << indent << "SupportingNeighbors: " << this->SupportingNeighbors << "\n";
  os << indent << "SeeThroughViews: " << this->SeeThroughViews << "\n";
  os << indent << "ViolatingFeatures: " << this->ViolatingFeatures << "\n";
  os << indent << "LongestEdge: " << this->LongestEdge << "\n";
  os << indent << "GreatestDepthRatio: " << this->GreatestDepthRatio << "\n";
}
