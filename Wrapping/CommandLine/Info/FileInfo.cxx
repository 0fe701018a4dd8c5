// SPDX-License-Identifier: BSD-3-Clause
#include "Info/FileInfo.h"

#include "Common/Error.h"
#include "Files/FileExtension.h"
#include "Files/PathChecks.h"
#include "Images/ImageSize.h"
#include "Output/SurfaceFiles.h"
#include "Output/ViewFiles.h"
#include "ModelFiles/ReadSparseModel.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>
#include <vtkSurfaceWriter.h>

#include <nlohmann/json.hpp>

#include <filesystem>

namespace freespace
{

namespace
{

using Json = nlohmann::ordered_json;

bool IsScene(const std::string& path)
{
  return (LowerCaseExtension(path) == ".json" && !IsSparseModel(path)) ||
    IsFile(std::filesystem::path(path) / "scene.json");
}

}

Json InfoOf(Session& session, const std::string& fileName)
{
  Json info;
  info["file"] = fileName;
  if (!IsThere(fileName))
  {
    throw Error("Cannot read '" + fileName + "': it does not exist.");
  }
  if (vtkSurfaceWriter::CanWriteFile(fileName))
  {
    info.update(SurfaceInfo(ReadSurface(session, fileName)));
  }
  else if (LowerCaseExtension(fileName) == ".vtm")
  {
    info.update(ViewsInfo(ReadViews(session, fileName)));
  }
  else if (IsScene(fileName))
  {
    info.update(SceneInfo(fileName));
  }
  else if (IsFolder(fileName) || IsSparseModel(fileName))
  {
    info.update(ModelInfo(fileName));
  }
  else if (const auto size = ReadImageSize(fileName))
  {
    info["kind"] = "image";
    info["width"] = (*size)[0];
    info["height"] = (*size)[1];
  }
  else
  {
    throw Error("'" + fileName +
      "' is nothing that the program reads: a surface (.ply .stl .obj .vtp), "
      "features or disparity maps (.vtm), a scene (.json), a camera model or an image.");
  }
  return info;
}

}
