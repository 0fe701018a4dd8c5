// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ClusterOptions_h
#define freespace_ClusterOptions_h

#include "Scene/ClusterProposalOptions.h"

class vtkClusterProposal;

namespace freespace
{

/// The parameters of a vtkClusterProposal.
ClusterProposalOptions ClusterOptionsOf(vtkClusterProposal* proposal);

}

#endif
