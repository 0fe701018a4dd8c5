// SPDX-License-Identifier: BSD-3-Clause
#include "ModelFiles/ForeignModel.h"

#include "Files/FileExtension.h"
#include "Text/TextSource.h"

#include <filesystem>

namespace freespace
{

namespace fs = std::filesystem;

namespace
{

struct ForeignKind
{
  const char* ending; ///< of the file's name
  const char* text;
};

constexpr ForeignKind kinds[] = {
  { ".psx", "a Metashape project: export its cameras as .xml (File, Export, Export Cameras)" },
  { ".psz", "a Metashape project: export its cameras as .xml (File, Export, Export Cameras)" },
  { ".rcproj", "a RealityCapture project: export its registration as COLMAP or Bundler" },
  { ".rsproj", "a RealityScan project: export its registration as COLMAP or Bundler" },
  { ".abc", "an Alembic scene: convert it to .sfm with aliceVision_convertSfMFormat" },
  { ".mg", "a Meshroom project: give the .sfm of its StructureFromMotion node" },
  { ".mvs", "an OpenMVS scene: give the model from which it was made" },
  { "poses_bounds.npy", "LLFF's list of poses: give the COLMAP model from which it was made" },
  { ".db", "COLMAP's database of features: run colmap mapper and give the model that it makes" },
  { "dataparser_transforms.json",
    "nerfstudio's transform of a scene: give the transforms.json from which it was trained" },
  { ".log", "a trajectory without intrinsics: make a COLMAP model of its images" },
  { ".ply",
    "a surface or a cloud of points, which has no cameras: give the model that it comes from" },
  { ".obj", "a surface, which has no cameras: give the model that it comes from" },
  { ".stl", "a surface, which has no cameras: give the model that it comes from" },
  { ".e57", "a laser scan: export its range images and give them to freespace depth" },
  { ".las", "a cloud of points, which has no cameras: give the model that it comes from" },
  { ".vtm", "features or disparity maps of freespace, not a camera model" },
};

// OpenSfM's list of reconstructions.
bool IsOpenSfm(const fs::path& path)
{
  const std::string text = BeginOfFile(path.string(), 1024);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string::npos && text[first] == '[' &&
    (text.find("\"cameras\"") != std::string::npos || text.find("\"shots\"") != std::string::npos);
}

}

std::string DescribeForeignModel(const std::string& path)
{
  std::error_code ignored;
  const std::string name = fs::path(path).filename().string();
  if (fs::is_directory(path, ignored))
  {
    const bool isKapture = fs::exists(fs::path(path) / "sensors" / "sensors.txt", ignored);
    return isKapture ? "it is a kapture: convert it with kapture_export_colmap.py" : "";
  }
  if (EndsIn(name, ".json") && IsOpenSfm(path))
  {
    return "it is a reconstruction of OpenSfM or OpenDroneMap: convert it with opensfm "
           "export_colmap";
  }
  for (const ForeignKind& kind : kinds)
  {
    if (EndsIn(name, kind.ending))
    {
      return "it is " + std::string(kind.text);
    }
  }
  return "";
}

}
