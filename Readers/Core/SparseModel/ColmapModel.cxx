// SPDX-License-Identifier: BSD-3-Clause
#include "SparseModel/ColmapModel.h"

#include "Common/Error.h"
#include "SparseModel/ColmapRecords.h"
#include "SparseModel/ColmapSources.h"

#include <filesystem>
#include <string_view>
#include <unordered_set>

namespace freespace
{

namespace fs = std::filesystem;

namespace
{

// Throws when an id was there before.
template <typename Id>
class UniqueIds
{
public:
  template <typename Source>
  void Add(Id id, const char* what, const Source& source)
  {
    if (!this->Ids.insert(id).second)
    {
      source.Fail("two " + std::string(what) + " have the id " + std::to_string(id));
    }
  }
  bool Has(Id id) const { return this->Ids.count(id) > 0; }

private:
  std::unordered_set<Id> Ids;
};

template <typename Source>
void FailOn(const std::string& fault, const Source& source)
{
  if (!fault.empty())
  {
    source.Fail(fault);
  }
}

template <typename Source>
UniqueIds<std::uint32_t> ReadCameras(const fs::path& file, SparseModel& model)
{
  Source source(file);
  UniqueIds<std::uint32_t> ids;
  source.Records(model.cameras, 4 + 4 + 8 + 8 + 3 * 8,
    [&](SparseCamera& camera)
    {
      VisitCamera(source, camera);
      source.EndRecord();
      FailOn(FaultOf(camera), source);
      ids.Add(camera.id, "cameras", source);
    });
  return ids;
}

template <typename Source>
void ReadImages(const fs::path& file, const UniqueIds<std::uint32_t>& cameraIds, SparseModel& model)
{
  Source source(file);
  UniqueIds<std::uint32_t> ids;
  source.Records(model.images, 4 + 7 * 8 + 4 + 1 + 8,
    [&](SparseImage& image)
    {
      VisitImage(source, image);
      FailOn(FaultOf(image), source);
      if (!cameraIds.Has(image.camera))
      {
        source.Fail("image " + image.name + " names an unknown camera, number " +
          std::to_string(image.camera));
      }
      ids.Add(image.id, "images", source);
      source.NextLine();
      VisitObservations(source, image);
    });
}

template <typename Source>
void ReadPoints(const fs::path& file, SparseModel& model)
{
  Source source(file);
  UniqueIds<std::uint64_t> ids;
  source.Records(model.points, 8 + 3 * 8 + 3 + 8 + 8,
    [&](SparsePoint& point)
    {
      VisitPoint(source, point);
      FailOn(FaultOf(point), source);
      ids.Add(point.id, "points", source);
      VisitTrack(source, point);
    });
}

// A name in two images would make a scene's clusters ambiguous.
void CheckNames(const SparseModel& model, const fs::path& file)
{
  std::unordered_set<std::string_view> names;
  for (const SparseImage& image : model.images)
  {
    if (!names.insert(image.name).second)
    {
      throw Error("Cannot read " + file.string() + ": two images are called " + image.name + ".");
    }
  }
}

template <typename Source>
SparseModel ReadFiles(const fs::path& folder, const std::string& ending)
{
  SparseModel model;
  const auto cameraIds = ReadCameras<Source>(folder / ("cameras" + ending), model);
  ReadImages<Source>(folder / ("images" + ending), cameraIds, model);
  CheckNames(model, folder / ("images" + ending));
  if (fs::exists(folder / ("points3D" + ending)))
  {
    ReadPoints<Source>(folder / ("points3D" + ending), model);
  }
  return model;
}

}

SparseModel ReadColmapModel(const std::string& folder)
{
  const fs::path path(folder);
  if (!fs::is_directory(path))
  {
    throw Error("Cannot read the camera model " + folder + ": there is no such folder.");
  }
  if (fs::exists(path / "cameras.bin") && fs::exists(path / "images.bin"))
  {
    return ReadFiles<ColmapBinarySource>(path, ".bin");
  }
  if (!fs::exists(path / "cameras.txt") && !fs::exists(path / "images.txt"))
  {
    throw Error("Cannot read the camera model " + folder +
      ": it has neither cameras.bin and images.bin nor cameras.txt and images.txt.");
  }
  return ReadFiles<ColmapTextSource>(path, ".txt");
}

}
