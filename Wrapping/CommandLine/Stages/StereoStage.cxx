// SPDX-License-Identifier: BSD-3-Clause
#include "Stages/StereoStage.h"

#include "Common/Error.h"
#include "Session/NumberValidators.h"
#include "Session/Session.h"

#include <vtkEdgeStereoReader.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>

#include <sstream>

namespace freespace
{

void StereoStage::AddOptions(CLI::App& command)
{
  command
    .add_option("--min-depth", this->MinimumDepth, "Nearest depth to search; 0: from the cameras")
    ->check(NonNegative())
    ->capture_default_str()
    ->group("Stereo");
  command
    .add_option("--max-depth", this->MaximumDepth, "Farthest depth to search; 0: from the cameras")
    ->check(NonNegative())
    ->capture_default_str()
    ->group("Stereo");
  command
    .add_option("--every-image", this->EveryImage,
      "Every image of a cluster is a view (on), which sees more and takes about eight times as "
      "long, "
      "or its middle one alone (off); auto is off but in small scenes that name no clusters")
    ->check(CLI::IsMember({ "auto", "on", "off" }))
    ->expected(0, 1)
    ->default_str("auto")
    ->group("Stereo");
}

vtkSmartPointer<vtkMultiBlockDataSet> StereoStage::Run(
  Session& session, const std::string& scene) const
{
  if (this->MaximumDepth > 0 && this->MinimumDepth >= this->MaximumDepth)
  {
    std::ostringstream fault;
    fault << "The nearest depth, --min-depth " << this->MinimumDepth
          << ", must be less than the farthest, --max-depth " << this->MaximumDepth << ".";
    throw Error(fault.str());
  }
  vtkNew<vtkEdgeStereoReader> stereo;
  stereo->SetFileName(scene);
  stereo->SetMinimumDepth(this->MinimumDepth);
  stereo->SetMaximumDepth(this->MaximumDepth);
  using Reader = vtkEdgeStereoReader;
  stereo->SetEveryImage(this->EveryImage == "auto" ? Reader::WHERE_NONE_WAS_CHOSEN
      : this->EveryImage == "off"                  ? Reader::NEVER
                                                   : Reader::ALWAYS);
  session.Run(stereo, "stereo");
  vtkSmartPointer<vtkMultiBlockDataSet> features = stereo->GetOutput();
  session.Log("stereo: " + std::to_string(features->GetNumberOfBlocks()) + " views, " +
    std::to_string(features->GetNumberOfPoints()) + " features");
  return features;
}

}
