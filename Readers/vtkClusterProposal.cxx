// SPDX-License-Identifier: BSD-3-Clause
#include "vtkClusterProposal.h"

#include "Common/Error.h"
#include "Scene/ProposeClusters.h"

#include <vtkObjectFactory.h>

#include <filesystem>

vtkStandardNewMacro(vtkClusterProposal);

struct vtkClusterProposal::Result
{
  freespace::Scene scene;
  std::string text;
};

vtkClusterProposal::vtkClusterProposal()
  : Chosen(std::make_unique<Result>())
{
}

vtkClusterProposal::~vtkClusterProposal() = default;

int vtkClusterProposal::Propose()
{
  freespace::ClusterProposalOptions options;
  options.preferredAngle = this->PreferredAngle;
  options.minimumAngle = this->MinimumAngle;
  options.maximumAngle = this->MaximumAngle;
  options.minimumOverlap = this->MinimumOverlap;
  options.separation = this->Separation;
  *this->Chosen = {};
  try
  {
    freespace::Scene scene;
    if (this->FileName.empty())
    {
      scene.model = std::filesystem::absolute(this->Model).string();
      scene.images = this->Images.empty() ? "" : std::filesystem::absolute(this->Images).string();
    }
    else
    {
      scene = freespace::ReadScene(this->FileName);
    }
    scene.clusters.clear();
    const freespace::SparseModel model =
      freespace::WithExistingPhotographs(scene, freespace::ReadSceneModel(scene));
    const auto proposal = freespace::ProposeClusters(model, options);
    if (proposal.empty())
    {
      throw freespace::Error("No clusters for " + scene.ModelFolder() +
        ": no photograph has neighbours on opposite sides at angles from " +
        std::to_string(this->MinimumAngle) + " to " + std::to_string(this->MaximumAngle) +
        " degrees that see the same.");
    }
    scene.clusters = freespace::ClustersFromProposal(model, proposal);
    this->Chosen->scene = std::move(scene);
    this->Chosen->text = freespace::DescribeProposal(model, proposal);
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  return 1;
}

int vtkClusterProposal::GetNumberOfClusters()
{
  return static_cast<int>(this->Chosen->scene.clusters.size());
}

std::string vtkClusterProposal::GetReference(int cluster)
{
  const auto& clusters = this->Chosen->scene.clusters;
  return cluster >= 0 && cluster < this->GetNumberOfClusters()
    ? clusters[static_cast<std::size_t>(cluster)].reference
    : std::string();
}

int vtkClusterProposal::GetNumberOfTriplets(int cluster)
{
  const auto& clusters = this->Chosen->scene.clusters;
  return cluster >= 0 && cluster < this->GetNumberOfClusters()
    ? static_cast<int>(clusters[static_cast<std::size_t>(cluster)].triplets.size())
    : 0;
}

std::string vtkClusterProposal::GetText()
{
  return this->Chosen->text;
}

int vtkClusterProposal::WriteScene(const std::string& fileName)
{
  try
  {
    if (this->Chosen->scene.clusters.empty())
    {
      throw freespace::Error("Cannot write " + fileName + ": no clusters were chosen.");
    }
    if (this->Chosen->scene.images.empty())
    {
      throw freespace::Error(
        "Cannot write " + fileName + ": the folder of the photographs was not given.");
    }
    freespace::WriteScene(this->Chosen->scene, fileName);
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  return 1;
}

void vtkClusterProposal::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
  os << indent << "Model: " << this->Model << "\n";
  os << indent << "Images: " << this->Images << "\n";
  os << indent << "PreferredAngle: " << this->PreferredAngle << "\n";
  os << indent << "MinimumAngle: " << this->MinimumAngle << "\n";
  os << indent << "MaximumAngle: " << this->MaximumAngle << "\n";
  os << indent << "MinimumOverlap: " << this->MinimumOverlap << "\n";
  os << indent << "Separation: " << this->Separation << "\n";
  os << indent << "NumberOfClusters: " << this->GetNumberOfClusters() << "\n";
}
