// SPDX-License-Identifier: BSD-3-Clause
#include "Stages/ClusterChoice.h"

#include "Session/NumberValidators.h"

#include <vtkClusterProposal.h>

namespace freespace
{

void ClusterChoice::AddOptions(CLI::App& command, const std::string& group)
{
  const auto add = [&](const char* name, auto& value, const char* help)
  { return command.add_option(name, value, help)->capture_default_str()->group(group); };
  add("--angle", this->Options.preferredAngle,
    "Where no clusters are named: the best angle between a reference and its neighbours, degrees")
    ->check(Positive());
  add("--largest-angle", this->Options.maximumAngle,
    "Greatest angle between a reference and a neighbour, degrees")
    ->check(Positive());
  add("--overlap", this->Options.minimumOverlap,
    "Least part of the reference's picture that a neighbour must see")
    ->check(CLI::Range(0.0, 1.0));
  add("--partners", this->Options.neighbors,
    "With how many neighbours a reference is matched at most: 4, or 2, which is faster")
    ->check(CLI::IsMember({ 2, 4 }));
  add("--separation", this->Options.separation,
    "Of references nearer than this keep one, degrees; 0 keeps all")
    ->check(NonNegative());
  add("--coverage", this->Options.coverage,
    "In sets of more than two dozen images, leave out one that so many references cover; 0: none")
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
