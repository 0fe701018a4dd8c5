// SPDX-License-Identifier: BSD-3-Clause
// The bytes of a PLY, taken apart by the format's description.
#include "PlyWriter.h"

#include "Support/ErrorObserver.h"
#include "Support/TemporaryFolder.h"
#include "vtkSurfaceWriter.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <fstream>
#include <random>
#include <sstream>

using namespace freespace;

namespace
{

// A file's header and the bytes behind it, taken one value after the other.
class PlyBytes
{
public:
  explicit PlyBytes(const std::string& fileName)
  {
    std::stringstream content;
    content << std::ifstream(fileName, std::ios::binary).rdbuf();
    const std::string end = "end_header\n", all = content.str();
    const std::size_t at = all.find(end);
    EXPECT_NE(at, std::string::npos);
    this->Header = all.substr(0, at + end.size());
    this->Body = all.substr(at + end.size());
  }

  template <typename Value>
  Value Take()
  {
    Value value{};
    EXPECT_LE(this->At + sizeof value, this->Body.size());
    std::memcpy(&value, &this->Body[this->At], sizeof value);
    this->At += sizeof value;
    return value;
  }

  bool IsAtEnd() const { return this->At == this->Body.size(); }

  std::string Header;

private:
  std::string Body;
  std::size_t At = 0;
};

// Random points and polygons of three to seven corners; coordinates as they are given.
struct Surface
{
  Surface(unsigned int seed, int numberOfPoints, int type, double scale)
  {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    std::uniform_int_distribution<int> corner(0, numberOfPoints - 1), size(3, 7), byte(0, 255);
    vtkNew<vtkPoints> places;
    places->SetDataType(type);
    this->colors->SetName("RGB");
    this->colors->SetNumberOfComponents(3);
    this->normals->SetName("Normals");
    this->normals->SetNumberOfComponents(3);
    for (int i = 0; i < numberOfPoints; ++i)
    {
      places->InsertNextPoint(scale * unit(random), scale * unit(random), scale * unit(random));
      this->colors->InsertNextTuple3(byte(random), byte(random), byte(random));
      this->normals->InsertNextTuple3(unit(random), unit(random), unit(random));
    }
    vtkNew<vtkCellArray> cells;
    for (int i = 0; i < 2 * numberOfPoints; ++i)
    {
      this->polygons.emplace_back(size(random));
      for (vtkIdType& id : this->polygons.back())
      {
        id = corner(random);
      }
      cells->InsertNextCell(
        static_cast<vtkIdType>(this->polygons.back().size()), this->polygons.back().data());
    }
    this->data->SetPoints(places);
    this->data->SetPolys(cells);
  }

  void Write(const std::string& fileName)
  {
    vtkNew<vtkSurfaceWriter> writer;
    writer->SetInputDataObject(this->data);
    writer->SetFileName(fileName);
    ASSERT_EQ(writer->Write(), 1);
  }

  vtkNew<vtkPolyData> data;
  vtkNew<vtkUnsignedCharArray> colors;
  vtkNew<vtkFloatArray> normals;
  std::vector<std::vector<vtkIdType>> polygons;
};

template <typename Coordinate>
void ExpectPoint(PlyBytes& bytes, vtkPolyData* data, vtkIdType i)
{
  double point[3];
  data->GetPoint(i, point);
  for (const double coordinate : point)
  {
    EXPECT_EQ(static_cast<double>(bytes.Take<Coordinate>()), coordinate) << i;
  }
}

void ExpectBytes(Surface& surface, bool isDouble, bool hasNormals, bool isColored)
{
  const TemporaryFolder folder;
  surface.Write(folder.Path("a.ply"));
  PlyBytes bytes(folder.Path("a.ply"));
  PlyHeader header;
  header.isDouble = isDouble;
  header.hasNormals = hasNormals;
  header.isColored = isColored;
  header.vertices = surface.data->GetNumberOfPoints();
  header.faces = static_cast<std::int64_t>(surface.polygons.size());
  EXPECT_EQ(bytes.Header, header.Text());
  for (vtkIdType i = 0; i < surface.data->GetNumberOfPoints(); ++i)
  {
    isDouble ? ExpectPoint<double>(bytes, surface.data, i)
             : ExpectPoint<float>(bytes, surface.data, i);
    for (int axis = 0; axis < 3 && hasNormals; ++axis)
    {
      EXPECT_EQ(bytes.Take<float>(), surface.normals->GetTypedComponent(i, axis));
    }
    for (int channel = 0; channel < 3 && isColored; ++channel)
    {
      EXPECT_EQ(bytes.Take<unsigned char>(), surface.colors->GetTypedComponent(i, channel));
    }
  }
  for (const std::vector<vtkIdType>& polygon : surface.polygons)
  {
    ASSERT_EQ(bytes.Take<unsigned char>(), polygon.size());
    for (const vtkIdType id : polygon)
    {
      EXPECT_EQ(bytes.Take<std::int32_t>(), id);
    }
  }
  EXPECT_TRUE(bytes.IsAtEnd());
}

}

TEST(PlyHeader, HasALineForEachProperty)
{
  PlyHeader header;
  header.vertices = 3;
  header.faces = 1;
  EXPECT_EQ(header.Text(),
    "ply\nformat binary_little_endian 1.0\ncomment VTK generated PLY File\n"
    "obj_info vtkPolyData points and polygons: vtk4.0\nelement vertex 3\n"
    "property float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n");
  header.comments = { "Camera 1 2 3" };
  header.isDouble = true;
  header.hasNormals = true;
  header.isColored = true;
  EXPECT_EQ(header.Text(),
    "ply\nformat binary_little_endian 1.0\ncomment VTK generated PLY File\ncomment Camera 1 2 3\n"
    "obj_info vtkPolyData points and polygons: vtk4.0\nelement vertex 3\n"
    "property double x\nproperty double y\nproperty double z\n"
    "property float nx\nproperty float ny\nproperty float nz\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n");
}

TEST(PlyWriter, SinglePrecisionIsWhatKeepsTheCoordinate)
{
  EXPECT_TRUE(IsSingle(0.5));
  EXPECT_TRUE(IsSingle(-16777216));
  EXPECT_FALSE(IsSingle(16777217));
  EXPECT_FALSE(IsSingle(0.1));
  EXPECT_TRUE(IsSingle(static_cast<double>(0.1F)));
  EXPECT_FALSE(IsSingle(1e-300));
}

TEST(PlyWriter, TheBytesAreThoseOfTheFormat)
{
  for (unsigned int seed = 0; seed < 5; ++seed)
  {
    Surface surface(seed, 1 + 20 * static_cast<int>(seed), VTK_FLOAT, 10);
    ExpectBytes(surface, false, false, false);
    surface.data->GetPointData()->AddArray(surface.normals);
    ExpectBytes(surface, false, true, false);
    surface.data->GetPointData()->AddArray(surface.colors);
    ExpectBytes(surface, false, true, true);
  }
}

// Points in double precision whose coordinates all fit into single precision are written so.
TEST(PlyWriter, DoublePrecisionOnlyWhereItIsNeeded)
{
  Surface surface(1, 50, VTK_DOUBLE, 10);
  ExpectBytes(surface, true, false, false);
  vtkPoints* points = surface.data->GetPoints();
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    std::array<double, 3> point;
    points->GetPoint(i, point.data());
    // Through memory: GCC 12 leaves out the rounding of two of the three otherwise.
    const volatile float x = point[0], y = point[1], z = point[2];
    points->SetPoint(i, x, y, z);
  }
  ExpectBytes(surface, false, false, false);
  points->SetPoint(49, 0, 0, 0.1); // one is enough
  ExpectBytes(surface, true, false, false);
}

TEST(PlyWriter, APolygonOfMoreThan255CornersIsRefused)
{
  const TemporaryFolder folder;
  for (const int corners : { 255, 256 })
  {
    Surface surface(2, 10, VTK_FLOAT, 1);
    const std::vector<vtkIdType> polygon(corners, 3);
    surface.data->GetPolys()->InsertNextCell(corners, polygon.data());
    vtkNew<vtkSurfaceWriter> writer;
    vtkNew<ErrorObserver> errors;
    writer->AddObserver(vtkCommand::ErrorEvent, errors);
    writer->SetInputDataObject(surface.data);
    writer->SetFileName(folder.Path(std::to_string(corners) + ".ply"));
    EXPECT_EQ(writer->Write(), corners == 255 ? 1 : 0);
    EXPECT_EQ(errors->Has("more than 255 corners"), corners == 256) << errors->All;
    EXPECT_EQ(
      std::filesystem::exists(folder.Path(std::to_string(corners) + ".ply")), corners == 255);
  }
}
