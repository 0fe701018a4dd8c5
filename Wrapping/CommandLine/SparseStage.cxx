// SPDX-License-Identifier: BSD-3-Clause
#include "SparseStage.h"

#include "Session.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkSparseModelReader.h>

namespace freespace
{

void SparseStage::AddOptions(CLI::App& command)
{
  command.add_option("--min-track", this->MinimumTrackLength, "Images that must see a point")
    ->check(CLI::PositiveNumber)
    ->capture_default_str()
    ->group("Structure-from-motion model");
  command.add_option("--max-error", this->MaximumError, "Largest reprojection error, pixels")
    ->check(CLI::PositiveNumber)
    ->capture_default_str()
    ->group("Structure-from-motion model");
  command
    .add_option("--min-angle", this->MinimumAngle,
      "The widest angle between two rays to a point must be so large, degrees")
    ->check(CLI::NonNegativeNumber)
    ->capture_default_str()
    ->group("Structure-from-motion model");
}

vtkSmartPointer<vtkMultiBlockDataSet> SparseStage::Run(
  Session& session, const std::string& model) const
{
  vtkNew<vtkSparseModelReader> reader;
  reader->SetFileName(model);
  reader->SetMinimumTrackLength(this->MinimumTrackLength);
  reader->SetMaximumError(this->MaximumError);
  reader->SetMinimumAngle(this->MinimumAngle);
  session.Run(reader, "sparse");
  vtkSmartPointer<vtkMultiBlockDataSet> features = reader->GetOutput();
  session.Tell("sparse: " + std::to_string(features->GetNumberOfBlocks()) + " views, " +
    std::to_string(features->GetNumberOfPoints()) + " features");
  return features;
}

}
