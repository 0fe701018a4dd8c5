// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_UnionChange_h
#define freespace_UnionChange_h

#include "Contour/Lattice/FieldChange.h"
#include "Freespace/FreespaceUnion.h"

#include <memory>

namespace freespace
{

/// How a union differs from an earlier one: the views, shared by both or not, and the planes of the hull. A view that
/// came or went leaves what is outside of its image, and what is farther behind its surface than it contradicts.
class UnionChange : public FieldChange
{
public:
  UnionChange(
    std::shared_ptr<const FreespaceUnion> before, std::shared_ptr<const FreespaceUnion> now);

  ChangeScope Root() const override { return this->All; }
  bool Leaves(
    const Eigen::AlignedBox3d& box, const ChangeScope& parent, ChangeScope& scope) const override;
  int ViewNow(int before) const override
  {
    return before < 0 ? before : this->Now[static_cast<std::size_t>(before)];
  }

private:
  struct ChangedView
  {
    const ViewFreespace* view;
    double margin;
  };

  bool AreSame(int before, int now) const;
  void MatchViews();
  void MatchPlanes();

  std::shared_ptr<const FreespaceUnion> Before, After;
  std::vector<int> Now;             ///< of the earlier views: their indices; -1: gone
  std::vector<ChangedView> Changed; ///< that only one of the unions has
  ChangeScope All;
};

}

#endif
