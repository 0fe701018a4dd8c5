// SPDX-License-Identifier: BSD-3-Clause
#include "BinaryGLTF.h"

#include "Files/AtomicOutput.h"
#include "Common/Error.h"
#include "Data/PngBytes.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

// The PNG is VTK's: tinygltf needs no image library.
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace freespace
{

namespace
{

// Appends values to the model's only buffer, as a view of their own.
template <typename Value>
int AddView(tinygltf::Model& model, const std::vector<Value>& values, int target)
{
  std::vector<unsigned char>& bytes = model.buffers[0].data;
  bytes.resize((bytes.size() + 3) / 4 * 4);
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = bytes.size();
  view.byteLength = values.size() * sizeof(Value);
  view.target = target;
  bytes.resize(bytes.size() + view.byteLength);
  std::memcpy(bytes.data() + view.byteOffset, values.data(), view.byteLength);
  model.bufferViews.push_back(view);
  return static_cast<int>(model.bufferViews.size()) - 1;
}

int AddAccessor(tinygltf::Model& model, int view, int componentType, int type, std::size_t count)
{
  tinygltf::Accessor accessor;
  accessor.bufferView = view;
  accessor.componentType = componentType;
  accessor.type = type;
  accessor.count = count;
  model.accessors.push_back(accessor);
  return static_cast<int>(model.accessors.size()) - 1;
}

int AddPositions(tinygltf::Model& model, vtkPolyData* surface, const double origin[3])
{
  std::vector<float> positions;
  std::vector<double> low(3, std::numeric_limits<double>::infinity());
  std::vector<double> high(3, -std::numeric_limits<double>::infinity());
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    double point[3];
    surface->GetPoint(i, point);
    for (int axis = 0; axis < 3; ++axis)
    {
      const float value = static_cast<float>(point[axis] - origin[axis]);
      positions.push_back(value);
      low[axis] = std::min<double>(low[axis], value);
      high[axis] = std::max<double>(high[axis], value);
    }
  }
  const int view = AddView(model, positions, TINYGLTF_TARGET_ARRAY_BUFFER);
  const int accessor = AddAccessor(
    model, view, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, surface->GetNumberOfPoints());
  model.accessors[accessor].minValues = low;
  model.accessors[accessor].maxValues = high;
  return accessor;
}

// glTF's v runs down from the image's top.
int AddTextureCoordinates(tinygltf::Model& model, vtkDataArray* coordinates)
{
  std::vector<float> values;
  for (vtkIdType i = 0; i < coordinates->GetNumberOfTuples(); ++i)
  {
    values.push_back(static_cast<float>(coordinates->GetComponent(i, 0)));
    values.push_back(static_cast<float>(1 - coordinates->GetComponent(i, 1)));
  }
  const int view = AddView(model, values, TINYGLTF_TARGET_ARRAY_BUFFER);
  return AddAccessor(model, view, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC2,
    coordinates->GetNumberOfTuples());
}

int AddIndices(tinygltf::Model& model, vtkCellArray* triangles)
{
  std::vector<std::uint32_t> indices;
  vtkIdType count = 0;
  const vtkIdType* ids = nullptr;
  for (triangles->InitTraversal(); triangles->GetNextCell(count, ids);)
  {
    if (count != 3)
    {
      throw Error("A GLB holds triangles only: the surface has a polygon of " +
        std::to_string(count) + " corners.");
    }
    indices.insert(indices.end(), ids, ids + 3);
  }
  const int view = AddView(model, indices, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  return AddAccessor(
    model, view, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, indices.size());
}

int AddMaterial(tinygltf::Model& model, vtkImageData* texture)
{
  const auto bytes = PngBytes(texture);
  if (!bytes || bytes->GetNumberOfValues() == 0)
  {
    throw Error("The texture cannot be written as PNG.");
  }
  tinygltf::Image image;
  image.mimeType = "image/png";
  image.bufferView = AddView(model,
    std::vector<unsigned char>(
      bytes->GetPointer(0), bytes->GetPointer(0) + bytes->GetNumberOfValues()),
    0);
  model.images.push_back(image);
  tinygltf::Sampler sampler;
  sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR; // mipmaps would mix charts
  sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
  sampler.wrapS = sampler.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
  model.samplers.push_back(sampler);
  tinygltf::Texture map;
  map.source = 0;
  map.sampler = 0;
  model.textures.push_back(map);
  tinygltf::Material material;
  material.name = "photographs";
  material.doubleSided = true;
  material.pbrMetallicRoughness.baseColorTexture.index = 0;
  material.pbrMetallicRoughness.metallicFactor = 0;
  material.pbrMetallicRoughness.roughnessFactor = 1;
  material.extensions["KHR_materials_unlit"] = tinygltf::Value(tinygltf::Value::Object());
  model.extensionsUsed.push_back("KHR_materials_unlit");
  model.materials.push_back(material);
  return 0;
}

}

void WriteBinaryGLTF(
  vtkPolyData* surface, vtkImageData* texture, bool zUp, const AtomicOutput& target)
{
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.asset.generator = "freespace";
  model.buffers.emplace_back();

  // Single precision suffices around the middle of the surface, wherever that is.
  double bounds[6];
  surface->GetBounds(bounds);
  double origin[3] = { 0, 0, 0 };
  for (int axis = 0; axis < 3; ++axis)
  {
    const double middle = (bounds[2 * axis] + bounds[2 * axis + 1]) / 2;
    const double extent = bounds[2 * axis + 1] - bounds[2 * axis];
    origin[axis] = std::abs(middle) > 10 * extent ? middle : 0;
  }
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.attributes["POSITION"] = AddPositions(model, surface, origin);
  primitive.attributes["TEXCOORD_0"] =
    AddTextureCoordinates(model, surface->GetPointData()->GetTCoords());
  primitive.indices = AddIndices(model, surface->GetPolys());
  primitive.material = AddMaterial(model, texture);
  tinygltf::Mesh mesh;
  mesh.primitives.push_back(primitive);
  model.meshes.push_back(mesh);

  tinygltf::Node node;
  node.mesh = 0;
  if (zUp)
  {
    node.rotation = { -std::sqrt(0.5), 0, 0, std::sqrt(0.5) };
    node.translation = { origin[0], origin[2], -origin[1] };
  }
  else
  {
    node.translation = { origin[0], origin[1], origin[2] };
  }
  model.nodes.push_back(node);
  tinygltf::Scene scene;
  scene.nodes.push_back(0);
  model.scenes.push_back(scene);
  model.defaultScene = 0;
  tinygltf::TinyGLTF writer;
  if (!writer.WriteGltfSceneToFile(&model, target.Path(), true, true, false, true))
  {
    throw target.Failure();
  }
}

}
