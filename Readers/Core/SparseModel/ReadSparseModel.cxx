// SPDX-License-Identifier: BSD-3-Clause
#include "SparseModel/ReadSparseModel.h"

#include "Common/Error.h"
#include "SparseModel/BundlerModel.h"
#include "SparseModel/ColmapModel.h"
#include "SparseModel/FindSparseModel.h"
#include "SparseModel/NvmModel.h"

#include <filesystem>

namespace freespace
{

namespace fs = std::filesystem;

namespace
{

bool HasBundlerModel(const fs::path& folder)
{
  return !HasColmapModel(folder.string()) && fs::is_regular_file(folder / "bundle.out");
}

}

bool IsSparseModel(const std::string& path)
{
  const std::string ending = fs::path(path).extension().string();
  return fs::is_directory(path) ? HasColmapModel(FindSparseModel(path)) || HasBundlerModel(path)
                                : ending == ".nvm" || ending == ".out";
}

SparseModel ReadSparseModel(const std::string& path)
{
  if (fs::is_directory(path))
  {
    return HasBundlerModel(path) ? ReadBundlerModel((fs::path(path) / "bundle.out").string())
                                 : ReadColmapModel(FindSparseModel(path));
  }
  if (!fs::exists(path))
  {
    throw Error("Cannot read the camera model " + path + ": there is no such file or folder.");
  }
  const std::string ending = fs::path(path).extension().string();
  if (ending == ".nvm")
  {
    return ReadNvmModel(path);
  }
  if (ending == ".out")
  {
    return ReadBundlerModel(path);
  }
  throw Error("Cannot read the camera model " + path +
    ": it is neither a folder with COLMAP's files nor a file that ends in .nvm or .out.");
}

}
