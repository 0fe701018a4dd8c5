// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDelaunayDisparityFilter.h"

#include "Data/SilhouetteBlocks.h"
#include "Data/ViewBlocks.h"
#include "Data/ViewInput.h"
#include "Disparity/Maps/DisparityMaps.h"
#include "Execution/AlgorithmErrors.h"
#include "Execution/AlgorithmProgress.h"
#include "Execution/SMPParallelFor.h"

#include <vtkErrorCode.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkDelaunayDisparityFilter);

vtkDelaunayDisparityFilter::vtkDelaunayDisparityFilter()
{
  const freespace::DisparityMapOptions options;
  this->FeatureSpacing = options.thinning.spacing;
  this->MinimumDisparity = options.disparity.minimumDisparity;
  this->Tolerance = options.disparity.tolerance;
  this->KeepEdges = options.disparity.keepEdges;
  this->SpatialFlips = options.disparity.spatialFlips;
  this->PartnerViews = options.disparity.partners.most;
  this->ContinueBackground = options.continueBackground;
  this->BackgroundViews = options.background.partners.most;
  this->GrazingAngle = options.background.grazingAngle;
  this->RefutingViews = options.background.views;
  this->LongestEdge = options.trim.longestEdge;
  this->GreatestDepthRatio = options.trim.greatestDepth;
}

freespace::DisparityMapOptions vtkDelaunayDisparityFilter::Options() const
{
  freespace::DisparityMapOptions options;
  options.thinning.spacing = this->FeatureSpacing;
  options.outliers = this->Outliers();
  options.disparity.minimumDisparity = this->MinimumDisparity != 0;
  options.disparity.tolerance = this->Tolerance;
  options.disparity.keepEdges = this->KeepEdges != 0;
  options.disparity.spatialFlips = this->SpatialFlips != 0;
  options.disparity.partners.most = this->PartnerViews;
  options.continueBackground = this->ContinueBackground != 0;
  options.background.partners.most = this->BackgroundViews;
  options.background.grazingAngle = this->GrazingAngle;
  options.background.views = this->RefutingViews;
  options.trim.longestEdge = this->LongestEdge;
  options.trim.greatestDepth = this->GreatestDepthRatio;
  return options;
}

int vtkDelaunayDisparityFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputVector);
  try
  {
    const auto input = freespace::ViewsOf(inputVector[0]);
    std::vector<freespace::View> views =
      freespace::ViewsFromBlocks(freespace::WithoutSilhouettes(input));
    std::vector<vtkSmartPointer<vtkPolyData>> blocks(views.size());
    std::vector<std::string> names;
    for (const freespace::View& view : views)
    {
      names.push_back(view.name);
    }
    freespace::MakeDisparityMaps(std::move(views), this->Options(),
      { freespace::SMPParallelFor, this->Shared }, freespace::AlgorithmProgress(this),
      [&blocks](std::size_t i, const freespace::DisparityMap& map)
      { blocks[i] = freespace::BlockFromMap(map); });
    for (std::size_t i = 0; i < blocks.size(); ++i)
    {
      freespace::SetNamedBlock(output, static_cast<unsigned int>(i), names[i], blocks[i]);
    }
    freespace::AppendSilhouettes(input, output);
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
  os << indent << "FeatureSpacing: " << this->FeatureSpacing << "\n";
  os << indent << "MinimumDisparity: " << this->MinimumDisparity << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "KeepEdges: " << this->KeepEdges << "\n";
  os << indent << "SpatialFlips: " << this->SpatialFlips << "\n";
  os << indent << "PartnerViews: " << this->PartnerViews << "\n";
  os << indent << "ContinueBackground: " << this->ContinueBackground << "\n";
  os << indent << "BackgroundViews: " << this->BackgroundViews << "\n";
  os << indent << "GrazingAngle: " << this->GrazingAngle << "\n";
  os << indent << "RefutingViews: " << this->RefutingViews << "\n";
  os << indent << "LongestEdge: " << this->LongestEdge << "\n";
  os << indent << "GreatestDepthRatio: " << this->GreatestDepthRatio << "\n";
}
