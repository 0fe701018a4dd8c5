// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMergeViewsFilter.h"

#include "Execution/AlgorithmErrors.h"
#include "Common/Error.h"
#include "Data/SilhouetteBlocks.h"
#include "Data/ViewBlocks.h"
#include "Data/ViewInput.h"

#include <vtkAppendPolyData.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <map>
#include <vector>

vtkStandardNewMacro(vtkMergeViewsFilter);

namespace
{

// The blocks that make one view of the output.
struct Parts
{
  std::string name;
  freespace::Camera camera;
  std::vector<vtkPolyData*> blocks;
};

// Of one source or written and read again: the same up to rounding.
bool IsSame(const freespace::Camera& a, const freespace::Camera& b)
{
  return a.width == b.width && a.height == b.height && a.K.isApprox(b.K, 1e-9) &&
    a.R.isApprox(b.R, 1e-9) && (a.t - b.t).norm() <= 1e-9 * (a.t.norm() + b.t.norm());
}

void AddView(vtkPolyData* block, const freespace::View& view, std::vector<Parts>& views,
  std::multimap<std::string, std::size_t>& ofImage)
{
  const auto [begin, end] = ofImage.equal_range(view.imageFile);
  for (auto found = begin; found != end && !view.imageFile.empty(); ++found)
  {
    if (IsSame(views[found->second].camera, view.camera))
    {
      views[found->second].blocks.push_back(block);
      return;
    }
  }
  ofImage.emplace(view.imageFile, views.size());
  views.push_back({ view.name, view.camera, { block } });
}

vtkSmartPointer<vtkPolyData> Merge(const Parts& parts)
{
  vtkNew<vtkAppendPolyData> append;
  append->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  const bool haveDeviations = std::any_of(parts.blocks.begin(), parts.blocks.end(),
    [](vtkPolyData* block) { return block->GetPointData()->HasArray("DisparityDeviation"); });
  for (vtkPolyData* block : parts.blocks)
  {
    vtkNew<vtkPolyData> withoutCellData; // which the parts seldom share
    withoutCellData->ShallowCopy(block);
    withoutCellData->GetCellData()->Initialize();
    if (haveDeviations && !block->GetPointData()->HasArray("DisparityDeviation"))
    {
      vtkNew<vtkDoubleArray> unknown; // only arrays that all parts have are appended
      unknown->SetName("DisparityDeviation");
      unknown->SetNumberOfTuples(block->GetNumberOfPoints());
      unknown->Fill(0);
      withoutCellData->GetPointData()->AddArray(unknown);
    }
    append->AddInputData(withoutCellData);
  }
  append->Update();
  vtkSmartPointer<vtkPolyData> merged = append->GetOutput();
  merged->GetFieldData()->ShallowCopy(parts.blocks.front()->GetFieldData());
  return merged;
}

}

int vtkMergeViewsFilter::FillInputPortInformation(int, vtkInformation* info)
{
  freespace::AcceptViews(info);
  info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  return 1;
}

int vtkMergeViewsFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputVector);
  try
  {
    std::vector<Parts> views;
    std::multimap<std::string, std::size_t> ofImage;
    for (int i = 0; i < inputVector[0]->GetNumberOfInformationObjects(); ++i)
    {
      const auto input = freespace::WithoutSilhouettes(freespace::ViewsOf(inputVector[0], i));
      const std::vector<freespace::View> own = freespace::ViewsFromBlocks(input);
      for (unsigned int k = 0; k < input->GetNumberOfBlocks(); ++k)
      {
        AddView(vtkPolyData::SafeDownCast(input->GetBlock(k)), own[k], views, ofImage);
      }
    }
    for (std::size_t i = 0; i < views.size(); ++i)
    {
      freespace::SetNamedBlock(output, static_cast<unsigned int>(i), views[i].name,
        views[i].blocks.size() == 1 ? vtkSmartPointer<vtkPolyData>(views[i].blocks.front())
                                    : Merge(views[i]));
    }
    for (int i = 0; i < inputVector[0]->GetNumberOfInformationObjects(); ++i)
    {
      freespace::AppendSilhouettes(freespace::ViewsOf(inputVector[0], i), output);
    }
  }
  catch (...)
  {
    return freespace::AfterException(this);
  }
  return 1;
}

void vtkMergeViewsFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfInputs: " << this->GetNumberOfInputConnections(0) << "\n";
}
