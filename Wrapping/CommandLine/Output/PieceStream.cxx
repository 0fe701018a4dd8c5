// SPDX-License-Identifier: BSD-3-Clause
#include "Output/PieceStream.h"

#include "Common/Error.h"
#include "Files/GlobalShift.h"
#include "PlyWriter.h"

#include <vtkCellArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <filesystem>

namespace freespace
{

namespace
{

constexpr auto binary = std::ios::binary | std::ios::in | std::ios::out | std::ios::trunc;

template <typename Value>
void Put(std::ostream& file, const Value& value)
{
  file.write(reinterpret_cast<const char*>(&value), sizeof value);
}

template <typename Value>
void Get(std::istream& file, Value& value)
{
  file.read(reinterpret_cast<char*>(&value), sizeof value);
}

}

PieceStream::PieceStream(const std::string& fileName)
  : Name(fileName)
  , Target(fileName)
  , PointFile(this->Target.Path() + ".points", binary)
  , TriangleFile(this->Target.Path() + ".triangles", binary)
{
  this->Check(this->PointFile && this->TriangleFile);
}

void PieceStream::Check(bool isGood) const
{
  if (!isGood)
  {
    throw this->Target.Failure();
  }
}

void PieceStream::Add(vtkPolyData* piece)
{
  vtkUnsignedCharArray* ghosts = piece->GetPointGhostArray();
  std::vector<std::int32_t> place(piece->GetNumberOfPoints());
  for (vtkIdType i = 0; i < piece->GetNumberOfPoints(); ++i)
  {
    Position position;
    piece->GetPoint(i, position.data());
    if (ghosts && (ghosts->GetValue(i) & vtkDataSetAttributes::DUPLICATEPOINT))
    {
      const auto next = static_cast<std::int32_t>(this->Shared.size());
      place[i] = -1 - this->Shared.emplace(position, next).first->second;
      continue;
    }
    if (this->Points == INT32_MAX)
    {
      throw Error("The surface has more than 2^31 vertices, more than a .ply can count: use fewer "
                  "cells.");
    }
    place[i] = static_cast<std::int32_t>(this->Points++);
    this->Box.extend(Eigen::Vector3d(position.data()));
    Put(this->PointFile, position);
  }
  for (vtkIdType t = 0; t < piece->GetNumberOfPolys(); ++t)
  {
    vtkIdType size;
    const vtkIdType* corners;
    piece->GetPolys()->GetCellAtId(t, size, corners);
    Put(this->TriangleFile,
      std::array<std::int32_t, 3>{ place[corners[0]], place[corners[1]], place[corners[2]] });
  }
  this->Triangles += piece->GetNumberOfPolys();
  this->Check(this->PointFile && this->TriangleFile);
}

/// The shared points' places among all: each is its own piece's.
void PieceStream::FindShared()
{
  this->SharedPlace.assign(this->Shared.size(), 0);
  this->PointFile.seekg(0);
  for (std::int64_t i = 0; i < this->Points && !this->Shared.empty(); ++i)
  {
    Position position;
    Get(this->PointFile, position);
    const auto shared = this->Shared.find(position);
    if (shared != this->Shared.end())
    {
      this->SharedPlace[shared->second] = static_cast<std::int32_t>(i);
    }
  }
}

void PieceStream::Finish(const std::string& comment, const Eigen::Vector3d& globalShift)
{
  if (this->Triangles == 0)
  {
    throw Error("Cannot write " + this->Name + ": the surface is empty.");
  }
  this->FindShared();
  this->WriteWhole(this->Target.Path(), comment, globalShift);
  this->PointFile.close();
  this->TriangleFile.close();
  std::filesystem::remove(this->Target.Path() + ".points");
  std::filesystem::remove(this->Target.Path() + ".triangles");
  this->Target.Commit();
}

/// Whether single precision keeps all coordinates.
bool PieceStream::AreSingle(const Eigen::Vector3d& globalShift)
{
  this->PointFile.seekg(0);
  bool areSingle = true;
  for (std::int64_t i = 0; i < this->Points && areSingle; ++i)
  {
    Position position;
    Get(this->PointFile, position);
    for (int axis = 0; axis < 3; ++axis)
    {
      areSingle = areSingle && IsSingle(position[axis] - globalShift[axis]);
    }
  }
  return areSingle;
}

/// Like WritePLY.
void PieceStream::WriteWhole(
  const std::string& fileName, const std::string& comment, const Eigen::Vector3d& globalShift)
{
  std::ofstream file(fileName, std::ios::binary);
  PlyHeader header;
  header.comments = { comment, GlobalShiftComment(globalShift) };
  header.isDouble = !this->AreSingle(globalShift);
  header.vertices = this->Points;
  header.faces = this->Triangles;
  file << header.Text();
  this->PointFile.seekg(0);
  for (std::int64_t i = 0; i < this->Points && file; ++i)
  {
    Position position;
    Get(this->PointFile, position);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double coordinate = position[axis] - globalShift[axis];
      header.isDouble ? Put(file, coordinate) : Put(file, static_cast<float>(coordinate));
    }
  }
  this->TriangleFile.seekg(0);
  for (std::int64_t t = 0; t < this->Triangles && file; ++t)
  {
    std::array<std::int32_t, 3> corners;
    Get(this->TriangleFile, corners);
    Put(file, static_cast<unsigned char>(3));
    for (std::int32_t corner : corners)
    {
      Put(file, corner >= 0 ? corner : this->SharedPlace[-1 - corner]);
    }
  }
  file.close();
  this->Check(file && this->PointFile && this->TriangleFile);
}

}
