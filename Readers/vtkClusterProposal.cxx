// SPDX-License-Identifier: BSD-3-Clause
#include "vtkClusterProposal.h"

#include "Common/Error.h"
#include "ClusterOptions.h"
#include "Scene/SceneClusters.h"

#include <vtkObjectFactory.h>

#include <filesystem>

vtkStandardNewMacro(vtkClusterProposal);

namespace freespace
{

ClusterProposalOptions ClusterOptionsOf(vtkClusterProposal* proposal)
{
  ClusterProposalOptions options;
  options.preferredAngle = proposal->GetPreferredAngle();
  options.minimumAngle = proposal->GetMinimumAngle();
  options.maximumAngle = proposal->GetMaximumAngle();
  options.minimumOverlap = proposal->GetMinimumOverlap();
  options.neighbors = proposal->GetNeighbors();
  options.separation = proposal->GetSeparation();
  options.coverage = proposal->GetCoverage();
  return options;
}

}

struct vtkClusterProposal::Result
{
  freespace::Scene scene;
  std::string text;
  std::string summary;
};

vtkClusterProposal::vtkClusterProposal()
  : Chosen(std::make_unique<Result>())
{
  const freespace::ClusterProposalOptions defaults;
  this->PreferredAngle = defaults.preferredAngle;
  this->MinimumAngle = defaults.minimumAngle;
  this->MaximumAngle = defaults.maximumAngle;
  this->MinimumOverlap = defaults.minimumOverlap;
  this->Neighbors = defaults.neighbors;
  this->Separation = defaults.separation;
  this->Coverage = defaults.coverage;
}

vtkClusterProposal::~vtkClusterProposal() = default;

int vtkClusterProposal::Propose()
{
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
    const freespace::ClusterProposal proposal =
      freespace::ProposeClusters(model, freespace::ClusterOptionsOf(this));
    if (proposal.Empty())
    {
      throw freespace::Error("No clusters for " + scene.ModelFolder() +
        ": no image has two neighbours at angles from " + std::to_string(this->MinimumAngle) +
        " to " + std::to_string(this->MaximumAngle) + " degrees that see the same.");
    }
    scene.clusters = freespace::ClustersFromProposal(model, proposal.clusters);
    this->Chosen->scene = std::move(scene);
    this->Chosen->text = freespace::DescribeClusters(model, proposal.clusters);
    this->Chosen->summary = freespace::DescribeChoice(model, proposal);
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

std::string vtkClusterProposal::GetSummary()
{
  return this->Chosen->summary;
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
        "Cannot write " + fileName + ": the folder of the images was not given.");
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
  os << indent << "Neighbors: " << this->Neighbors << "\n";
  os << indent << "Separation: " << this->Separation << "\n";
  os << indent << "Coverage: " << this->Coverage << "\n";
  os << indent << "NumberOfClusters: " << this->GetNumberOfClusters() << "\n";
}
