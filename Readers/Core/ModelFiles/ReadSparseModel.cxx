// SPDX-License-Identifier: BSD-3-Clause
#include "ModelFiles/ReadSparseModel.h"

#include "Common/Error.h"
#include "Files/FileExtension.h"
#include "Files/PathChecks.h"
#include "ModelFiles/AliceVisionModel.h"
#include "ModelFiles/BundlerModel.h"
#include "ModelFiles/ForeignModel.h"
#include "ModelFiles/MetashapeModel.h"
#include "ModelFiles/MiddleburyModel.h"
#include "ModelFiles/NvmModel.h"
#include "ModelFiles/OpenMvgModel.h"
#include "ModelFiles/TransformsModel.h"
#include "SparseModel/ColmapModel.h"
#include "SparseModel/FindSparseModel.h"
#include "Text/TextSource.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

namespace freespace
{

namespace fs = std::filesystem;

namespace
{

// Finds what a JSON file is by the first key that tells, and reads no further.
class JsonKind : public nlohmann::json_sax<nlohmann::json>
{
public:
  ModelKind Kind() const { return this->Found; }

  bool key(string_t& name) override
  {
    if (this->Depth == 1)
    {
      this->Found = name == "sfm_data_version" ? ModelKind::OpenMvg
        : name == "frames" || name == "camera_angle_x" || name == "fl_x" || name == "camera_model"
        ? ModelKind::Transforms
        : name == "featuresFolders" || name == "poses" ? ModelKind::AliceVision
                                                       : ModelKind::None;
    }
    return this->Found == ModelKind::None;
  }

  bool start_object(std::size_t) override { return this->Open(); }
  bool start_array(std::size_t) override { return this->Open(); }
  bool end_object() override { return this->Close(); }
  bool end_array() override { return this->Close(); }
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override
  {
    return false;
  }

private:
  bool Open()
  {
    ++this->Depth;
    return true;
  }
  bool Close()
  {
    --this->Depth;
    return true;
  }

  int Depth = 0;
  ModelKind Found = ModelKind::None;
};

ModelKind KindOfJson(const fs::path& file)
{
  JsonKind kind;
  std::ifstream stream(file);
  if (stream)
  {
    nlohmann::json::sax_parse(stream, &kind);
  }
  return kind.Kind();
}

bool IsMetashape(const fs::path& file)
{
  return BeginOfFile(file.string(), 400).find("<document") != std::string::npos;
}

ModelKind KindOfFile(const fs::path& file)
{
  const std::string name = file.filename().string();
  const std::string ending = file.extension().string();
  return ending == ".nvm"                       ? ModelKind::Nvm
    : ending == ".out"                          ? ModelKind::Bundler
    : ending == ".sfm"                          ? ModelKind::AliceVision
    : EndsIn(name, "_par.txt")                  ? ModelKind::Middlebury
    : ending == ".json" && name != "scene.json" ? KindOfJson(file)
    : ending == ".xml" && IsMetashape(file)     ? ModelKind::Metashape
                                                : ModelKind::None;
}

// A file of a folder that is a model: one of the usual names, or the only one with such an ending.
fs::path ModelIn(const fs::path& folder)
{
  std::error_code ignored;
  for (const char* name : { "bundle.out", "transforms.json", "sfm_data.json", "cameras.xml" })
  {
    if (fs::is_regular_file(folder / name, ignored) && KindOfFile(folder / name) != ModelKind::None)
    {
      return folder / name;
    }
  }
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
  {
    const std::string name = entry.path().filename().string();
    for (const char* ending : { ".nvm", ".out", ".sfm", "_par.txt" })
    {
      if (EndsIn(name, ending) && entry.is_regular_file(ignored))
      {
        found.push_back(entry.path());
      }
    }
  }
  return found.size() == 1 ? found[0] : fs::path();
}

bool IsOfColmap(const fs::path& file)
{
  const std::string stem = file.stem().string(), ending = file.extension().string();
  return (ending == ".bin" || ending == ".txt") &&
    (stem == "cameras" || stem == "images" || stem == "points3D") &&
    HasColmapModel(file.parent_path().empty() ? "." : file.parent_path().string());
}

}

ModelSource FindModel(const std::string& path)
{
  std::error_code ignored;
  if (!fs::is_directory(path, ignored))
  {
    const fs::path file(path);
    if (IsOfColmap(file))
    {
      const fs::path folder = file.parent_path();
      return { ModelKind::Colmap, folder.empty() ? "." : folder.string(), "" };
    }
    return { KindOfFile(file), path, "" }; // one that is missing is told when it is read
  }
  if (!HasColmapModel(path) && !fs::exists(fs::path(path) / "scene.json", ignored))
  {
    if (const fs::path file = ModelIn(path); !file.empty())
    {
      return { KindOfFile(file), file.string(), "the model is " + file.string() };
    }
  }
  ModelSource source{ ModelKind::Colmap, "", "" };
  source.path = FindSparseModel(path, &source.told);
  source.kind = HasColmapModel(source.path) ? ModelKind::Colmap : ModelKind::None;
  return source;
}

bool IsSparseModel(const std::string& path)
{
  return FindModel(path).kind != ModelKind::None;
}

SparseModel ReadSparseModel(const std::string& path)
{
  const ModelSource source = FindModel(path);
  switch (source.kind)
  {
    case ModelKind::Colmap:
      return ReadColmapModel(source.path);
    case ModelKind::Bundler:
      return ReadBundlerModel(source.path);
    case ModelKind::Nvm:
      return ReadNvmModel(source.path);
    case ModelKind::Transforms:
      return ReadTransformsModel(source.path);
    case ModelKind::OpenMvg:
      return ReadOpenMvgModel(source.path);
    case ModelKind::AliceVision:
      return ReadAliceVisionModel(source.path);
    case ModelKind::Metashape:
      return ReadMetashapeModel(source.path);
    case ModelKind::Middlebury:
      return ReadMiddleburyModel(source.path);
    case ModelKind::None:
      break;
  }
  if (!IsThere(path))
  {
    throw Error("Cannot read the camera model " + path + ": there is no such file or folder.");
  }
  if (const std::string foreign = DescribeForeignModel(path); !foreign.empty())
  {
    throw Error("Cannot read the camera model " + path + ": " + foreign + ".");
  }
  if (IsFolder(path))
  {
    return ReadColmapModel(path); // tells which of its files are missing
  }
  throw Error("Cannot read the camera model " + path +
    ": it is neither a folder with COLMAP's files nor a .nvm, .out, .sfm, _par.txt, a "
    "transforms.json, "
    "sfm_data.json or Metashape's .xml.");
}

}
