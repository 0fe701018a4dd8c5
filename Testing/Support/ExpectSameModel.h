// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ExpectSameModel_h
#define freespace_ExpectSameModel_h

#include "SparseModel/SparseModel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace freespace
{

inline void ExpectSameTracks(const SparsePoint& a, const SparsePoint& b)
{
  std::set<std::pair<std::uint32_t, std::uint32_t>> trackA, trackB; // their order means nothing
  for (const SparseTrackElement& element : a.track)
  {
    trackA.emplace(element.image, element.observation);
  }
  for (const SparseTrackElement& element : b.track)
  {
    trackB.emplace(element.image, element.observation);
  }
  EXPECT_EQ(trackA, trackB) << "point " << a.id;
  EXPECT_EQ(a.track.size(), b.track.size());
}

/// Every number must be the same to the last bit; the order of cameras, images and points means
/// nothing.
inline void ExpectSameModel(SparseModel a, SparseModel b)
{
  const auto byId = [](const auto& p, const auto& q) { return p.id < q.id; };
  for (SparseModel* model : { &a, &b })
  {
    std::sort(model->cameras.begin(), model->cameras.end(), byId);
    std::sort(model->images.begin(), model->images.end(), byId);
    std::sort(model->points.begin(), model->points.end(), byId);
  }
  ASSERT_EQ(a.cameras.size(), b.cameras.size());
  for (std::size_t i = 0; i < a.cameras.size(); ++i)
  {
    EXPECT_EQ(a.cameras[i].id, b.cameras[i].id);
    EXPECT_EQ(a.cameras[i].model, b.cameras[i].model);
    EXPECT_EQ(a.cameras[i].width, b.cameras[i].width);
    EXPECT_EQ(a.cameras[i].height, b.cameras[i].height);
    EXPECT_EQ(a.cameras[i].parameters, b.cameras[i].parameters);
  }
  ASSERT_EQ(a.images.size(), b.images.size());
  for (std::size_t i = 0; i < a.images.size(); ++i)
  {
    EXPECT_EQ(a.images[i].id, b.images[i].id);
    EXPECT_EQ(a.images[i].name, b.images[i].name);
    EXPECT_EQ(a.images[i].camera, b.images[i].camera);
    EXPECT_EQ(a.images[i].rotation, b.images[i].rotation);
    EXPECT_EQ(a.images[i].translation, b.images[i].translation);
    ASSERT_EQ(a.images[i].observations.size(), b.images[i].observations.size());
    for (std::size_t k = 0; k < a.images[i].observations.size(); ++k)
    {
      EXPECT_EQ(a.images[i].observations[k].pixel, b.images[i].observations[k].pixel);
      EXPECT_EQ(a.images[i].observations[k].point, b.images[i].observations[k].point);
    }
  }
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i)
  {
    EXPECT_EQ(a.points[i].id, b.points[i].id);
    EXPECT_EQ(a.points[i].position, b.points[i].position);
    EXPECT_EQ(a.points[i].color, b.points[i].color);
    EXPECT_EQ(a.points[i].error, b.points[i].error);
    ExpectSameTracks(a.points[i], b.points[i]);
  }
}

}

#endif
