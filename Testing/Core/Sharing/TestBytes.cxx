// SPDX-License-Identifier: BSD-3-Clause
#include "Sharing/Bytes.h"

#include "Common/Error.h"
#include "Sharing/ViewBytes.h"

#include <gtest/gtest.h>

#include <string>

using namespace freespace;

TEST(Bytes, GiveBackAView)
{
  EdgeView view;
  view.name = "name";
  view.imageFile = "";
  view.camera.width = 7;
  view.camera.t = { 1, 2, 3 };
  view.points = { { 1, 2, 3 }, { 4, 5, 6 } };
  view.chains = { {}, { 1, 0 } };
  view.tokens = 9;
  const std::string bytes = BytesOf(view);
  EdgeView copy = FromBytes<EdgeView>(bytes);
  EXPECT_EQ(copy.name, "name");
  EXPECT_EQ(copy.camera.t, view.camera.t);
  EXPECT_EQ(copy.points, view.points);
  EXPECT_EQ(copy.chains, view.chains);
  EXPECT_EQ(copy.tokens, 9u);
  EXPECT_EQ(BytesOf(copy), bytes);
  for (std::size_t size = 0; size < bytes.size(); ++size)
  {
    EXPECT_THROW(FromBytes<EdgeView>(bytes.substr(0, size)), Error);
  }
}
