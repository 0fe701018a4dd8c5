// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_FieldChange_h
#define freespace_FieldChange_h

#include <Eigen/Geometry>

#include <vector>

namespace freespace
{

/// The parts of a change that may reach a box, so that nothing below the box asks the others again. Only the change
/// that wrote it can read it.
struct ChangeScope
{
  std::vector<int> views; ///< that came or went, and are not of no opinion in the box
  std::vector<int> planesBefore, planesNow; ///< of the hull, that the box is not wholly inside of
  bool isEverything = false;                ///< nothing in the box can be taken over
};

/// How a field differs from what it was when it was contoured before. Safe to ask from several threads.
class FieldChange
{
public:
  virtual ~FieldChange() = default;

  /// The scope of all space.
  virtual ChangeScope Root() const = 0;

  /// Whether all in a box, which lies in that of the parent, is as before: Classify gives the same scopes to the boxes
  /// in it, but for the numbers of the views, and so whatever is asked with these is answered the same. Otherwise the
  /// scope of the box.
  virtual bool Leaves(
    const Eigen::AlignedBox3d& box, const ChangeScope& parent, ChangeScope& scope) const = 0;

  /// The number that a view has now of which a label was, where the change leaves the surface.
  virtual int ViewNow(int before) const = 0;
};

}

#endif
