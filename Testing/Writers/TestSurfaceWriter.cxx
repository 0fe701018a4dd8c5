// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceWriter.h"

#include "Data/SurfaceViewpoint.h"
#include "Data/ViewBlocks.h"
#include "Support/ErrorObserver.h"
#include "Support/TemporaryFolder.h"
#include "vtkSurfaceReader.h"

#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>
#include <tuple>

using namespace freespace;
namespace fs = std::filesystem;

namespace
{

using Triangle = std::array<double, 9>;

// The corners in single precision, which all formats keep.
vtkSmartPointer<vtkPolyData> MakeTetrahedron()
{
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0, 0, 0);
  points->InsertNextPoint(1.5, 0, 0);
  points->InsertNextPoint(0, 2.25, 0);
  points->InsertNextPoint(0, 0, -3.125);
  vtkNew<vtkCellArray> triangles;
  for (const std::array<vtkIdType, 3>& corners :
    { std::array<vtkIdType, 3>{ 0, 1, 2 }, { 0, 3, 1 }, { 0, 2, 3 }, { 1, 3, 2 } })
  {
    triangles->InsertNextCell(3, corners.data());
  }
  surface->SetPoints(points);
  surface->SetPolys(triangles);
  return surface;
}

std::set<Triangle> Triangles(vtkPolyData* surface)
{
  std::set<Triangle> triangles;
  for (vtkIdType i = 0; i < surface->GetNumberOfCells(); ++i)
  {
    Triangle triangle;
    for (int corner = 0; corner < 3; ++corner)
    {
      surface->GetPoint(surface->GetCell(i)->GetPointId(corner), &triangle[3 * corner]);
    }
    triangles.insert(triangle);
  }
  return triangles;
}

vtkSmartPointer<vtkPolyData> WriteAndRead(vtkPolyData* surface, const std::string& file)
{
  vtkNew<vtkSurfaceWriter> writer;
  writer->SetInputDataObject(surface);
  writer->SetFileName(file);
  EXPECT_EQ(writer->Write(), 1);
  vtkNew<vtkSurfaceReader> reader;
  reader->SetFileName(file);
  EXPECT_EQ(ErrorOfUpdate(reader), "");
  return reader->GetOutput();
}

}

TEST(vtkSurfaceWriter, ArraysAreInlineWhereAskedFor)
{
  const TemporaryFolder folder;
  const std::string file = folder.Path("surface.vtp");
  const vtkSmartPointer<vtkPolyData> surface = MakeTetrahedron();
  vtkNew<vtkSurfaceWriter> writer;
  writer->SetInputDataObject(surface);
  writer->SetFileName(file);
  writer->InlineArraysOn();
  EXPECT_EQ(writer->Write(), 1);
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  EXPECT_EQ(text.str().find("appended"), std::string::npos);
  EXPECT_NE(text.str().find("format=\"binary\""), std::string::npos);
  vtkNew<vtkSurfaceReader> reader;
  reader->SetFileName(file);
  EXPECT_EQ(ErrorOfUpdate(reader), "");
  EXPECT_EQ(Triangles(reader->GetOutput()), Triangles(surface));
}

TEST(vtkSurfaceWriter, WhatIsWrittenIsReadAgain)
{
  const TemporaryFolder folder;
  const auto surface = MakeTetrahedron();
  for (const char* name : { "a.ply", "a.stl", "a.obj", "a.vtp", "A.PLY", "A.Stl" })
  {
    SCOPED_TRACE(name);
    const auto read = WriteAndRead(surface, folder.Path(name));
    EXPECT_EQ(read->GetNumberOfPoints(), 4);
    EXPECT_EQ(Triangles(read), Triangles(surface));
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.Path()), fs::directory_iterator()), 6);
}

// A model in UTM coordinates: single precision has steps of half a metre there.
TEST(vtkSurfaceWriter, CoordinatesFarFromTheOriginAreKept)
{
  const TemporaryFolder folder;
  const auto surface = MakeTetrahedron();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    const double* point = surface->GetPoint(i);
    points->InsertNextPoint(
      500000.1 + point[0] / 100, 5400000.3 + point[1] / 100, 300.7 + point[2]);
  }
  surface->SetPoints(points);
  for (const char* name : { "a.ply", "a.obj", "a.vtp" })
  {
    EXPECT_EQ(Triangles(WriteAndRead(surface, folder.Path(name))), Triangles(surface)) << name;
  }
  vtkNew<vtkSurfaceWriter> writer;
  vtkNew<ErrorObserver> errors;
  writer->AddObserver(vtkCommand::ErrorEvent, errors);
  writer->SetInputDataObject(surface);
  writer->SetFileName(folder.Path("a.stl"));
  EXPECT_EQ(writer->Write(), 0);
  EXPECT_TRUE(errors->Has("single precision")) << errors->All;
  EXPECT_FALSE(fs::exists(folder.Path("a.stl")));
}

// With a shift an STL keeps it, too, and every reader of the files has small coordinates.
TEST(vtkSurfaceWriter, AGlobalShiftIsKeptInTheFileAndUndone)
{
  const TemporaryFolder folder;
  const auto surface = MakeTetrahedron();
  const auto far = MakeTetrahedron();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    const double* point = surface->GetPoint(i);
    points->InsertNextPoint(500000 + point[0], 5400000 + point[1], 300 + point[2]);
  }
  far->SetPoints(points);
  double shift[3];
  vtkSurfaceWriter::SuggestGlobalShift(far->GetBounds(), shift);
  EXPECT_EQ(shift[0], 500000);
  EXPECT_EQ(shift[1], 5400000);
  EXPECT_EQ(shift[2], 300);
  for (const char* name : { "a.ply", "a.stl", "a.obj", "a.vtp" })
  {
    SCOPED_TRACE(name);
    vtkNew<vtkSurfaceWriter> writer;
    writer->SetInputDataObject(far);
    writer->SetGlobalShift(shift);
    writer->SetFileName(folder.Path(name));
    ASSERT_EQ(writer->Write(), 1);
    EXPECT_EQ(far->GetFieldData()->GetNumberOfArrays(), 0);
    vtkNew<vtkSurfaceReader> reader;
    reader->SetFileName(folder.Path(name));
    EXPECT_EQ(ErrorOfUpdate(reader), "");
    EXPECT_EQ(reader->GetOutput()->GetFieldData()->GetNumberOfArrays(), 0);
    EXPECT_EQ(Triangles(reader->GetOutput()), Triangles(far));
  }
  EXPECT_EQ(Triangles(WriteAndRead(surface, folder.Path("near.ply"))), Triangles(surface));
  std::ifstream file(folder.Path("a.ply"), std::ios::binary);
  const std::string content{ std::istreambuf_iterator<char>(file), {} };
  EXPECT_NE(content.find("comment global shift 500000 5400000 300\n"), std::string::npos);
  EXPECT_NE(content.find("property float x"), std::string::npos);
}

TEST(vtkSurfaceWriter, AGlobalShiftThatNoFileKeepsIsAnError)
{
  const TemporaryFolder folder;
  const double longest[3] = { 1234567.1234567891, 1234567.1234567893, -1234567.1234567895e-200 };
  const double endless[3] = { 0, std::numeric_limits<double>::quiet_NaN(), 0 };
  for (const auto& [name, shift, fault] :
    { std::tuple("a.stl", longest, "digits"), std::tuple("a.ply", endless, "finite") })
  {
    vtkNew<vtkSurfaceWriter> writer;
    vtkNew<ErrorObserver> errors;
    writer->AddObserver(vtkCommand::ErrorEvent, errors);
    writer->SetInputDataObject(MakeTetrahedron());
    writer->SetFileName(folder.Path(name));
    writer->SetGlobalShift(shift);
    EXPECT_EQ(writer->Write(), 0) << name;
    EXPECT_TRUE(errors->Has(fault)) << errors->All;
    EXPECT_FALSE(fs::exists(folder.Path(name)));
  }
}

TEST(vtkSurfaceWriter, PLYAndVTPKeepTheViewpoint)
{
  const TemporaryFolder folder;
  const auto surface = MakeTetrahedron();
  Camera camera;
  camera.width = 64;
  camera.height = 48;
  camera.K << 70.1, 0, 32.2, 0, 70.3, 24.4, 0, 0, 1;
  camera.R = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  camera.t = { 0.1, -0.2, 1 / 3.0 };
  AddCamera(surface, camera, "");
  for (const char* name : { "a.ply", "a.vtp" })
  {
    const auto viewpoint = ViewpointOf(WriteAndRead(surface, folder.Path(name)));
    ASSERT_TRUE(viewpoint) << name;
    EXPECT_TRUE(viewpoint->K.isApprox(camera.K, 1e-14)) << name;
    EXPECT_TRUE(viewpoint->R.isApprox(camera.R, 1e-14)) << name;
    EXPECT_TRUE(viewpoint->t.isApprox(camera.t, 1e-14)) << name;
    EXPECT_EQ(viewpoint->width, 64) << name;
    EXPECT_EQ(viewpoint->height, 48) << name;
  }
}

TEST(vtkSurfaceWriter, KnowsItsExtensions)
{
  for (const char* name : { "a.ply", "a.STL", "/x.y/a.obj", "a.b.vtp" })
  {
    EXPECT_TRUE(vtkSurfaceWriter::CanWriteFile(name)) << name;
  }
  for (const char* name : { "", "ply", "a.glb", "a.ply.gz", "a.ply/b" })
  {
    EXPECT_FALSE(vtkSurfaceWriter::CanWriteFile(name)) << name;
  }
}

TEST(vtkSurfaceWriter, FaultsNameTheFileAndLeaveIt)
{
  const TemporaryFolder folder;
  const auto surface = MakeTetrahedron();
  vtkNew<vtkPolyData> empty;
  const std::string old = folder.Write("old.ply", "old");
  const std::pair<std::string, vtkPolyData*> cases[] = { { old, empty },
    { folder.Path("a.txt"), surface }, { folder.Path("absent/a.ply"), surface } };
  for (const auto& [file, input] : cases)
  {
    vtkNew<vtkSurfaceWriter> writer;
    vtkNew<ErrorObserver> errors;
    writer->AddObserver(vtkCommand::ErrorEvent, errors);
    writer->SetInputDataObject(input);
    writer->SetFileName(file);
    EXPECT_EQ(writer->Write(), 0) << file;
    EXPECT_TRUE(errors->Has(file)) << errors->All;
  }
  std::string content;
  std::getline(std::ifstream(old), content);
  EXPECT_EQ(content, "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.Path()), fs::directory_iterator()), 1);
}
