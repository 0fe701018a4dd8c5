// SPDX-License-Identifier: BSD-3-Clause
#include "SparseModel/ColmapModel.h"

#include "Files/AtomicOutput.h"
#include "Common/Error.h"

#include <charconv>
#include <filesystem>
#include <fstream>

namespace freespace
{

namespace fs = std::filesystem;

namespace
{

// A file of the model; the names of the calls are those of BinarySource and TextSource.
class BinaryTarget
{
public:
  explicit BinaryTarget(const fs::path& file)
    : Stream(file, std::ios::binary)
  {
  }

  template <typename Value>
  void Put(Value value)
  {
    this->Stream.write(reinterpret_cast<const char*>(&value), sizeof(value));
  }

  void Text(const std::string& text)
  {
    this->Stream.write(text.c_str(), static_cast<std::streamsize>(text.size() + 1));
  }

  bool Close()
  {
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

  void Comment(const char* text) { this->Stream << "# " << text << "\n"; }

  // The shortest text that is read as the same number.
  template <typename Value>
  TextTarget& Put(Value value)
  {
    char text[40];
    const auto result = std::to_chars(text, text + sizeof(text), value);
    return this->Text(std::string(text, result.ptr));
  }

  TextTarget& Text(const std::string& text)
  {
    this->Stream << (this->AtBegin ? "" : " ") << text;
    this->AtBegin = false;
    return *this;
  }

  void EndLine()
  {
    this->Stream << "\n";
    this->AtBegin = true;
  }

  bool Close()
  {
    this->Stream.close();
    return this->Stream.good();
  }

private:
  std::ofstream Stream;
  bool AtBegin = true;
};

bool WriteBinaryCameras(const SparseModel& model, const fs::path& file)
{
  BinaryTarget target(file);
  target.Put<std::uint64_t>(model.cameras.size());
  for (const SparseCamera& camera : model.cameras)
  {
    target.Put(camera.id);
    target.Put(static_cast<std::int32_t>(camera.model));
    target.Put(camera.width);
    target.Put(camera.height);
    for (double parameter : camera.parameters)
    {
      target.Put(parameter);
    }
  }
  return target.Close();
}

bool WriteBinaryImages(const SparseModel& model, const fs::path& file)
{
  BinaryTarget target(file);
  target.Put<std::uint64_t>(model.images.size());
  for (const SparseImage& image : model.images)
  {
    target.Put(image.id);
    for (double q : image.rotation)
    {
      target.Put(q);
    }
    for (double t : image.translation)
    {
      target.Put(t);
    }
    target.Put(image.camera);
    target.Text(image.name);
    target.Put<std::uint64_t>(image.observations.size());
    for (const SparseObservation& observation : image.observations)
    {
      target.Put(observation.pixel.x());
      target.Put(observation.pixel.y());
      target.Put(observation.point);
    }
  }
  return target.Close();
}

bool WriteBinaryPoints(const SparseModel& model, const fs::path& file)
{
  BinaryTarget target(file);
  target.Put<std::uint64_t>(model.points.size());
  for (const SparsePoint& point : model.points)
  {
    target.Put(point.id);
    for (double x : point.position)
    {
      target.Put(x);
    }
    for (std::uint8_t channel : point.color)
    {
      target.Put(channel);
    }
    target.Put(point.error);
    target.Put<std::uint64_t>(point.track.size());
    for (const SparseTrackElement& element : point.track)
    {
      target.Put(element.image);
      target.Put(element.observation);
    }
  }
  return target.Close();
}

bool WriteTextCameras(const SparseModel& model, const fs::path& file)
{
  TextTarget target(file);
  target.Comment("CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]");
  for (const SparseCamera& camera : model.cameras)
  {
    target.Put(camera.id).Text(LensModelName(camera.model)).Put(camera.width).Put(camera.height);
    for (double parameter : camera.parameters)
    {
      target.Put(parameter);
    }
    target.EndLine();
  }
  return target.Close();
}

bool WriteTextImages(const SparseModel& model, const fs::path& file)
{
  TextTarget target(file);
  target.Comment("IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME");
  target.Comment("POINTS2D[] as (X, Y, POINT3D_ID)");
  for (const SparseImage& image : model.images)
  {
    target.Put(image.id);
    for (double q : image.rotation)
    {
      target.Put(q);
    }
    for (double t : image.translation)
    {
      target.Put(t);
    }
    target.Put(image.camera).Text(image.name).EndLine();
    for (const SparseObservation& observation : image.observations)
    {
      target.Put(observation.pixel.x()).Put(observation.pixel.y());
      target.Put(static_cast<std::int64_t>(observation.point)); // none: -1
    }
    target.EndLine();
  }
  return target.Close();
}

bool WriteTextPoints(const SparseModel& model, const fs::path& file)
{
  TextTarget target(file);
  target.Comment("POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)");
  for (const SparsePoint& point : model.points)
  {
    target.Put(point.id);
    for (double x : point.position)
    {
      target.Put(x);
    }
    for (std::uint8_t channel : point.color)
    {
      target.Put(static_cast<int>(channel));
    }
    target.Put(point.error);
    for (const SparseTrackElement& element : point.track)
    {
      target.Put(element.image).Put(element.observation);
    }
    target.EndLine();
  }
  return target.Close();
}

void RemoveFiles(const fs::path& folder, const char* ending)
{
  for (const char* name : { "cameras", "images", "points3D" })
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
  const bool done = text ? WriteTextCameras(model, made / "cameras.txt") &&
      WriteTextImages(model, made / "images.txt") && WriteTextPoints(model, made / "points3D.txt")
                         : WriteBinaryCameras(model, made / "cameras.bin") &&
      WriteBinaryImages(model, made / "images.bin") &&
      WriteBinaryPoints(model, made / "points3D.bin");
  if (!done)
  {
    throw Error("Cannot write the camera model " + folder + ": the disk is full or failed.");
  }
  output.Commit();
  RemoveFiles(folder, text ? ".bin" : ".txt");
}

}
