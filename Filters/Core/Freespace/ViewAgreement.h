// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ViewAgreement_h
#define freespace_ViewAgreement_h

#include "Common/ParallelFor.h"
#include "Common/Progress.h"
#include "Freespace/RegionOfInterest.h"
#include "ViewFreespace/ViewFreespace.h"

#include <memory>
#include <vector>

namespace freespace
{

/// The error rate of the union close to features, for a number of views that must agree.
struct AgreementErrors
{
  double eroded = 0;  ///< share of places a little behind a feature that would be free
  double blocked = 0; ///< share of places a little before one that would be matter
  double Sum() const { return this->eroded + this->blocked; }
};

/// The errors for 1 to `most` views. `features` and `views` are of the same maps, in the same order; features in
/// the box count, some thousands of them, evenly chosen. A little is what a feature covers of the surface, see
/// CellSide: `spacings` times the distance of its view's features there.
std::vector<AgreementErrors> ErrorsOfAgreement(
  const std::vector<std::unique_ptr<ViewFreespace>>& views,
  const std::vector<ViewFeatures>& features, const Eigen::AlignedBox3d& box, double spacings,
  int most, const ParallelFor& parallelFor = SerialFor, const Progress& progress = {});

/// The number of views, 1 or 2, that has the fewest errors: 1 (the paper's) where each view is right, 2 where
/// they are many and some carve what others saw. 2, too, where a second view is found for nearly every place, in 999
/// of 1000: between the features of a structure-from-motion model, which no view contradicts, a view alone is wrong
/// more often than at them.
int ViewsThatMustAgree(const std::vector<AgreementErrors>& errors);

}

#endif
