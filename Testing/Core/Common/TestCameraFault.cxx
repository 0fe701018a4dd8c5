// SPDX-License-Identifier: BSD-3-Clause
#include "Common/CameraFault.h"

#include "Support/RandomMaps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace freespace;
using Eigen::Vector3d;

namespace
{

std::string FaultAfter(const std::function<void(Camera&)>& change)
{
  Camera camera = LookingAt(Vector3d(1, 2, 3), Vector3d(0, 0, 1));
  change(camera);
  return CameraFault(camera);
}

}

TEST(CameraFault, AGoodCameraHasNone)
{
  EXPECT_EQ(FaultAfter([](Camera&) {}), "");
  EXPECT_EQ(FaultAfter([](Camera& camera) { camera.K(0, 1) = 0.3; }), "") << "skew";
  EXPECT_EQ(FaultAfter([](Camera& camera) { camera.R *= 1 + 1e-6; }), "") << "of a text file";
}

TEST(CameraFault, NamesWhatIsWrong)
{
  EXPECT_EQ(FaultAfter([](Camera& camera) { camera.t.x() = std::nan(""); }),
    "has a camera that is not finite");
  EXPECT_EQ(FaultAfter([](Camera& camera) { camera.K.transposeInPlace(); }),
    "has intrinsics that are not upper triangular with a last row of 0 0 1");
  EXPECT_EQ(FaultAfter([](Camera& camera) { camera.K *= 2; }),
    "has intrinsics that are not upper triangular with a last row of 0 0 1");
  EXPECT_EQ(FaultAfter([](Camera& camera) { camera.K(1, 1) *= -1; }),
    "has a focal length that is not positive");
  EXPECT_EQ(FaultAfter([](Camera& camera) { camera.R *= 1.01; }),
    "has a pose that does not begin with a rotation");
  EXPECT_EQ(FaultAfter([](Camera& camera) { camera.R.row(0) *= -1; }),
    "has a pose that does not begin with a rotation");
  EXPECT_EQ(FaultAfter([](Camera& camera) { camera.height = 0; }), "has an image without pixels");
}
