// SPDX-License-Identifier: BSD-3-Clause
#include "PlyWriter.h"

#include "Common/Error.h"
#include "Files/GlobalShift.h"

#include <vtkCellArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <fstream>
#include <limits>

namespace freespace
{

namespace
{

template <typename Value>
void Put(std::ostream& file, Value value)
{
  file.write(reinterpret_cast<const char*>(&value), sizeof value);
}

// Neither are vertices of a PLY more than a 32-bit index counts, nor a polygon's corners than a byte does.
void CheckCounts(vtkPolyData* surface, const std::string& fileName)
{
  if (surface->GetNumberOfPoints() > std::numeric_limits<std::int32_t>::max())
  {
    throw Error("Cannot write " + fileName + ": a PLY counts no more than 2^31 vertices.");
  }
  if (surface->GetPolys()->GetMaxCellSize() > 255)
  {
    throw Error("Cannot write " + fileName + ": a polygon has more than 255 corners.");
  }
}

Eigen::Vector3d ShiftedPoint(vtkPolyData* surface, vtkIdType i, const Eigen::Vector3d& globalShift)
{
  Eigen::Vector3d point;
  surface->GetPoint(i, point.data());
  return point - globalShift;
}

bool AreSingle(vtkPolyData* surface, const Eigen::Vector3d& globalShift)
{
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    const Eigen::Vector3d point = ShiftedPoint(surface, i, globalShift);
    if (!IsSingle(point[0]) || !IsSingle(point[1]) || !IsSingle(point[2]))
    {
      return false;
    }
  }
  return true;
}

}

std::string PlyHeader::Text() const
{
  const std::string type = this->isDouble ? "double" : "float";
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment VTK generated PLY File\n";
  for (const std::string& comment : this->comments)
  {
    text += comment.empty() ? "" : "comment " + comment + "\n";
  }
  text += "obj_info vtkPolyData points and polygons: vtk4.0\nelement vertex " +
    std::to_string(this->vertices) + "\n";
  for (const char* axis : { "x", "y", "z" })
  {
    text += "property " + type + " " + axis + "\n";
  }
  for (const char* axis : { "nx", "ny", "nz" })
  {
    text += this->hasNormals ? std::string("property float ") + axis + "\n" : "";
  }
  for (const char* color : { "red", "green", "blue" })
  {
    text += this->isColored ? std::string("property uchar ") + color + "\n" : "";
  }
  return text + "element face " + std::to_string(this->faces) +
    "\nproperty list uchar int vertex_indices\nend_header\n";
}

bool WritePLY(vtkPolyData* surface, const std::string& colors, const std::string& comment,
  const Eigen::Vector3d& globalShift, const std::string& fileName)
{
  CheckCounts(surface, fileName);
  auto* rgb = vtkUnsignedCharArray::SafeDownCast(surface->GetPointData()->GetArray(colors.c_str()));
  vtkDataArray* normals = surface->GetPointData()->GetArray("Normals");
  PlyHeader header;
  header.comments = { comment, GlobalShiftComment(globalShift) };
  const bool areFloats = surface->GetPoints()->GetDataType() == VTK_FLOAT && globalShift.isZero(0);
  header.isDouble = !areFloats && !AreSingle(surface, globalShift);
  header.isColored = rgb && rgb->GetNumberOfComponents() >= 3;
  header.hasNormals = normals && normals->GetNumberOfComponents() == 3;
  header.vertices = surface->GetNumberOfPoints();
  header.faces = surface->GetNumberOfPolys();
  std::ofstream file(fileName, std::ios::binary);
  file << header.Text();
  for (vtkIdType i = 0; i < header.vertices && file; ++i)
  {
    for (double coordinate : ShiftedPoint(surface, i, globalShift))
    {
      header.isDouble ? Put(file, coordinate) : Put(file, static_cast<float>(coordinate));
    }
    for (int axis = 0; axis < 3 && header.hasNormals; ++axis)
    {
      Put(file, static_cast<float>(normals->GetComponent(i, axis)));
    }
    for (int channel = 0; channel < 3 && header.isColored; ++channel)
    {
      Put(file, rgb->GetTypedComponent(i, channel));
    }
  }
  for (vtkIdType face = 0; face < header.faces && file; ++face)
  {
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    surface->GetPolys()->GetCellAtId(face, size, corners);
    Put(file, static_cast<unsigned char>(size));
    for (vtkIdType i = 0; i < size; ++i)
    {
      Put(file, static_cast<std::int32_t>(corners[i]));
    }
  }
  file.close();
  return static_cast<bool>(file);
}

}
