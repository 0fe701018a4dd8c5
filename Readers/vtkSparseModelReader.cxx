// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSparseModelReader.h"

#include "Agreement/ProjectionErrors.h"
#include "Agreement/RemainingImages.h"
#include "Common/Error.h"
#include "Execution/AlgorithmErrors.h"
#include "Execution/AlgorithmProgress.h"
#include "Execution/SMPParallelFor.h"
#include "ModelFiles/ReadSparseModel.h"
#include "Blocks/SparseModelBlocks.h"

#include <vtkErrorCode.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkSparseModelReader);

vtkSparseModelReader::vtkSparseModelReader()
{
  this->SetNumberOfInputPorts(0);
  const freespace::SparseViewOptions options;
  this->MinimumTrackLength = options.minimumTrackLength;
  this->MaximumError = options.maximumError;
  this->MinimumAngle = options.minimumAngle;
  this->MinimumFeatures = options.minimumFeatures;
}

bool vtkSparseModelReader::CanReadFile(const std::string& path)
{
  return freespace::IsSparseModel(path);
}

int vtkSparseModelReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputVector);
  freespace::SparseViewOptions options;
  options.minimumTrackLength = this->MinimumTrackLength;
  options.maximumError = this->MaximumError;
  options.minimumAngle = this->MinimumAngle;
  options.minimumFeatures = this->MinimumFeatures;
  this->SetErrorCode(vtkErrorCode::NoError);
  try
  {
    const freespace::Progress progress = freespace::AlgorithmProgress(this);
    options.Check();
    freespace::SparseModel model = freespace::ReadSparseModel(this->FileName);
    if (model.points.empty() && this->MinimumFeatures > 0)
    {
      throw freespace::Error("The camera model " + this->FileName +
        " has no points to be features: make a scene of it, whose features come from its "
        "images (freespace clusters MODEL --images IMAGES -o scene.json).");
    }
    progress(0.5);
    if (this->CheckImages)
    {
      const auto wrong = freespace::FindMisprojectedImages(model);
      if (!wrong.empty())
      {
        vtkWarningMacro(<< freespace::DescribeMisprojected(wrong, model.images.size()));
        model = freespace::WithoutImages(std::move(model), freespace::NamesOf(wrong));
      }
    }
    const std::vector<freespace::SparseView> views =
      freespace::ViewsFromModel(model, options, freespace::SMPParallelFor);
    progress(0.7);
    if (views.empty())
    {
      throw freespace::Error("The camera model " + this->FileName + " has no image with at least " +
        std::to_string(this->MinimumFeatures) + " points that are good enough.");
    }
    freespace::BlocksFromModel(model, views, output);
    progress(1.0);
  }
  catch (...)
  {
    this->SetErrorCode(freespace::ErrorCodeOf(this->FileName));
    return freespace::AfterException(this);
  }
  return 1;
}

void vtkSparseModelReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
  os << indent << "MinimumTrackLength: " << this->MinimumTrackLength << "\n";
  os << indent << "MaximumError: " << this->MaximumError << "\n";
  os << indent << "MinimumAngle: " << this->MinimumAngle << "\n";
  os << indent << "CheckImages: " << this->CheckImages << "\n";
  os << indent << "MinimumFeatures: " << this->MinimumFeatures << "\n";
}
