// SPDX-License-Identifier: BSD-3-Clause
#include "Stages/StereoStage.h"

#include "Common/Error.h"
#include "Data/SilhouetteBlocks.h"
#include "Session/NumberValidators.h"
#include "Session/Session.h"

#include <vtkClusterProposal.h>
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
      "Use every image of a cluster as a view (on), which observes more and takes up to three "
      "times as long, or only its reference (off); auto: on for up to 15 images in all")
    ->check(CLI::IsMember({ "auto", "on", "off" }))
    ->expected(0, 1)
    ->default_str("auto")
    ->group("Stereo");
  command
    .add_option("--refine-cameras", this->RefineCameras,
      "Refine the camera poses by the edges of the images: on, off, or auto, which is on in scenes "
      "of up to 200 images; accurate poses are unchanged")
    ->check(CLI::IsMember({ "auto", "on", "off" }))
    ->expected(0, 1)
    ->default_str("auto")
    ->group("Stereo");
  this->WrongImages.AddTo(command, "Stereo");
  this->Thresholds.AddTo(command, "Stereo");
  command
    .add_flag("--no-patches", this->NoPatches,
      "Features are edges alone, as in the paper: no patches of the images where edges leave gaps")
    ->group("Stereo");
  command
    .add_flag("--mask-is-free", this->MaskIsFree,
      "The rays through what the masks of a scene leave out are free space: the surface lies "
      "within the silhouettes, "
      "as for a turntable")
    ->group("Stereo");
  this->Choice.AddOptions(command, "Stereo");
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
  this->Thresholds.SetUp(stereo);
  stereo->SetPatches(!this->NoPatches);
  using Reader = vtkEdgeStereoReader;
  stereo->SetEveryImage(this->EveryImage == "auto" ? Reader::IN_SMALL_SCENES
      : this->EveryImage == "off"                  ? Reader::NEVER
                                                   : Reader::ALWAYS);
  stereo->SetRefineCameras(this->RefineCameras == "auto" ? Reader::REFINE_SMALL_SCENES
      : this->RefineCameras == "off"                     ? Reader::REFINE_NEVER
                                                         : Reader::REFINE_ALWAYS);
  stereo->SetMaskIsFree(this->MaskIsFree);
  stereo->SetCheckImages(this->WrongImages.AreDropped());
  vtkNew<vtkClusterProposal> clusters;
  this->Choice.Apply(clusters);
  stereo->SetClusterProposal(clusters);
  stereo->SetSharedWork(session.Shared());
  session.Run(stereo, "stereo");
  if (!stereo->GetImageSummary().empty())
  {
    session.LogChoice("images", stereo->GetImageSummary());
  }
  if (!stereo->GetClusterSummary().empty())
  {
    session.LogChoice("clusters", stereo->GetClusterSummary(), "--coverage");
  }
  session.LogChoice("cameras", stereo->GetCameraSummary(), "--refine-cameras");
  session.LogChoice("views", stereo->GetViewSummary(), "--every-image");
  vtkSmartPointer<vtkMultiBlockDataSet> features = stereo->GetOutput();
  const auto views = WithoutSilhouettes(features);
  session.Log("stereo: " + std::to_string(views->GetNumberOfBlocks()) + " views, " +
    std::to_string(views->GetNumberOfPoints()) + " features");
  if (this->MaskIsFree)
  {
    session.Log("masks: " + std::to_string(NumberOfSilhouettes(features)) +
      " silhouettes outside of which is free space");
  }
  return features;
}

}
