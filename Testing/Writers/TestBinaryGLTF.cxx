// SPDX-License-Identifier: BSD-3-Clause
// The bytes of a .glb, taken apart by the specification of glTF 2.0.
#include "vtkTexturedSurfaceWriter.h"

#include "Support/ErrorObserver.h"
#include "Support/TemporaryFolder.h"
#include "Text/JsonNode.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <cstring>
#include <fstream>
#include <memory>
#include <sstream>

using namespace freespace;
using Eigen::Vector3d;

namespace
{

// Two triangles at an offset, with a texture of 3 x 2 pixels.
struct TexturedSurface
{
  explicit TexturedSurface(const Vector3d& offset)
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkFloatArray> coordinates;
    coordinates->SetName("TextureCoordinates");
    coordinates->SetNumberOfComponents(2);
    for (int i = 0; i < 4; ++i)
    {
      const Vector3d point = offset + Vector3d(i % 2, i / 2, 0.25 * i);
      this->corners.push_back(point);
      points->InsertNextPoint(point.data());
      coordinates->InsertNextTuple2(0.25 * i, 0.125 * i);
    }
    vtkNew<vtkCellArray> triangles;
    for (const std::array<vtkIdType, 3>& triangle :
      { std::array<vtkIdType, 3>{ 0, 1, 2 }, { 1, 3, 2 } })
    {
      triangles->InsertNextCell(3, triangle.data());
    }
    this->surface->SetPoints(points);
    this->surface->SetPolys(triangles);
    this->surface->GetPointData()->SetTCoords(coordinates);
    this->texture->SetDimensions(3, 2, 1);
    this->texture->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    for (int i = 0; i < 18; ++i)
    {
      static_cast<unsigned char*>(this->texture->GetScalarPointer())[i] =
        static_cast<unsigned char>(13 * i);
    }
  }

  // What is wrong; empty: it is written.
  std::string Write(const std::string& fileName, bool zUp = false)
  {
    vtkNew<vtkTexturedSurfaceWriter> writer;
    vtkNew<ErrorObserver> errors;
    writer->AddObserver(vtkCommand::ErrorEvent, errors);
    writer->SetInputDataObject(0, this->surface);
    writer->SetInputDataObject(1, this->texture);
    writer->SetZUp(zUp);
    writer->SetFileName(fileName);
    const int isWritten = writer->Write();
    EXPECT_EQ(isWritten, errors->All.empty() ? 1 : 0);
    return errors->All;
  }

  vtkNew<vtkPolyData> surface;
  vtkNew<vtkImageData> texture;
  std::vector<Vector3d> corners;
};

// A .glb: a header of 12 bytes, a chunk of JSON and one of binary data.
class GlbFile
{
public:
  explicit GlbFile(const TemporaryFolder& folder, const std::string& name)
  {
    std::stringstream content;
    content << std::ifstream(folder.Path(name), std::ios::binary).rdbuf();
    this->Bytes = content.str();
    EXPECT_EQ(this->Bytes.substr(0, 4), "glTF");
    EXPECT_EQ(this->At<std::uint32_t>(4), 2u);
    EXPECT_EQ(this->At<std::uint32_t>(8), this->Bytes.size());
    const std::uint32_t length = this->At<std::uint32_t>(12);
    EXPECT_EQ(length % 4, 0u);
    EXPECT_EQ(this->Bytes.substr(16, 4), "JSON");
    this->Json =
      std::make_unique<JsonDocument>(folder.Write("chunk.json", this->Bytes.substr(20, length)));
    EXPECT_EQ(this->At<std::uint32_t>(20 + length) % 4, 0u);
    EXPECT_EQ(this->Bytes.substr(24 + length, 4), std::string("BIN\0", 4));
    this->Binary = 28 + length;
    EXPECT_EQ(this->Binary + this->At<std::uint32_t>(20 + length), this->Bytes.size());
  }

  JsonNode Root() const { return this->Json->Root(); }
  JsonNode Primitive() const
  {
    return this->Root().At("meshes").Elements()[0].At("primitives").Elements()[0];
  }
  JsonNode Node() const { return this->Root().At("nodes").Elements()[0]; }

  // The bytes of a view of the buffer.
  std::string View(int number) const
  {
    const JsonNode view = this->Root().At("bufferViews").Elements()[number];
    const int offset = view.Has("byteOffset") ? view.At("byteOffset").Integer() : 0;
    EXPECT_EQ(offset % 4, 0);
    return this->Bytes.substr(this->Binary + offset, view.At("byteLength").Integer());
  }

  // The values of an accessor, which has this many of a kind.
  template <typename Value>
  std::vector<Value> Values(int number, int componentType, const std::string& kind, int count) const
  {
    const JsonNode accessor = this->Root().At("accessors").Elements()[number];
    EXPECT_EQ(accessor.At("componentType").Integer(), componentType);
    EXPECT_EQ(accessor.At("type").Text(), kind);
    EXPECT_EQ(accessor.At("count").Integer(), count);
    const std::string bytes = this->View(accessor.At("bufferView").Integer());
    std::vector<Value> values(bytes.size() / sizeof(Value));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(Value));
    return values;
  }

  // Where the file has a corner of the mesh, by the node's rotation and translation.
  Vector3d Corner(int i) const
  {
    const std::vector<float> positions = this->Values<float>(
      this->Primitive().At("attributes").At("POSITION").Integer(), 5126, "VEC3", 4);
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
    if (this->Node().Has("rotation"))
    {
      const std::vector<double> q = this->Node().At("rotation").Numbers(4);
      rotation = Eigen::Quaterniond(q[3], q[0], q[1], q[2]);
    }
    const std::vector<double> t = this->Node().At("translation").Numbers(3);
    return rotation * Vector3d(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]) +
      Vector3d(t[0], t[1], t[2]);
  }

private:
  template <typename Value>
  Value At(std::size_t place) const
  {
    Value value{};
    EXPECT_LE(place + sizeof value, this->Bytes.size());
    std::memcpy(&value, &this->Bytes[place], sizeof value);
    return value;
  }

  std::string Bytes;
  std::unique_ptr<JsonDocument> Json;
  std::size_t Binary = 0; // where the binary data begin
};

}

TEST(BinaryGLTF, HoldsPositionsCoordinatesAndTriangles)
{
  const TemporaryFolder folder;
  TexturedSurface given(Vector3d(0.5, 0, 0));
  ASSERT_EQ(given.Write(folder.Path("a.glb")), "");
  const GlbFile file(folder, "a.glb");
  EXPECT_EQ(file.Root().At("asset").At("version").Text(), "2.0");
  EXPECT_EQ(file.Values<std::uint32_t>(file.Primitive().At("indices").Integer(), 5125, "SCALAR", 6),
    (std::vector<std::uint32_t>{ 0, 1, 2, 1, 3, 2 }));
  const int positions = file.Primitive().At("attributes").At("POSITION").Integer();
  const JsonNode accessor = file.Root().At("accessors").Elements()[positions];
  EXPECT_EQ(accessor.At("min").Numbers(3), (std::vector<double>{ 0.5, 0, 0 }));
  EXPECT_EQ(accessor.At("max").Numbers(3), (std::vector<double>{ 1.5, 1, 0.75 }));
  const std::vector<float> coordinates = file.Values<float>(
    file.Primitive().At("attributes").At("TEXCOORD_0").Integer(), 5126, "VEC2", 4);
  for (int i = 0; i < 4; ++i)
  {
    EXPECT_EQ(file.Corner(i), given.corners[i]);
    EXPECT_EQ(coordinates[2 * i], 0.25F * i);
    EXPECT_EQ(coordinates[2 * i + 1], 1 - 0.125F * i) << "v runs down in glTF";
  }
}

TEST(BinaryGLTF, TheTextureIsAPngWithoutLight)
{
  const TemporaryFolder folder;
  TexturedSurface given(Vector3d(0, 0, 0));
  ASSERT_EQ(given.Write(folder.Path("a.glb")), "");
  const GlbFile file(folder, "a.glb");
  const JsonNode image = file.Root().At("images").Elements()[0];
  EXPECT_EQ(image.At("mimeType").Text(), "image/png");
  const std::string png = folder.Write("texture.png", file.View(image.At("bufferView").Integer()));
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(png.c_str());
  reader->Update();
  ASSERT_EQ(reader->GetOutput()->GetNumberOfPoints(), 6);
  EXPECT_EQ(
    std::memcmp(reader->GetOutput()->GetScalarPointer(), given.texture->GetScalarPointer(), 18), 0);
  const JsonNode material = file.Root().At("materials").Elements()[0];
  EXPECT_TRUE(material.At("extensions").Has("KHR_materials_unlit"));
  EXPECT_TRUE(material.At("doubleSided").Truth());
}

// In UTM coordinates single precision has steps of half a metre.
TEST(BinaryGLTF, FarFromTheOriginItKeepsItsShape)
{
  const TemporaryFolder folder;
  TexturedSurface given(Vector3d(500000.1, 5400000.3, 0.1));
  ASSERT_EQ(given.Write(folder.Path("a.glb")), "");
  const GlbFile file(folder, "a.glb");
  for (int i = 0; i < 4; ++i)
  {
    EXPECT_LT((file.Corner(i) - given.corners[i]).norm(), 1e-6);
  }
}

// glTF has y up: what was z becomes y, and y is -z.
TEST(BinaryGLTF, ZUpIsTurned)
{
  const TemporaryFolder folder;
  for (const double far : { 0.0, 5e6 })
  {
    TexturedSurface given(Vector3d(far, -far, 0));
    ASSERT_EQ(given.Write(folder.Path("a.glb"), true), "");
    const GlbFile file(folder, "a.glb");
    for (int i = 0; i < 4; ++i)
    {
      const Vector3d& corner = given.corners[i];
      EXPECT_LT((file.Corner(i) - Vector3d(corner.x(), corner.z(), -corner.y())).norm(), 1e-6);
    }
  }
}

TEST(BinaryGLTF, WhatIsNoTriangleIsRefused)
{
  const TemporaryFolder folder;
  TexturedSurface given(Vector3d(0, 0, 0));
  const vtkIdType square[4] = { 0, 1, 3, 2 };
  given.surface->GetPolys()->InsertNextCell(4, square);
  EXPECT_NE(given.Write(folder.Path("a.glb")).find("a polygon of 4 corners"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder.Path("a.glb")));
}
