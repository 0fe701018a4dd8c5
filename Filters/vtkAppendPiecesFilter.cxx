// SPDX-License-Identifier: BSD-3-Clause
#include "vtkAppendPiecesFilter.h"

#include "Data/ObservedTriangles.h"
#include "Execution/AlgorithmErrors.h"
#include "Execution/AlgorithmProgress.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataSetAttributes.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

vtkStandardNewMacro(vtkAppendPiecesFilter);

namespace
{

using Position = std::array<double, 3>;

Position PositionOf(vtkPolyData* piece, vtkIdType point)
{
  Position position;
  piece->GetPoint(point, position.data());
  return position;
}

class Assembly
{
public:
  explicit Assembly(const std::vector<vtkPolyData*>& pieces)
    : Pieces(pieces)
  {
  }

  void Run(vtkPolyData* output)
  {
    this->Check();
    this->CollectForeign();
    this->PlacePoints();
    this->WritePoints(output);
    this->WriteTriangles(output);
    this->WriteCellArrays(output);
  }

private:
  void Check()
  {
    for (std::size_t p = 0; p < this->Pieces.size(); ++p)
    {
      vtkPolyData* piece = this->Pieces[p];
      const std::string name = "Piece " + std::to_string(p);
      if (piece->GetNumberOfPoints() > 0 && this->PointType == VTK_VOID)
      {
        this->PointType = piece->GetPoints()->GetDataType();
      }
      if (piece->GetNumberOfPoints() > 0 && piece->GetPoints()->GetDataType() != this->PointType)
      {
        throw freespace::Error(name + " has points of another precision than the first.");
      }
      if (piece->GetNumberOfCells() != piece->GetNumberOfPolys() ||
        piece->GetPolys()->IsHomogeneous() % 3 != 0) // 0 when there are none
      {
        throw freespace::Error(name + " has cells that are not triangles.");
      }
      this->CheckNotGivenBefore(p, name);
      this->Triangles += piece->GetNumberOfPolys();
    }
    if (3 * this->Triangles > INT32_MAX)
    {
      throw freespace::Error("The surface has more than 2^31 corners, use fewer cells.");
    }
  }

  // Two pieces are the same where they have as many points and triangles and the same first triangle.
  void CheckNotGivenBefore(std::size_t p, const std::string& name)
  {
    vtkPolyData* piece = this->Pieces[p];
    if (piece->GetNumberOfPolys() == 0)
    {
      return;
    }
    vtkIdType size;
    const vtkIdType* ids;
    piece->GetPolys()->GetCellAtId(0, size, ids);
    Beginning beginning{ piece->GetNumberOfPoints(), piece->GetNumberOfPolys(), {} };
    for (int i = 0; i < 3; ++i)
    {
      std::get<2>(beginning)[i] = PositionOf(piece, ids[i]);
    }
    const auto [before, isNew] = this->Beginnings.emplace(beginning, p);
    if (!isNew)
    {
      throw freespace::Error(
        name + " is given twice: it is the same as piece " + std::to_string(before->second) + ".");
    }
  }

  static bool IsForeign(vtkUnsignedCharArray* ghosts, vtkIdType point)
  {
    return ghosts && (ghosts->GetValue(point) & vtkDataSetAttributes::DUPLICATEPOINT);
  }

  void CollectForeign()
  {
    for (vtkPolyData* piece : this->Pieces)
    {
      vtkUnsignedCharArray* ghosts = piece->GetPointGhostArray();
      for (vtkIdType i = 0; ghosts && i < piece->GetNumberOfPoints(); ++i)
      {
        if (IsForeign(ghosts, i))
        {
          this->Shared[PositionOf(piece, i)] = -1;
        }
      }
    }
  }

  /// The pieces' own points come one piece after the other.
  void PlacePoints()
  {
    for (vtkPolyData* piece : this->Pieces)
    {
      vtkUnsignedCharArray* ghosts = piece->GetPointGhostArray();
      for (vtkIdType i = 0; i < piece->GetNumberOfPoints(); ++i)
      {
        if (IsForeign(ghosts, i))
        {
          continue;
        }
        if (!this->Shared.empty())
        {
          const auto shared = this->Shared.find(PositionOf(piece, i));
          if (shared != this->Shared.end())
          {
            shared->second = this->Points;
          }
        }
        ++this->Points;
      }
    }
    this->OwnPoints = this->Points;
    for (auto& shared : this->Shared)
    {
      if (shared.second < 0)
      {
        shared.second = this->Points++;
      }
    }
  }

  void WritePoints(vtkPolyData* output)
  {
    vtkNew<vtkPoints> points;
    points->SetDataType(this->PointType == VTK_VOID ? VTK_FLOAT : this->PointType);
    points->SetNumberOfPoints(this->Points);
    vtkIdType next = 0;
    for (vtkPolyData* piece : this->Pieces)
    {
      vtkUnsignedCharArray* ghosts = piece->GetPointGhostArray();
      for (vtkIdType i = 0; i < piece->GetNumberOfPoints(); ++i)
      {
        if (!IsForeign(ghosts, i))
        {
          points->SetPoint(next++, PositionOf(piece, i).data());
        }
      }
    }
    for (const auto& [position, place] : this->Shared)
    {
      if (place >= this->OwnPoints)
      {
        points->SetPoint(place, position.data());
      }
    }
    output->SetPoints(points);
  }

  void WriteTriangles(vtkPolyData* output)
  {
    vtkNew<vtkTypeInt32Array> corners, offsets;
    corners->SetNumberOfValues(3 * this->Triangles);
    offsets->SetNumberOfValues(this->Triangles + 1);
    vtkIdType next = 0, firstOwn = 0;
    for (vtkPolyData* piece : this->Pieces)
    {
      const std::vector<vtkIdType> place = this->PlacesOf(piece, firstOwn);
      for (vtkIdType t = 0; t < piece->GetNumberOfPolys(); ++t)
      {
        vtkIdType size;
        const vtkIdType* ids;
        piece->GetPolys()->GetCellAtId(t, size, ids);
        for (int i = 0; i < 3; ++i)
        {
          corners->SetValue(next++, static_cast<vtkTypeInt32>(place[ids[i]]));
        }
      }
    }
    for (vtkIdType t = 0; t <= this->Triangles; ++t)
    {
      offsets->SetValue(t, static_cast<vtkTypeInt32>(3 * t));
    }
    vtkNew<vtkCellArray> cells;
    cells->SetData(offsets, corners);
    output->SetPolys(cells);
  }

  /// Where a piece's points are in the whole; moves on to where the next piece's own ones begin.
  std::vector<vtkIdType> PlacesOf(vtkPolyData* piece, vtkIdType& firstOwn) const
  {
    vtkUnsignedCharArray* ghosts = piece->GetPointGhostArray();
    std::vector<vtkIdType> places(piece->GetNumberOfPoints());
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      const vtkIdType point = static_cast<vtkIdType>(i);
      places[i] = IsForeign(ghosts, point) ? this->Shared.at(PositionOf(piece, point)) : firstOwn++;
    }
    return places;
  }

  /// Those that all pieces with triangles have.
  void WriteCellArrays(vtkPolyData* output)
  {
    std::size_t some = 0;
    while (some + 1 < this->Pieces.size() && this->Pieces[some]->GetNumberOfPolys() == 0)
    {
      ++some;
    }
    vtkCellData* first = this->Pieces[some]->GetCellData();
    for (int a = 0; a < first->GetNumberOfArrays(); ++a)
    {
      vtkDataArray* model = first->GetArray(a);
      if (!model || !model->GetName())
      {
        continue;
      }
      const auto whole = vtkSmartPointer<vtkDataArray>::Take(model->NewInstance());
      whole->SetName(model->GetName());
      whole->SetNumberOfComponents(model->GetNumberOfComponents());
      whole->SetNumberOfTuples(this->Triangles);
      vtkIdType next = 0;
      for (vtkPolyData* piece : this->Pieces)
      {
        vtkDataArray* part = piece->GetCellData()->GetArray(model->GetName());
        const vtkIdType count = piece->GetNumberOfPolys();
        if (part && part->GetNumberOfComponents() == model->GetNumberOfComponents())
        {
          whole->InsertTuples(next, count, 0, part);
          next += count;
        }
      }
      if (next == this->Triangles)
      {
        output->GetCellData()->AddArray(whole);
      }
    }
  }

  const std::vector<vtkPolyData*>& Pieces;
  std::map<Position, vtkIdType> Shared; ///< points in several pieces: their place in the whole
  using Beginning = std::tuple<vtkIdType, vtkIdType, std::array<Position, 3>>;
  std::map<Beginning, std::size_t> Beginnings; ///< of the pieces that have triangles
  int PointType = VTK_VOID;
  vtkIdType Points = 0, OwnPoints = 0, Triangles = 0;
};

}

vtkAppendPiecesFilter::vtkAppendPiecesFilter()
{
  const freespace::TriangleSelection selection;
  this->ObservedOnly = selection.observedOnly;
  this->Crumbs = selection.crumbs;
}

int vtkAppendPiecesFilter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  return 1;
}

int vtkAppendPiecesFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  std::vector<vtkPolyData*> pieces;
  for (int i = 0; i < inputVector[0]->GetNumberOfInformationObjects(); ++i)
  {
    pieces.push_back(vtkPolyData::GetData(inputVector[0], i));
  }
  try
  {
    Assembly(pieces).Run(output);
    if (!pieces.empty())
    {
      output->GetFieldData()->PassData(pieces[0]->GetFieldData());
    }
    this->CrumbTriangles = 0;
    if (!this->Crumbs)
    {
      this->CrumbTriangles = freespace::DropCrumbs(output);
    }
    if (this->ObservedOnly)
    {
      freespace::KeepObserved(output);
    }
  }
  catch (...)
  {
    return freespace::AfterException(this);
  }
  return 1;
}

void vtkAppendPiecesFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Crumbs: " << this->Crumbs << "\n";
  os << indent << "CrumbTriangles: " << this->CrumbTriangles << "\n";
  os << indent << "ObservedOnly: " << this->ObservedOnly << "\n";
}
