// SPDX-License-Identifier: BSD-3-Clause
#include "Stages/DensifyStage.h"

#include "Common/Error.h"
#include "Data/ViewBlocks.h"
#include "Files/WorkFolder.h"
#include "Scene/Scene.h"
#include "Session/Session.h"
#include "Stages/StereoStage.h"

#include <vtkCameraReader.h>
#include <vtkClusterProposal.h>
#include <vtkMergeViewsFilter.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>

#include <filesystem>

namespace freespace
{

namespace
{

// A folder for the scene.json between the choice of clusters and the stereo.
class ScratchFolder
{
public:
  ScratchFolder()
    : Folder(std::filesystem::temp_directory_path())
  {
    if (this->Folder.Path().empty())
    {
      throw Error("Cannot write to " + std::filesystem::temp_directory_path().string() + ".");
    }
  }

  std::string Scene() const { return (this->Folder.Path() / "scene.json").string(); }

private:
  WorkFolder Folder;
};

// Whether any of the model's image files exists.
bool HasPhotographs(Session& session, const std::string& model, const std::string& images)
{
  vtkNew<vtkCameraReader> cameras;
  cameras->SetFileName(model);
  session.Run(cameras, "cameras");
  vtkMultiBlockDataSet* views = cameras->GetOutput();
  for (unsigned int i = 0; i < views->GetNumberOfBlocks(); ++i)
  {
    if (std::filesystem::is_regular_file(std::filesystem::path(images) / BlockName(views, i)))
    {
      return true;
    }
  }
  return false;
}

}

void DensifyStage::AddOptions(CLI::App& command)
{
  command
    .add_option("--densify", this->Images,
      "The folder of the model's images: add what edge stereo finds in them")
    ->check(CLI::ExistingDirectory)
    ->type_name("IMAGES")
    ->group("Structure-from-motion model");
}

vtkSmartPointer<vtkMultiBlockDataSet> DensifyStage::Run(Session& session, const std::string& model,
  vtkMultiBlockDataSet* sparse, const StereoStage& stereo) const
{
  if (!HasPhotographs(session, model, this->Images))
  {
    throw Error(
      "Cannot densify: the folder " + this->Images + " has none of the images of " + model + ".");
  }
  const ScratchFolder scratch;
  vtkNew<vtkClusterProposal> proposal;
  proposal->SetModel(model);
  proposal->SetImages(this->Images);
  stereo.Clusters().Apply(proposal);
  proposal->Propose();
  try
  {
    session.ThrowIfFailed();
  }
  catch (const Error& error)
  {
    // The model and the folder have been read before: its images cannot be used.
    session.Warn(std::string("Nothing is added by --densify. ") + error.what());
    return sparse;
  }
  // Without the clusters: the stereo proposes them when it knows which images are right.
  Scene scene;
  scene.images = std::filesystem::absolute(this->Images).string();
  scene.model = std::filesystem::absolute(model).string();
  WriteScene(scene, scratch.Scene());
  const auto edges = stereo.Run(session, scratch.Scene());
  vtkNew<vtkMergeViewsFilter> merge;
  merge->AddInputDataObject(sparse);
  merge->AddInputDataObject(edges);
  session.Run(merge, "merge");
  vtkSmartPointer<vtkMultiBlockDataSet> features = merge->GetOutput();
  session.Log("densify: " + std::to_string(features->GetNumberOfBlocks()) + " views, " +
    std::to_string(features->GetNumberOfPoints()) + " features");
  return features;
}

}
