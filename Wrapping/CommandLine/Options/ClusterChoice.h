// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ClusterChoice_h
#define freespace_ClusterChoice_h

#include "Scene/ClusterProposalOptions.h"

#include <CLI/CLI.hpp>

#include <string>

class vtkClusterProposal;

namespace freespace
{

/// The options of the choice of clusters, for every command that may need it: `clusters`, and those that
/// find features in the images of a scene or model that names none.
class ClusterChoice
{
public:
  void AddOptions(CLI::App& command, const std::string& group);

  /// Sets the proposal's parameters.
  void Apply(vtkClusterProposal* proposal) const;

private:
  ClusterProposalOptions Options;
};

}

#endif
