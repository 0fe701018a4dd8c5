// SPDX-License-Identifier: BSD-3-Clause
#include "SparseModel/ColmapModel.h"

#include "Common/Error.h"
#include "Text/TextSource.h"

#include <cstring>
#include <filesystem>
#include <string_view>
#include <unordered_set>
#include <utility>

namespace freespace
{

namespace fs = std::filesystem;

namespace
{

// --- What text and binary models have in common
// ---------------------------------------------------

constexpr int unsupportedModels[] = { 5, 7, 8, 9, 10 };
constexpr const char* unsupportedNames[] = { "OPENCV_FISHEYE", "FOV", "SIMPLE_RADIAL_FISHEYE",
  "RADIAL_FISHEYE", "THIN_PRISM_FISHEYE" };
constexpr LensModel lensModels[] = { LensModel::SimplePinhole, LensModel::Pinhole,
  LensModel::SimpleRadial, LensModel::Radial, LensModel::OpenCV, LensModel::FullOpenCV };
constexpr const char* supportedList =
  "SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV and FULL_OPENCV are";

std::string FaultOfCamera(
  const SparseImage& image, const std::unordered_set<std::uint32_t>& cameraIds)
{
  return cameraIds.count(image.camera)
    ? std::string()
    : "image " + image.name + " names an unknown camera, number " + std::to_string(image.camera);
}

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
  const std::unordered_set<Id>& Get() const { return this->Ids; }

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

// --- Binary
// ---------------------------------------------------------------------------------------

// Reads little-endian values off a whole file and never past its end.
class BinarySource
{
public:
  explicit BinarySource(const fs::path& file)
    : File(file)
    , Content(ReadWholeFile(file))
  {
  }

  [[noreturn]] void Fail(const std::string& fault) const
  {
    throw Error("Cannot read " + this->File.string() + ": " + fault + " (before byte " +
      std::to_string(this->Position) + ").");
  }

  template <typename Value>
  Value Get()
  {
    this->Need(1, sizeof(Value));
    Value value;
    std::memcpy(&value, this->Content.data() + this->Position, sizeof(Value));
    this->Position += sizeof(Value);
    return value;
  }

  // A count of elements that take at least `bytes` each: what cannot be there is not allocated.
  std::size_t Count(std::size_t bytes)
  {
    const auto count = this->Get<std::uint64_t>();
    this->Need(count, bytes);
    return static_cast<std::size_t>(count);
  }

  std::string Text()
  {
    const std::size_t end = this->Content.find('\0', this->Position);
    if (end == std::string::npos)
    {
      this->Fail("it is truncated");
    }
    std::string text = this->Content.substr(this->Position, end - this->Position);
    this->Position = end + 1;
    return text;
  }

  void ExpectEnd() const
  {
    if (this->Position != this->Content.size())
    {
      this->Fail("it holds more than its counts say");
    }
  }

private:
  void Need(std::uint64_t count, std::size_t bytes) const
  {
    if (count > (this->Content.size() - this->Position) / bytes)
    {
      this->Fail("it is truncated");
    }
  }

  fs::path File;
  std::string Content;
  std::size_t Position = 0;
};

LensModel ModelFromNumber(int number, const BinarySource& source)
{
  for (LensModel model : lensModels)
  {
    if (static_cast<int>(model) == number)
    {
      return model;
    }
  }
  std::string name = "number " + std::to_string(number);
  for (std::size_t i = 0; i < std::size(unsupportedModels); ++i)
  {
    name = unsupportedModels[i] == number ? unsupportedNames[i] : name;
  }
  source.Fail("the camera model " + name + " is not supported; " + supportedList);
}

std::unordered_set<std::uint32_t> ReadBinaryCameras(const fs::path& file, SparseModel& model)
{
  BinarySource source(file);
  UniqueIds<std::uint32_t> ids;
  model.cameras.resize(source.Count(4 + 4 + 8 + 8 + 3 * 8));
  for (SparseCamera& camera : model.cameras)
  {
    camera.id = source.Get<std::uint32_t>();
    camera.model = ModelFromNumber(source.Get<std::int32_t>(), source);
    camera.width = source.Get<std::uint64_t>();
    camera.height = source.Get<std::uint64_t>();
    camera.parameters.resize(LensModelParameters(camera.model));
    for (double& parameter : camera.parameters)
    {
      parameter = source.Get<double>();
    }
    FailOn(FaultOf(camera), source);
    ids.Add(camera.id, "cameras", source);
  }
  source.ExpectEnd();
  return ids.Get();
}

void ReadBinaryObservations(BinarySource& source, SparseImage& image)
{
  image.observations.resize(source.Count(2 * 8 + 8));
  for (SparseObservation& observation : image.observations)
  {
    observation.pixel.x() = source.Get<double>();
    observation.pixel.y() = source.Get<double>();
    observation.point = source.Get<std::uint64_t>();
  }
}

void ReadBinaryImages(
  const fs::path& file, const std::unordered_set<std::uint32_t>& cameraIds, SparseModel& model)
{
  BinarySource source(file);
  UniqueIds<std::uint32_t> ids;
  model.images.resize(source.Count(4 + 7 * 8 + 4 + 1 + 8));
  for (SparseImage& image : model.images)
  {
    image.id = source.Get<std::uint32_t>();
    for (double& q : image.rotation)
    {
      q = source.Get<double>();
    }
    for (double& t : image.translation)
    {
      t = source.Get<double>();
    }
    image.camera = source.Get<std::uint32_t>();
    image.name = source.Text();
    FailOn(FaultOf(image), source);
    FailOn(FaultOfCamera(image, cameraIds), source);
    ids.Add(image.id, "images", source);
    ReadBinaryObservations(source, image);
  }
  source.ExpectEnd();
}

void ReadBinaryPoints(const fs::path& file, SparseModel& model)
{
  BinarySource source(file);
  UniqueIds<std::uint64_t> ids;
  model.points.resize(source.Count(8 + 3 * 8 + 3 + 8 + 8));
  for (SparsePoint& point : model.points)
  {
    point.id = source.Get<std::uint64_t>();
    for (double& x : point.position)
    {
      x = source.Get<double>();
    }
    for (std::uint8_t& channel : point.color)
    {
      channel = source.Get<std::uint8_t>();
    }
    point.error = source.Get<double>();
    FailOn(FaultOf(point), source);
    ids.Add(point.id, "points", source);
    point.track.resize(source.Count(4 + 4));
    for (SparseTrackElement& element : point.track)
    {
      element.image = source.Get<std::uint32_t>();
      element.observation = source.Get<std::uint32_t>();
    }
  }
  source.ExpectEnd();
}

// --- Text
// -----------------------------------------------------------------------------------------

LensModel ModelFromName(std::string_view name, const TextSource& source)
{
  for (LensModel model : lensModels)
  {
    if (LensModelName(model) == name)
    {
      return model;
    }
  }
  source.Fail(
    "the camera model " + std::string(name.substr(0, 40)) + " is not supported; " + supportedList);
}

std::unordered_set<std::uint32_t> ReadTextCameras(const fs::path& file, SparseModel& model)
{
  TextSource source(file);
  UniqueIds<std::uint32_t> ids;
  while (source.NextEntry())
  {
    SparseCamera& camera = model.cameras.emplace_back();
    camera.id = source.Number<std::uint32_t>("a camera's id");
    camera.model = ModelFromName(source.Field("a camera model"), source);
    camera.width = source.Number<std::uint64_t>("a width");
    camera.height = source.Number<std::uint64_t>("a height");
    camera.parameters.resize(LensModelParameters(camera.model));
    for (double& parameter : camera.parameters)
    {
      parameter = source.Number<double>("a camera's parameter");
    }
    if (!source.AtLineEnd())
    {
      source.Fail("the camera model " + LensModelName(camera.model) + " has " +
        std::to_string(camera.parameters.size()) + " parameters, and here are more");
    }
    FailOn(FaultOf(camera), source);
    ids.Add(camera.id, "cameras", source);
  }
  return ids.Get();
}

void ReadTextObservations(TextSource& source, SparseImage& image)
{
  while (!source.AtLineEnd())
  {
    SparseObservation& observation = image.observations.emplace_back();
    observation.pixel.x() = source.Number<double>("an observation's x");
    observation.pixel.y() = source.Number<double>("an observation's y");
    const auto id = source.Number<std::int64_t>("the id of an observed point");
    observation.point = id < 0 ? SparseObservation::noPoint : static_cast<std::uint64_t>(id);
  }
}

void ReadTextImages(
  const fs::path& file, const std::unordered_set<std::uint32_t>& cameraIds, SparseModel& model)
{
  TextSource source(file);
  UniqueIds<std::uint32_t> ids;
  while (source.NextEntry())
  {
    SparseImage& image = model.images.emplace_back();
    image.id = source.Number<std::uint32_t>("an image's id");
    for (double& q : image.rotation)
    {
      q = source.Number<double>("a part of a quaternion");
    }
    for (double& t : image.translation)
    {
      t = source.Number<double>("a part of a translation");
    }
    image.camera = source.Number<std::uint32_t>("a camera's id");
    image.name = source.Remainder("the image's name");
    FailOn(FaultOf(image), source);
    FailOn(FaultOfCamera(image, cameraIds), source);
    ids.Add(image.id, "images", source);
    source.NextLine(); // the observations, often none
    ReadTextObservations(source, image);
  }
}

void ReadTextPoints(const fs::path& file, SparseModel& model)
{
  TextSource source(file);
  UniqueIds<std::uint64_t> ids;
  while (source.NextEntry())
  {
    SparsePoint& point = model.points.emplace_back();
    point.id = source.Number<std::uint64_t>("a point's id");
    for (double& x : point.position)
    {
      x = source.Number<double>("a coordinate");
    }
    for (std::uint8_t& channel : point.color)
    {
      channel = source.Number<std::uint8_t>("a colour from 0 to 255");
    }
    point.error = source.Number<double>("a reprojection error");
    while (!source.AtLineEnd())
    {
      SparseTrackElement& element = point.track.emplace_back();
      element.image = source.Number<std::uint32_t>("an image's id");
      element.observation = source.Number<std::uint32_t>("the index of an observation");
    }
    FailOn(FaultOf(point), source);
    ids.Add(point.id, "points", source);
  }
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

}

SparseModel ReadColmapModel(const std::string& folder)
{
  const fs::path path(folder);
  if (!fs::is_directory(path))
  {
    throw Error("Cannot read the camera model " + folder + ": there is no such folder.");
  }
  SparseModel model;
  if (fs::exists(path / "cameras.bin") && fs::exists(path / "images.bin"))
  {
    const auto cameraIds = ReadBinaryCameras(path / "cameras.bin", model);
    ReadBinaryImages(path / "images.bin", cameraIds, model);
    CheckNames(model, path / "images.bin");
    if (fs::exists(path / "points3D.bin"))
    {
      ReadBinaryPoints(path / "points3D.bin", model);
    }
    return model;
  }
  if (!fs::exists(path / "cameras.txt") && !fs::exists(path / "images.txt"))
  {
    throw Error("Cannot read the camera model " + folder +
      ": it has neither cameras.bin and images.bin nor cameras.txt and images.txt.");
  }
  const auto cameraIds = ReadTextCameras(path / "cameras.txt", model);
  ReadTextImages(path / "images.txt", cameraIds, model);
  CheckNames(model, path / "images.txt");
  if (fs::exists(path / "points3D.txt"))
  {
    ReadTextPoints(path / "points3D.txt", model);
  }
  return model;
}

}
