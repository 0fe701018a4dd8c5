// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_PartnerViews_h
#define freespace_PartnerViews_h

#include "Common/DisparityMap.h"

#include <vector>

namespace freespace
{

/// With how many others a view is compared.
struct PartnerViewsOptions
{
  int most = 0; ///< >= 0; 0 is no limit

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// For each view, the others that it is compared with, ascending: all, or where there are more than `most`, half
/// of these are the next ones and the others are spread over the rest, ever wider. Near are views whose cameras
/// are near and that look at the same place. The next ones see the same features; those from aside see
/// what is behind an edge.
///
/// Points that are not finite count nothing. Time: that of sorting the views for each of them, far less than
/// their comparison.
template <typename AnyView>
std::vector<std::vector<int>> PartnerViews(
  const std::vector<AnyView>& views, const PartnerViewsOptions& options);

extern template std::vector<std::vector<int>> PartnerViews(
  const std::vector<View>& views, const PartnerViewsOptions& options);
extern template std::vector<std::vector<int>> PartnerViews(
  const std::vector<DisparityMap>& views, const PartnerViewsOptions& options);

}

#endif
