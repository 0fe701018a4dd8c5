// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceReader.h"

#include "Support/ErrorObserver.h"
#include "Support/TemporaryFolder.h"

#include <vtkCell.h>
#include <vtkErrorCode.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

using namespace freespace;

namespace
{

const std::string PlyHeader = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                              "property float y\nproperty float z\n";

// A square of one polygon.
const std::string SquarePly = PlyHeader +
  "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
  "0 0 5\n2 0 5\n2 1 5\n0 1 5\n4 0 1 2 3\n";

vtkSmartPointer<vtkPolyData> Read(const std::string& file)
{
  vtkNew<vtkSurfaceReader> reader;
  reader->SetFileName(file);
  EXPECT_EQ(ErrorOfUpdate(reader), "");
  EXPECT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
  return reader->GetOutput();
}

// The errors of the reader and its executive.
std::string ErrorsOf(vtkSurfaceReader* reader)
{
  vtkNew<ErrorObserver> errors;
  errors->Observe(reader);
  reader->Update();
  return errors->All;
}

// Twice the area of all triangles along z.
double AreaAlongZ(vtkPolyData* surface)
{
  double area = 0;
  for (vtkIdType i = 0; i < surface->GetNumberOfCells(); ++i)
  {
    double p[3][3];
    for (int corner = 0; corner < 3; ++corner)
    {
      surface->GetPoint(surface->GetCell(i)->GetPointId(corner), p[corner]);
    }
    area += (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
  }
  return area;
}

}

TEST(vtkSurfaceReader, PolygonsBecomeTriangles)
{
  const TemporaryFolder folder;
  for (const std::string& file : { folder.Write("a.ply", SquarePly),
         folder.Write("b.OBJ", "v 0 0 5\nv 2 0 5\nv 2 1 5\nv 0 1 5\nf 1 2 3 4\n") })
  {
    SCOPED_TRACE(file);
    const auto surface = Read(file);
    EXPECT_EQ(surface->GetNumberOfPoints(), 4);
    ASSERT_EQ(surface->GetNumberOfCells(), 2);
    EXPECT_EQ(surface->GetCell(0)->GetNumberOfPoints(), 3);
    EXPECT_DOUBLE_EQ(AreaAlongZ(surface), 4) << "the same side is the outside";
    EXPECT_DOUBLE_EQ(surface->GetBounds()[4], 5);
  }
}

// The corners of the triangles of an .stl are joined.
TEST(vtkSurfaceReader, TrianglesOfAnSTLShareTheirPoints)
{
  const TemporaryFolder folder;
  const std::string file = folder.Write("a.stl",
    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\n"
    "endfacet\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\n"
    "endfacet\nendsolid a\n");
  const auto surface = Read(file);
  EXPECT_EQ(surface->GetNumberOfCells(), 2);
  EXPECT_EQ(surface->GetNumberOfPoints(), 4);
}

TEST(vtkSurfaceReader, ColoursOfPointsAreKept)
{
  const TemporaryFolder folder;
  const auto surface = Read(folder.Write("a.ply",
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
    "property double z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0.1 1 2 3\n1 0 0 4 5 6\n0 1 0 255 0 9\n3 0 1 2\n"));
  vtkDataArray* colors = surface->GetPointData()->GetArray("RGB");
  ASSERT_TRUE(colors);
  EXPECT_EQ(colors->GetComponent(0, 1), 2);
  EXPECT_EQ(colors->GetComponent(2, 0), 255);
  EXPECT_EQ(surface->GetPoint(0)[2], 0.1) << "in double precision";
}

TEST(vtkSurfaceReader, TakesAnotherFileAfterAnError)
{
  const TemporaryFolder folder;
  vtkNew<vtkSurfaceReader> reader;
  reader->SetFileName(folder.Path("absent.ply"));
  EXPECT_NE(ErrorsOf(reader).find("absent.ply"), std::string::npos);
  EXPECT_NE(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
  reader->SetFileName(folder.Write("a.ply", SquarePly));
  EXPECT_EQ(ErrorOfUpdate(reader), "");
  EXPECT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
  EXPECT_EQ(reader->GetOutput()->GetNumberOfCells(), 2);
}

TEST(vtkSurfaceReader, FaultsNameTheFileAndLeaveNothing)
{
  const TemporaryFolder folder;
  const std::vector<std::array<std::string, 2>> cases = {
    { folder.Path("absent.ply"), "absent.ply" }, { folder.Write("a.txt", SquarePly), ".vtp" },
    { folder.Write("cut.ply", SquarePly.substr(0, SquarePly.size() - 14)), "cut.ply" },
    { folder.Write("beyond.ply", SquarePly.substr(0, SquarePly.size() - 2) + "4\n"), "beyond.ply" },
    { folder.Write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), "holds no surface" },
    { folder.Write("nan.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "nan.obj" },
    { folder.Write("text.vtp", "no XML"), "text.vtp" },
    { folder.Write("empty.stl", ""), "empty.stl" }
  };
  for (const auto& [file, words] : cases)
  {
    SCOPED_TRACE(file);
    vtkNew<vtkSurfaceReader> reader;
    reader->SetFileName(file);
    const std::string error = ErrorsOf(reader);
    EXPECT_NE(error.find(words), std::string::npos) << error;
    EXPECT_NE(error.find(file), std::string::npos) << error;
    EXPECT_NE(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
    EXPECT_EQ(reader->GetOutput()->GetNumberOfCells(), 0);
  }
}
