// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_FeatureCloud_h
#define freespace_FeatureCloud_h

#include "Common/CancellationFlag.h"
#include "Common/View.h"

#include <array>

namespace freespace
{

/// The distinct features of many views, in boxes of points of one view that are near to each other, so that what a
/// camera cannot see is passed over by the box. Views that come from structure from motion share their
/// points: with a thousand views every point would otherwise be processed a thousand times for each view.
class FeatureCloud
{
public:
  struct Feature
  {
    Eigen::Vector3d point;
    int sourceView; ///< the first view that has it
  };

  /// Takes the finite features of all views. O(n log n). Throws Aborted soon after the flag is set.
  explicit FeatureCloud(
    const std::vector<View>& views, const CancellationFlag& stop = NeverCancelled);

  std::size_t Size() const { return this->Features.size(); }

  /// Calls visit(feature) for all features that project into the camera's image and for some others. The
  /// order is the same in every run.
  template <typename Visitor>
  void VisitSeen(const Camera& camera, Visitor&& visit) const
  {
    this->VisitBoxes(Frustum(camera), 0, this->Boxes.size(), visit);
  }

  /// The same for the features of some views alone, and those that several views share.
  template <typename Visitor>
  void VisitSeen(const Camera& camera, const std::vector<int>& views, Visitor&& visit) const
  {
    const Frustum frustum(camera);
    for (const int view : views)
    {
      const std::size_t v = static_cast<std::size_t>(view);
      this->VisitBoxes(frustum, this->FirstBox[v], this->FirstBox[v + 1], visit);
    }
    this->VisitBoxes(frustum, this->FirstBox.back(), this->Boxes.size(), visit);
  }

private:
  struct Box
  {
    Eigen::Vector3d center;
    Eigen::Vector3d half;
    std::size_t begin; // in Features
    std::size_t end;
  };

  // The half spaces in which all that a camera sees must lie.
  class Frustum
  {
  public:
    explicit Frustum(const Camera& camera);
    bool MayContain(const Box& box) const;

  private:
    std::array<Eigen::Vector4d, 5> Planes; // inside where the product is positive
  };

  template <typename Visitor>
  void VisitBoxes(
    const Frustum& frustum, std::size_t first, std::size_t last, Visitor&& visit) const
  {
    for (std::size_t b = first; b < last; ++b)
    {
      const Box& box = this->Boxes[b];
      if (frustum.MayContain(box))
      {
        for (std::size_t i = box.begin; i < box.end; ++i)
        {
          visit(this->Features[i]);
        }
      }
    }
  }

  std::size_t TakeDistinct(const std::vector<View>& views, const CancellationFlag& stop);
  void Split(std::size_t begin, std::size_t end, const CancellationFlag& stop);

  std::vector<Feature> Features;     // by view; those that several views share last
  std::vector<Box> Boxes;            // in the order of their features
  std::vector<std::size_t> FirstBox; // of each view, then of what several views share
};

}

#endif
