// SPDX-License-Identifier: BSD-3-Clause
#include "Stages/SparseStage.h"

#include "ModelFiles/ReadSparseModel.h"
#include "Session/NumberValidators.h"
#include "Session/Session.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkOutlierFilter.h>
#include <vtkSparseModelReader.h>

namespace freespace
{

void SparseStage::AddOptions(CLI::App& command)
{
  command.add_option("--min-track", this->MinimumTrackLength, "Images that must see a point")
    ->check(Positive())
    ->capture_default_str()
    ->group("Structure-from-motion model");
  command.add_option("--max-error", this->MaximumError, "Largest reprojection error, pixels")
    ->check(Positive())
    ->capture_default_str()
    ->group("Structure-from-motion model");
  command
    .add_option("--min-angle", this->MinimumAngle,
      "Minimum of the largest angle between two rays to a point, degrees; the half of the points "
      "with the larger angles is always kept")
    ->check(NonNegative())
    ->capture_default_str()
    ->group("Structure-from-motion model");
  this->Support.AddTo(command, "Structure-from-motion model");
  this->WrongImages.AddTo(command, "Structure-from-motion model");
}

vtkSmartPointer<vtkMultiBlockDataSet> SparseStage::Run(
  Session& session, const std::string& model) const
{
  if (const std::string told = FindModel(model).told; !told.empty())
  {
    session.Log("sparse: " + told);
  }
  vtkNew<vtkSparseModelReader> reader;
  reader->SetFileName(model);
  reader->SetCheckImages(this->WrongImages.AreDropped());
  reader->SetMinimumTrackLength(this->MinimumTrackLength);
  reader->SetMaximumError(this->MaximumError);
  reader->SetMinimumAngle(this->MinimumAngle);
  session.Run(reader, "sparse");
  vtkNew<vtkOutlierFilter> outliers;
  outliers->SetInputConnection(reader->GetOutputPort());
  outliers->SetSupport(this->Support.Support());
  outliers->SetSharingViews(this->Support.SharingViews());
  outliers->SetSupportRadius(2);
  session.Run(outliers, "outliers");
  vtkSmartPointer<vtkMultiBlockDataSet> features = outliers->GetOutput();
  session.Log("sparse: " + std::to_string(features->GetNumberOfBlocks()) + " views, " +
    std::to_string(features->GetNumberOfPoints()) + " features");
  return features;
}

}
