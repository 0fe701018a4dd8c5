// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ColmapImage_h
#define freespace_ColmapImage_h

#include "SparseModel/ColmapModel.h"
#include "SparseModel/SparseModel.h"
#include "Support/TemporaryFolder.h"

#include <string>

namespace freespace
{

/// The image of a COLMAP model of one, whose camera is a line of cameras.txt without its number.
inline CalibratedImage ImageWithCamera(const std::string& camera)
{
  TemporaryFolder folder;
  folder.Write("cameras.txt", "1 " + camera + "\n");
  folder.Write("images.txt", "1 2 0 0 0 1 2 3 1 a.jpg\n\n"); // a quaternion that is not normalized
  return CalibratedImages(ReadColmapModel(folder.Path())).at(0);
}

}

#endif
