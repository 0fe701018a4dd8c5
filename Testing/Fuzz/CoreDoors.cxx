// SPDX-License-Identifier: BSD-3-Clause
// Models, scenes, boards, tables and surfaces: doors of the core.
#include "Doors.h"

#include "Agreement/ProjectionErrors.h"
#include "Calibration/BoardText.h"
#include "Common/Error.h"
#include "ModelFiles/BundlerModel.h"
#include "ModelFiles/NvmModel.h"
#include "ModelFiles/ReadSparseModel.h"
#include "Scene/Scene.h"
#include "SparseModel/ColmapModel.h"
#include "SparseModel/SparseViews.h"
#include "Surface/SurfaceFile.h"
#include "Text/NumberTable.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace freespace
{

namespace
{

// What the stages take from a model first.
void Use(const SparseModel& model)
{
  FindMisprojectedImages(model);
  for (const SparseView& view : ViewsFromModel(model, SparseViewOptions()))
  {
    for (const Eigen::Vector3d& point : view.points)
    {
      if (!point.allFinite())
      {
        throw std::logic_error("A model gave a point that is not finite.");
      }
    }
  }
}

void ReadColmap(const std::vector<std::string_view>& parts, const std::string& ending)
{
  const char* const names[] = { "cameras", "images", "points3D" };
  for (std::size_t i = 0; i < 3; ++i)
  {
    PutFile("model/" + std::string(names[i]) + ending, i + 1 < parts.size() ? parts[i + 1] : "");
  }
  try
  {
    Use(ReadColmapModel(FuzzFolder() + "/model"));
  }
  catch (...)
  {
    RemoveFile("model");
    throw;
  }
  RemoveFile("model");
}

// COLMAP's text and binary, Bundler, VisualSFM, nerfstudio, OpenMVG, AliceVision, Metashape, Middlebury. The first part is one letter, the kind of the model.
void EnterModels(std::string_view bytes)
{
  const std::vector<std::string_view> parts = Parts(bytes);
  const char kind = parts.front().empty() ? 't' : parts.front().front();
  if (kind == 't' || kind == 'b')
  {
    ReadColmap(parts, kind == 't' ? ".txt" : ".bin");
  }
  else if (kind == 'n')
  {
    PutFile("model.nvm", parts.back());
    Use(ReadNvmModel(FuzzFolder() + "/model.nvm"));
  }
  else if (const char* name = kind == 'j' ? "transforms.json"
      : kind == 'm'                       ? "sfm_data.json"
      : kind == 'a'                       ? "a.sfm"
      : kind == 'x'                       ? "cameras.xml"
      : kind == 'p'                       ? "a_par.txt"
                                          : nullptr)
  {
    PutFile(name, parts.back());
    Use(ReadSparseModel(FuzzFolder() + "/" + name));
  }
  else
  {
    PutFile("bundle.out", parts[0].substr(1));
    PutFile("list.txt", parts.size() > 1 ? parts[1] : "");
    Use(ReadBundlerModel(FuzzFolder() + "/bundle.out"));
  }
}

void EnterScene(std::string_view bytes)
{
  PutFile("scene.json", bytes);
  const Scene scene = ReadScene(FuzzFolder() + "/scene.json");
  // What is read can be written, and is the same when it is read again.
  WriteScene(scene, FuzzFolder() + "/again.json");
  const Scene again = ReadScene(FuzzFolder() + "/again.json");
  if (again.clusters.size() != scene.clusters.size() ||
    again.board.has_value() != scene.board.has_value())
  {
    throw std::logic_error("A scene is another one when it is written and read again.");
  }
}

void EnterBoard(std::string_view bytes)
{
  BoardFromText(std::string(bytes)).Check();
}

void EnterTable(std::string_view bytes)
{
  for (const std::size_t columns : { 3, 6 })
  {
    std::istringstream text{ std::string(bytes) };
    try
    {
      for (const double number : ReadNumberTable(text, "a.csv", columns, [] {}))
      {
        if (!std::isfinite(number))
        {
          throw std::logic_error("A table gave a number that is not finite.");
        }
      }
    }
    catch (const Error&)
    {
      // It may have the other number of columns.
    }
  }
}

// PLY, STL, OBJ. The first byte is the kind of the file.
void EnterSurfaces(std::string_view bytes)
{
  const char kind = bytes.empty() ? 'p' : bytes.front();
  const std::string content(bytes.substr(bytes.empty() ? 0 : 1));
  const SurfaceFile surface = kind == 's' ? ParseSTL(content, "a.stl")
    : kind == 'o'                         ? ParseOBJ(content, "a.obj")
                                          : ParsePLY(content, "a.ply");
  for (const std::int64_t corner : surface.corners)
  {
    if (corner < 0 || corner >= static_cast<std::int64_t>(surface.points.size()))
    {
      throw std::logic_error("A surface has a corner that is no point of it.");
    }
  }
  if (!surface.ends.empty() &&
    surface.ends.back() != static_cast<std::int64_t>(surface.corners.size()))
  {
    throw std::logic_error("A surface has corners of no polygon.");
  }
}

}

std::vector<Door> Doors()
{
  return { { "models", EnterModels }, { "scene", EnterScene }, { "board", EnterBoard },
    { "table", EnterTable }, { "surfaces", EnterSurfaces } };
}

}
