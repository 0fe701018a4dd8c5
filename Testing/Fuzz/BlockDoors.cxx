// SPDX-License-Identifier: BSD-3-Clause
// Doors of VTK's data: files of views and surfaces, and blocks in memory.
#include "Doors.h"

#include "Common/Error.h"
#include "BlocksFromBytes.h"

#include <vtkBisectionContourFilter.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkDelaunayDisparityFilter.h>
#include <vtkDoubleArray.h>
#include <vtkOutlierFilter.h>
#include <vtkFreespaceUnion.h>
#include <vtkLogger.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSurfaceReader.h>
#include <vtkUnsignedCharArray.h>
#include <vtkViewBlocksReader.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace freespace
{

namespace
{

void CountError(vtkObject*, unsigned long, void* count, void*)
{
  ++*static_cast<int*>(count);
}

// Counts the errors of an object, which VTK would print.
class Errors
{
public:
  explicit Errors(vtkObject* object)
    : Object(object)
  {
    this->Command->SetCallback(CountError);
    this->Command->SetClientData(&this->Count);
    this->Tags[0] = object->AddObserver(vtkCommand::ErrorEvent, this->Command);
    this->Tags[1] = object->AddObserver(vtkCommand::WarningEvent, this->Command);
  }
  ~Errors()
  {
    this->Object->RemoveObserver(this->Tags[0]);
    this->Object->RemoveObserver(this->Tags[1]);
  }
  Errors(const Errors&) = delete;
  Errors& operator=(const Errors&) = delete;

  int Count = 0;

private:
  vtkObject* Object;
  vtkNew<vtkCallbackCommand> Command;
  unsigned long Tags[2] = { 0, 0 };
};

// Updates and throws Error where the algorithm reports one; then the output must be empty.
template <typename Algorithm>
void UpdateOrThrow(Algorithm* algorithm)
{
  const Errors errors(algorithm);
  algorithm->Update();
  if (errors.Count > 0)
  {
    throw Error("VTK's error.");
  }
}

void Query(vtkFreespaceUnion* phi)
{
  const double values[] = { 0.0, 1.0, -1.0, 1e40, std::nan(""), HUGE_VAL };
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> radii;
  for (const double x : values)
  {
    for (const double y : values)
    {
      points->InsertNextPoint(x, y, 4.0);
      radii->InsertNextValue(y);
    }
  }
  vtkNew<vtkUnsignedCharArray> free;
  vtkNew<vtkDoubleArray> fractions;
  phi->ArePointsFree(points, free);
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    double at[3];
    points->GetPoint(i, at);
    if (free->GetValue(i) && !(std::isfinite(at[0]) && std::isfinite(at[1])))
    {
      throw std::logic_error("A point that is not finite is free.");
    }
  }
  phi->FirstBlocked(points, points, fractions);
  phi->AreSpheresFree(points, radii, free);
}

void Contour(vtkFreespaceUnion* phi)
{
  vtkNew<vtkBisectionContourFilter> contour;
  contour->SetImplicitFunction(phi);
  contour->SetCells(6);
  UpdateOrThrow(contour.Get());
}

// The stages, on what came in by a door.
void Use(vtkMultiBlockDataSet* blocks)
{
  vtkNew<vtkFreespaceUnion> phi;
  phi->SetMaps(blocks);
  const Errors errors(phi);
  phi->Update();
  Query(phi);
  if (phi->IsValid())
  {
    Contour(phi);
  }
  vtkNew<vtkOutlierFilter> support;
  support->SetInputDataObject(blocks);
  UpdateOrThrow(support.Get());
  vtkNew<vtkDelaunayDisparityFilter> maps;
  maps->SetInputDataObject(blocks);
  UpdateOrThrow(maps.Get());
}

// The .vtm, then files a.vtp, b.vtp ...
void EnterViews(std::string_view bytes)
{
  const std::vector<std::string_view> parts = Parts(bytes);
  PutFile("views.vtm", parts.front());
  for (std::size_t i = 1; i < parts.size() && i <= 4; ++i)
  {
    PutFile(std::string(1, static_cast<char>('a' + i - 1)) + ".vtp", parts[i]);
  }
  vtkNew<vtkViewBlocksReader> reader;
  reader->SetFileName(FuzzFolder() + "/views.vtm");
  UpdateOrThrow(reader.Get());
  Use(reader->GetOutput());
}

void EnterVTP(std::string_view bytes)
{
  PutFile("surface.vtp", bytes);
  vtkNew<vtkSurfaceReader> reader;
  reader->SetFileName(FuzzFolder() + "/surface.vtp");
  UpdateOrThrow(reader.Get());
  vtkPolyData* surface = reader->GetOutput();
  vtkIdType size = 0;
  const vtkIdType* corners = nullptr;
  for (vtkIdType i = 0; i < surface->GetNumberOfCells(); ++i)
  {
    surface->GetCellPoints(i, size, corners);
    for (vtkIdType k = 0; k < size; ++k)
    {
      if (corners[k] < 0 || corners[k] >= surface->GetNumberOfPoints())
      {
        throw std::logic_error("A surface has a corner that is no point of it.");
      }
    }
  }
}

void EnterBlocks(std::string_view bytes)
{
  Use(BlocksFromBytes(bytes));
}

}

std::vector<Door> Doors()
{
  vtkOutputWindow::GetInstance()->SetDisplayModeToNever();
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  return { { "views", EnterViews }, { "vtp", EnterVTP }, { "blocks", EnterBlocks } };
}

}
