// SPDX-License-Identifier: BSD-3-Clause
#include "Options/ClusterChoice.h"

#include "Session/NumberValidators.h"

#include <vtkClusterProposal.h>

namespace freespace
{

void ClusterChoice::AddOptions(CLI::App& command, const std::string& group)
{
  const auto add = [&](const char* name, auto& value, const char* help)
  { return command.add_option(name, value, help)->capture_default_str()->group(group); };
  add("--angle", this->Options.preferredAngle,
    "If the scene names no clusters: preferred angle between a reference and its neighbours, "
    "degrees")
    ->check(Positive());
  add("--largest-angle", this->Options.maximumAngle,
    "Maximum angle between a reference and a neighbour, degrees")
    ->check(Positive());
  add("--overlap", this->Options.minimumOverlap,
    "Minimum fraction of the reference image that a neighbour must see")
    ->check(Between(0.0, 1.0));
  add("--partners", this->Options.neighbors,
    "Maximum number of neighbours that a reference is matched with: 4, or 2, which is faster")
    ->check(CLI::IsMember({ 2, 4 }));
  add("--separation", this->Options.separation,
    "Minimum angle between references, degrees; 0 keeps all")
    ->check(NonNegative());
  add("--coverage", this->Options.coverage,
    "In sets of more than 24 images, drop a reference that this number of others cover; 0: none")
    ->check(CLI::Range(0, 1000));
}

void ClusterChoice::Apply(vtkClusterProposal* proposal) const
{
  proposal->SetPreferredAngle(this->Options.preferredAngle);
  proposal->SetMaximumAngle(this->Options.maximumAngle);
  proposal->SetMinimumOverlap(this->Options.minimumOverlap);
  proposal->SetNeighbors(this->Options.neighbors);
  proposal->SetSeparation(this->Options.separation);
  proposal->SetCoverage(this->Options.coverage);
}

}
