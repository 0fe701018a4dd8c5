// SPDX-License-Identifier: BSD-3-Clause
#include "Blocks/SparseModelBlocks.h"

#include "Common/Error.h"
#include "Data/ViewBlocks.h"

#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

namespace freespace
{

namespace
{

// --- Into blocks
// ----------------------------------------------------------------------------------

template <typename Array>
Array* AddArray(vtkFieldData* data, const char* name, int components, std::size_t tuples)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(tuples));
  data->AddArray(array);
  return array;
}

void AddImage(const SparseImage& image, vtkFieldData* data)
{
  AddArray<vtkTypeInt64Array>(data, "ImageId", 1, 1)->SetValue(0, image.id);
  AddArray<vtkTypeInt64Array>(data, "CameraId", 1, 1)->SetValue(0, image.camera);
  AddArray<vtkDoubleArray>(data, "Rotation", 4, 1)->SetTypedTuple(0, image.rotation.data());
}

void AddLens(const SparseCamera& camera, vtkFieldData* data)
{
  vtkNew<vtkStringArray> model;
  model->SetName("LensModel");
  model->InsertNextValue(LensModelName(camera.model));
  data->AddArray(model);
  AddArray<vtkDoubleArray>(data, "LensParameters", static_cast<int>(camera.parameters.size()), 1)
    ->SetTypedTuple(0, camera.parameters.data());
}

// The observations of the image that are not features.
void AddKeypoints(const SparseImage& image, const SparseView& view, vtkFieldData* data)
{
  std::vector<bool> isFeature(image.observations.size(), false);
  for (int observation : view.observation)
  {
    isFeature[static_cast<std::size_t>(observation)] = true;
  }
  const std::size_t count =
    static_cast<std::size_t>(std::count(isFeature.begin(), isFeature.end(), false));
  auto* pixels = AddArray<vtkDoubleArray>(data, "Keypoint", 2, count);
  auto* indices = AddArray<vtkIntArray>(data, "KeypointObservation", 1, count);
  vtkIdType next = 0;
  for (std::size_t i = 0; i < isFeature.size(); ++i)
  {
    if (!isFeature[i])
    {
      pixels->SetTypedTuple(next, image.observations[i].pixel.data());
      indices->SetValue(next++, static_cast<int>(i));
    }
  }
}

void AddPoints(const SparseModel& model, const SparseView& view, vtkFieldData* data)
{
  const std::vector<SparseObservation>& observations =
    model.images[static_cast<std::size_t>(view.image)].observations;
  const std::size_t count = view.points.size();
  auto* ids = AddArray<vtkTypeInt64Array>(data, "PointId", 1, count);
  auto* indices = AddArray<vtkIntArray>(data, "Observation", 1, count);
  auto* pixels = AddArray<vtkDoubleArray>(data, "ObservedPixel", 2, count);
  auto* colors = AddArray<vtkUnsignedCharArray>(data, "RGB", 3, count);
  auto* errors = AddArray<vtkDoubleArray>(data, "ReprojectionError", 1, count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const SparsePoint& point = model.points[static_cast<std::size_t>(view.point[i])];
    const vtkIdType id = static_cast<vtkIdType>(i);
    ids->SetValue(id, static_cast<vtkTypeInt64>(point.id));
    indices->SetValue(id, view.observation[i]);
    pixels->SetTypedTuple(
      id, observations[static_cast<std::size_t>(view.observation[i])].pixel.data());
    colors->SetTypedTuple(id, point.color.data());
    errors->SetValue(id, point.error);
  }
}

// --- And back
// -------------------------------------------------------------------------------------

// The arrays of one block, by name; a null pointer for one that is missing or of a wrong shape.
class BlockArrays
{
public:
  explicit BlockArrays(vtkPolyData* block)
    : Block(block)
  {
  }

  vtkDataArray* OfPoints(const char* name, int components) const
  {
    vtkDataArray* array = this->Block->GetPointData()->GetArray(name);
    return array && array->GetNumberOfComponents() == components &&
        array->GetNumberOfTuples() == this->Block->GetNumberOfPoints()
      ? array
      : nullptr;
  }

  // Integers read from a file may be in an array of another class.
  vtkSmartPointer<vtkTypeInt64Array> PointIds() const
  {
    vtkSmartPointer<vtkTypeInt64Array> ids;
    if (vtkDataArray* array = this->OfPoints("PointId", 1))
    {
      ids = vtkSmartPointer<vtkTypeInt64Array>::New();
      ids->DeepCopy(array);
    }
    return ids;
  }

  // All values of an array in the field data; a file may change the number of components.
  std::vector<double> OfField(const char* name) const
  {
    vtkDataArray* array = this->Block->GetFieldData()->GetArray(name);
    std::vector<double> values;
    for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
    {
      for (int k = 0; k < array->GetNumberOfComponents(); ++k)
      {
        values.push_back(array->GetComponent(i, k));
      }
    }
    return values;
  }

  std::string TextOfField(const char* name) const
  {
    auto* array = vtkStringArray::SafeDownCast(this->Block->GetFieldData()->GetAbstractArray(name));
    return array && array->GetNumberOfValues() > 0 ? array->GetValue(0) : std::string();
  }

private:
  vtkPolyData* Block;
};

SparseCamera CameraOf(const View& view, const BlockArrays& arrays, std::uint32_t id)
{
  SparseCamera camera;
  camera.id = id;
  camera.width = static_cast<std::uint64_t>(view.camera.width);
  camera.height = static_cast<std::uint64_t>(view.camera.height);
  const std::string name = arrays.TextOfField("LensModel");
  const std::optional<LensModel> model = LensModelOf(name);
  camera.parameters = arrays.OfField("LensParameters");
  if (model && camera.parameters.size() == LensModelParameters(*model))
  {
    camera.model = *model;
    return camera;
  }
  const Eigen::Matrix3d K = view.camera.K / view.camera.K(2, 2);
  if (K(0, 1) != 0 || K(1, 0) != 0 || K(2, 0) != 0 || K(2, 1) != 0)
  {
    throw Error("View '" + view.name + "' has a camera with skew, which no camera model has.");
  }
  camera.model = LensModel::Pinhole;
  camera.parameters = { K(0, 0), K(1, 1), K(0, 2), K(1, 2) };
  return camera;
}

SparseImage ImageOf(const View& view, const BlockArrays& arrays)
{
  SparseImage image;
  image.name = view.imageFile.empty() ? view.name : view.imageFile;
  image.translation = view.camera.t;
  const std::vector<double> rotation = arrays.OfField("Rotation");
  if (rotation.size() == 4)
  {
    std::copy(rotation.begin(), rotation.end(), image.rotation.begin());
  }
  else
  {
    const Eigen::Quaterniond q(view.camera.R);
    image.rotation = { q.w(), q.x(), q.y(), q.z() };
  }
  return image;
}

class ModelMaker
{
public:
  explicit ModelMaker(vtkMultiBlockDataSet* blocks)
    : Views(ViewsFromBlocks(blocks))
  {
    for (unsigned int i = 0; i < blocks->GetNumberOfBlocks(); ++i)
    {
      this->Arrays.emplace_back(vtkPolyData::SafeDownCast(blocks->GetBlock(i)));
    }
  }

  SparseModel Make()
  {
    this->AddImages();
    for (std::size_t i = 0; i < this->Views.size(); ++i)
    {
      this->AddObservations(i);
    }
    for (std::size_t i = 0; i < this->Views.size(); ++i)
    {
      this->AddTracks(i);
    }
    return std::move(this->Model);
  }

private:
  // The ids of the source where every block has one of its own, else 1, 2, ...
  std::vector<std::uint32_t> ImageIds() const
  {
    std::vector<std::uint32_t> ids, numbers;
    for (std::size_t i = 0; i < this->Views.size(); ++i)
    {
      const std::vector<double> id = this->Arrays[i].OfField("ImageId");
      if (id.size() == 1 && id[0] >= 0 && id[0] <= UINT32_MAX)
      {
        ids.push_back(static_cast<std::uint32_t>(id[0]));
      }
      numbers.push_back(static_cast<std::uint32_t>(i + 1));
    }
    const std::unordered_set<std::uint32_t> distinct(ids.begin(), ids.end());
    return distinct.size() == this->Views.size() ? ids : numbers;
  }

  bool HasCameraIds() const
  {
    return std::all_of(this->Arrays.begin(), this->Arrays.end(),
      [](const BlockArrays& arrays)
      {
        const std::vector<double> id = arrays.OfField("CameraId");
        return id.size() == 1 && id[0] >= 0 && id[0] <= UINT32_MAX;
      });
  }

  void AddImages()
  {
    const std::vector<std::uint32_t> imageIds = this->ImageIds();
    const bool cameraIds = this->HasCameraIds();
    std::unordered_set<std::string> names;
    std::unordered_set<std::uint32_t> cameras;
    for (std::size_t i = 0; i < this->Views.size(); ++i)
    {
      SparseImage image = ImageOf(this->Views[i], this->Arrays[i]);
      image.id = imageIds[i];
      image.camera = cameraIds
        ? static_cast<std::uint32_t>(this->Arrays[i].OfField("CameraId").front())
        : imageIds[i];
      if (!names.insert(image.name).second)
      {
        throw Error("View '" + this->Views[i].name + "' has the image of another one, " +
          image.name + ": a camera model has each image once.");
      }
      if (cameras.insert(image.camera).second)
      {
        this->Model.cameras.push_back(CameraOf(this->Views[i], this->Arrays[i], image.camera));
      }
      this->Model.images.push_back(std::move(image));
    }
  }

  // The features at their original positions among the observations, the keypoints between them.
  void AddObservations(std::size_t i)
  {
    const View& view = this->Views[i];
    std::vector<SparseObservation>& observations = this->Model.images[i].observations;
    vtkDataArray* places = this->Arrays[i].OfPoints("Observation", 1);
    vtkDataArray* pixels = this->Arrays[i].OfPoints("ObservedPixel", 2);
    const std::vector<double> keypoints = this->Arrays[i].OfField("Keypoint");
    const std::vector<double> keypointPlaces = this->Arrays[i].OfField("KeypointObservation");
    observations.resize(view.points.size() + keypoints.size() / 2);
    this->Places.emplace_back(view.points.size());
    std::vector<bool> taken(observations.size(), false);
    bool usable = places && keypointPlaces.size() == keypoints.size() / 2;
    const auto take = [&](double place)
    {
      usable = usable && place >= 0 && place < static_cast<double>(taken.size()) &&
        !taken[static_cast<std::size_t>(place)];
      if (usable)
      {
        taken[static_cast<std::size_t>(place)] = true;
      }
    };
    for (std::size_t k = 0; usable && k < view.points.size(); ++k)
    {
      take(places->GetComponent(static_cast<vtkIdType>(k), 0));
    }
    for (std::size_t k = 0; usable && k < keypointPlaces.size(); ++k)
    {
      take(keypointPlaces[k]);
    }
    for (std::size_t k = 0; k < view.points.size(); ++k)
    {
      const vtkIdType id = static_cast<vtkIdType>(k);
      const std::size_t place = usable ? static_cast<std::size_t>(places->GetComponent(id, 0)) : k;
      this->Places[i][k] = static_cast<std::uint32_t>(place);
      observations[place].pixel = view.imagePoints[k];
      if (pixels)
      {
        observations[place].pixel = { pixels->GetComponent(id, 0), pixels->GetComponent(id, 1) };
      }
    }
    for (std::size_t k = 0; k < keypoints.size() / 2; ++k)
    {
      const std::size_t place =
        usable ? static_cast<std::size_t>(keypointPlaces[k]) : view.points.size() + k;
      observations[place].pixel = { keypoints[2 * k], keypoints[2 * k + 1] };
    }
  }

  // Points of one id are one point; without ids every feature is a point of its own.
  void AddTracks(std::size_t i)
  {
    const View& view = this->Views[i];
    const vtkSmartPointer<vtkTypeInt64Array> ids = this->Arrays[i].PointIds();
    vtkDataArray* colors = this->Arrays[i].OfPoints("RGB", 3);
    vtkDataArray* errors = this->Arrays[i].OfPoints("ReprojectionError", 1);
    for (std::size_t k = 0; k < view.points.size(); ++k)
    {
      const vtkIdType feature = static_cast<vtkIdType>(k);
      const std::uint64_t id =
        ids ? static_cast<std::uint64_t>(ids->GetValue(feature)) : this->FreshId();
      const auto [found, isNew] = this->Indices.emplace(id, this->Model.points.size());
      if (isNew)
      {
        SparsePoint& point = this->Model.points.emplace_back();
        point.id = id;
        point.position = view.points[k];
        point.error = errors ? errors->GetComponent(feature, 0) : -1;
        for (int c = 0; colors && c < 3; ++c)
        {
          point.color[static_cast<std::size_t>(c)] =
            static_cast<std::uint8_t>(colors->GetComponent(feature, c));
        }
      }
      const std::uint32_t place = this->Places[i][k];
      this->Model.images[i].observations[place].point = id;
      this->Model.points[found->second].track.push_back({ this->Model.images[i].id, place });
    }
  }

  // An id that no block uses.
  std::uint64_t FreshId()
  {
    if (this->NextId == 0)
    {
      for (const BlockArrays& arrays : this->Arrays)
      {
        const vtkSmartPointer<vtkTypeInt64Array> ids = arrays.PointIds();
        for (vtkIdType k = 0; ids && k < ids->GetNumberOfValues(); ++k)
        {
          this->NextId = std::max(this->NextId, static_cast<std::uint64_t>(ids->GetValue(k)));
        }
      }
      ++this->NextId;
    }
    return this->NextId++;
  }

  std::vector<View> Views;
  std::vector<BlockArrays> Arrays;
  SparseModel Model;
  std::vector<std::vector<std::uint32_t>> Places; // of the features among the observations
  std::unordered_map<std::uint64_t, std::size_t> Indices;
  std::uint64_t NextId = 0; // 0: not yet known
};

}

void BlocksFromModel(
  const SparseModel& model, const std::vector<SparseView>& views, vtkMultiBlockDataSet* blocks)
{
  std::unordered_map<std::uint32_t, const SparseCamera*> cameras;
  for (const SparseCamera& camera : model.cameras)
  {
    cameras[camera.id] = &camera;
  }
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    const SparseImage& image = model.images[static_cast<std::size_t>(views[i].image)];
    const vtkSmartPointer<vtkPolyData> block = BlockFromView(views[i]);
    AddImage(image, block->GetFieldData());
    AddLens(*cameras.at(image.camera), block->GetFieldData());
    AddKeypoints(image, views[i], block->GetFieldData());
    AddPoints(model, views[i], block->GetPointData());
    SetNamedBlock(blocks, static_cast<unsigned int>(i), views[i].name, block);
  }
}

SparseModel ModelFromBlocks(vtkMultiBlockDataSet* blocks)
{
  return ModelMaker(blocks).Make();
}

}
