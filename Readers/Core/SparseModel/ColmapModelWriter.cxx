// SPDX-License-Identifier: BSD-3-Clause
#include "SparseModel/ColmapModel.h"

#include "Common/Error.h"
#include "Files/AtomicOutput.h"
#include "SparseModel/ColmapRecords.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <type_traits>

namespace freespace
{

namespace fs = std::filesystem;

namespace
{

// The archives of ColmapRecords.h that write.

class BinaryTarget
{
public:
  explicit BinaryTarget(const fs::path& file)
    : Stream(file, std::ios::binary)
  {
  }

  template <typename Number>
  void Value(const Number& number, const char*)
  {
    this->Stream.write(reinterpret_cast<const char*>(&number), sizeof(number));
  }

  template <typename Numbers>
  void Fixed(const Numbers& numbers, const char* what)
  {
    for (const auto& number : numbers)
    {
      this->Value(number, what);
    }
  }

  void Model(const SparseCamera& camera)
  {
    this->Value(static_cast<std::int32_t>(camera.model), "");
  }

  void Name(const std::string& name)
  {
    this->Stream.write(name.c_str(), static_cast<std::streamsize>(name.size() + 1));
  }

  void Observed(std::uint64_t id) { this->Value(id, ""); }
  void NextLine() {}

  template <typename Record, typename Visit>
  void List(const std::vector<Record>& list, std::size_t, const Visit& each)
  {
    this->Value(static_cast<std::uint64_t>(list.size()), "");
    std::for_each(list.begin(), list.end(), each);
  }

  template <typename Record, typename Visit>
  bool Records(const std::vector<Record>& list, const Visit& each)
  {
    this->List(list, 0, each);
    this->Stream.close();
    return this->Stream.good();
  }

private:
  std::ofstream Stream;
};

class TextTarget
{
public:
  explicit TextTarget(const fs::path& file)
    : Stream(file)
  {
  }

  // The shortest text that is read as the same number.
  template <typename Number>
  void Value(Number number, const char*)
  {
    char text[40];
    std::to_chars_result result{};
    if constexpr (std::is_same_v<Number, std::uint8_t>)
    {
      result = std::to_chars(text, text + sizeof(text), static_cast<int>(number));
    }
    else
    {
      result = std::to_chars(text, text + sizeof(text), number);
    }
    this->Name(std::string(text, result.ptr));
  }

  template <typename Numbers>
  void Fixed(const Numbers& numbers, const char* what)
  {
    for (const auto& number : numbers)
    {
      this->Value(number, what);
    }
  }

  void Model(const SparseCamera& camera) { this->Name(LensModelName(camera.model)); }

  void Name(const std::string& text)
  {
    this->Stream << (this->AtBegin ? "" : " ") << text;
    this->AtBegin = false;
  }

  void Observed(std::uint64_t id) { this->Value(static_cast<std::int64_t>(id), ""); } // none: -1

  void NextLine()
  {
    this->Stream << "\n";
    this->AtBegin = true;
  }

  template <typename Record, typename Visit>
  void List(const std::vector<Record>& list, std::size_t, const Visit& each)
  {
    std::for_each(list.begin(), list.end(), each);
  }

  void Comment(const char* text) { this->Stream << "# " << text << "\n"; }

  template <typename Record, typename Visit>
  bool Records(const std::vector<Record>& list, const Visit& each)
  {
    for (const Record& record : list)
    {
      each(record);
      this->NextLine();
    }
    this->Stream.close();
    return this->Stream.good();
  }

private:
  std::ofstream Stream;
  bool AtBegin = true;
};

template <typename Target>
bool WriteFiles(const SparseModel& model, Target& cameras, Target& images, Target& points)
{
  return cameras.Records(
           model.cameras, [&](const SparseCamera& camera) { VisitCamera(cameras, camera); }) &&
    images.Records(model.images,
      [&](const SparseImage& image)
      {
        VisitImage(images, image);
        images.NextLine();
        VisitObservations(images, image);
      }) &&
    points.Records(model.points,
      [&](const SparsePoint& point)
      {
        VisitPoint(points, point);
        VisitTrack(points, point);
      });
}

bool WriteBinaryFiles(const SparseModel& model, const fs::path& folder)
{
  BinaryTarget cameras(folder / "cameras.bin"), images(folder / "images.bin");
  BinaryTarget points(folder / "points3D.bin");
  return WriteFiles(model, cameras, images, points);
}

bool WriteTextFiles(const SparseModel& model, const fs::path& folder)
{
  TextTarget cameras(folder / "cameras.txt"), images(folder / "images.txt");
  TextTarget points(folder / "points3D.txt");
  cameras.Comment("CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]");
  images.Comment("IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME");
  images.Comment("POINTS2D[] as (X, Y, POINT3D_ID)");
  points.Comment("POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)");
  return WriteFiles(model, cameras, images, points);
}

void RemoveFiles(
  const fs::path& folder, std::initializer_list<const char*> names, const char* ending)
{
  for (const char* name : names)
  {
    std::error_code ignored;
    fs::remove(folder / (std::string(name) + ending), ignored);
  }
}

}

void WriteColmapModel(const SparseModel& model, const std::string& folder, ColmapFormat format)
{
  std::error_code failure;
  fs::create_directory(folder, failure);
  const bool text = format == ColmapFormat::Text;
  const std::string ending = text ? ".txt" : ".bin";
  AtomicOutput output((fs::path(folder) / ("cameras" + ending)).string());
  const fs::path made = fs::path(output.Path()).parent_path();
  const bool done = text ? WriteTextFiles(model, made) : WriteBinaryFiles(model, made);
  if (!done)
  {
    throw Error("Cannot write the camera model " + folder + ": the disk is full or failed.");
  }
  output.Commit();
  RemoveFiles(folder, { "cameras", "images", "points3D" }, text ? ".bin" : ".txt");
  RemoveFiles(folder, { "rigs", "frames" }, ".bin");
  RemoveFiles(folder, { "rigs", "frames" }, ".txt");
}

}
