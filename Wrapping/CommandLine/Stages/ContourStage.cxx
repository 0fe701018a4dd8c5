// SPDX-License-Identifier: BSD-3-Clause
#include "Stages/ContourStage.h"

#include "Files/FileExtension.h"
#include "Common/ParseNumber.h"
#include "Data/PointNormals.h"
#include "Data/SurfaceViewpoint.h"
#include "Freespace/FreespaceUnion.h"
#include "Output/PieceStream.h"
#include "Output/Viewpoint.h"
#include "Session/NumberValidators.h"
#include "Session/MachineMemory.h"
#include "Session/Session.h"
#include "Stages/ContourPieces.h"

#include <vtkAppendPiecesFilter.h>
#include <vtkBisectionContourFilter.h>
#include <vtkFitSurfaceFilter.h>
#include <vtkFreespaceUnion.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSimplifySurfaceFilter.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace freespace
{

namespace
{

// What the surface in a .ply of 2^31 vertices would take as one, in MiB.
constexpr double LargestPly = 150000;

// What no cell of a lattice exceeds, in MiB: five triangles.
constexpr double WorstCell = 5 * 60.0 / (1024 * 1024);

}

void ContourStage::AddOptions(CLI::App& command)
{
  this->Union.AddTo(command, "Surface");
  command
    .add_option("--cells", this->Cells,
      "Number of lattice cells along the longest side; auto: as many as resolve the features, "
      "within the memory limit")
    ->check(CLI::IsMember({ "auto" }) | WholeNumber(1, 65536))
    ->type_name("auto|INT")
    ->capture_default_str()
    ->group("Surface");
  command
    .add_option("--memory-limit", this->MemoryLimit,
      "Limit of the memory for the surface and its computation, MiB; 0: no limit; default: three "
      "quarters of the memory of the machine")
    ->check(NonNegative())
    ->group("Surface");
  command
    .add_flag("--no-sharp", this->NotSharp,
      "Do not reconstruct sharp edges and corners within lattice cells")
    ->group("Surface");
  command
    .add_flag("--no-fit", this->NotFitted,
      "Keep the vertices on the boundary of the free space: do not smooth the surface and fit it "
      "to "
      "the features of all views")
    ->group("Surface");
  command
    .add_option(
      "--simplify", this->Simplify, "Decimate the surface within this distance; 0: do not")
    ->check(NonNegative())
    ->capture_default_str()
    ->group("Surface");
  command
    .add_option("--crumbs", this->Crumbs,
      "Connected components without supporting features: drop or keep; they are kept if the "
      "surface is written in pieces")
    ->check(CLI::IsMember({ "drop", "keep" }))
    ->capture_default_str()
    ->group("Surface");
  command
    .add_flag(
      "--normals", this->Normals, "Give the vertices normals: .ply, .obj and .vtp have them")
    ->group("Surface");
  command
    .add_flag("--observed", this->Observed,
      "Keep only observed triangles: an open surface without the hull and the silhouette walls, "
      "except where features are close")
    ->group("Surface");
  this->Shift.AddTo(command, "Surface");
}

vtkSmartPointer<vtkPolyData> ContourStage::Run(Session& session, vtkMultiBlockDataSet* maps) const
{
  const auto contour = this->MakeFilter(maps);
  this->Choose(session, contour);
  return this->Make(session, contour, maps);
}

vtkSmartPointer<vtkPolyData> ContourStage::Make(
  Session& session, vtkBisectionContourFilter* contour, vtkMultiBlockDataSet* maps) const
{
  vtkSmartPointer<vtkPolyData> surface;
  if (session.Shared())
  {
    const auto pieces = MakePieces(session, contour);
    surface = session.IsWriter() ? this->Join(session, pieces) : nullptr;
  }
  else
  {
    surface = this->MakeWhole(session, contour);
  }
  if (surface)
  {
    surface = this->Finish(session, maps, surface);
    GiveViewpoint(contour, maps, surface);
  }
  return surface;
}

void ContourStage::GiveViewpoint(
  vtkBisectionContourFilter* contour, vtkMultiBlockDataSet* maps, vtkPolyData* surface)
{
  double bounds[6];
  vtkFreespaceUnion::SafeDownCast(contour->GetImplicitFunction())->GetBounds(bounds);
  AddViewpoint(maps, surface, bounds);
}

vtkSmartPointer<vtkBisectionContourFilter> ContourStage::MakeFilter(
  vtkMultiBlockDataSet* maps) const
{
  vtkNew<vtkFreespaceUnion> phi;
  phi->SetMaps(maps);
  const int cells = ParseNumber<int>(this->Cells).value_or(-1); // auto
  this->Union.SetUp(phi.Get(), cells);
  auto contour = vtkSmartPointer<vtkBisectionContourFilter>::New();
  contour->SetImplicitFunction(phi);
  contour->SetCells(cells);
  contour->SetSharpEdges(!this->NotSharp);
  contour->SetCrumbs(this->Crumbs == "keep");
  contour->SetMemoryLimit(this->MemoryLimit < 0 ? ShareOfMemory() : this->MemoryLimit);
  return contour;
}

void ContourStage::Choose(Session& session, vtkBisectionContourFilter* contour) const
{
  auto* phi = vtkFreespaceUnion::SafeDownCast(contour->GetImplicitFunction());
  session.Watch(phi, "build", [&] { phi->Update(); });
  int cells = 0;
  session.Watch(contour, "lattice", [&] { cells = contour->FindCells(); });
  double b[6];
  phi->GetBounds(b);
  const double longest = std::max({ b[1] - b[0], b[3] - b[2], b[5] - b[4] });
  std::ostringstream side;
  side.precision(3);
  side << longest / cells;
  const std::string lattice = std::to_string(cells) + " cells of " + side.str();
  const int views = phi->FindMinimumViews();
  const std::string votes = std::to_string(views) + (views == 1 ? " view" : " views") +
    (phi->GetMinimumViews() < 0 && views > 1 ? ", or no fewer than contradict them," : "") +
    " to make free";
  const std::string region = RegionOption::Found(phi);
  session.Log(region + "; " + lattice + "; " + votes);
  session.NoteChoice("region", region, "--region");
  session.NoteChoice("lattice", lattice, "--cells");
  session.NoteChoice("free space", votes, "--min-views");
}

void ContourStage::TellCrumbs(Session& session, vtkIdType triangles)
{
  if (triangles > 0)
  {
    session.LogChoice("crumbs",
      std::to_string(triangles) +
        " triangles of components without features are left out; --crumbs keep keeps them",
      "--crumbs");
  }
}

vtkSmartPointer<vtkPolyData> ContourStage::MakeWhole(
  Session& session, vtkBisectionContourFilter* contour) const
{
  contour->SetObservedOnly(this->Observed);
  session.Run(contour, "contour");
  TellCrumbs(session, contour->GetCrumbTriangles());
  return contour->GetOutput();
}

bool ContourStage::Stream(Session& session, vtkBisectionContourFilter* contour,
  vtkMultiBlockDataSet* maps, const std::string& fileName) const
{
  const double limit = contour->GetMemoryLimit();
  // Most lattices are too small to have such a surface.
  const double worst = std::pow(ParseNumber<int>(this->Cells).value_or(0), 3) * WorstCell;
  if (limit == 0 || worst <= limit || this->Observed || this->Normals || this->Simplify > 0 ||
    LowerCaseExtension(fileName) != ".ply")
  {
    return false;
  }
  double needed = 0;
  session.Watch(contour, "estimate", [&] { needed = contour->EstimateMemory(); });
  if (needed <= limit || needed > LargestPly)
  {
    return false;
  }
  // Pieces differ in size.
  const int pieces = static_cast<int>(std::ceil(2 * needed / limit));
  PieceStream stream(fileName);
  for (int piece = 0; piece < pieces; ++piece)
  {
    session.Run(contour,
      "contour, piece " + std::to_string(piece + 1) + " of " + std::to_string(pieces), piece,
      pieces);
    stream.Add(contour->GetOutput());
  }
  vtkNew<vtkPolyData> nothingButViewpoint;
  GiveViewpoint(contour, maps, nothingButViewpoint);
  stream.Finish(ViewpointComment(nothingButViewpoint), this->Shift.For(stream.Bounds()));
  session.Log("contour: " + std::to_string(stream.NumberOfPoints()) + " vertices, " +
    std::to_string(stream.NumberOfTriangles()) + " triangles");
  session.Log("wrote " + fileName);
  return true;
}

vtkSmartPointer<vtkPolyData> ContourStage::Join(
  Session& session, const std::vector<vtkSmartPointer<vtkPolyData>>& pieces) const
{
  vtkNew<vtkAppendPiecesFilter> append;
  append->SetObservedOnly(this->Observed);
  append->SetCrumbs(this->Crumbs == "keep");
  for (vtkPolyData* piece : pieces)
  {
    append->AddInputData(piece);
  }
  session.Run(append, "join");
  TellCrumbs(session, append->GetCrumbTriangles());
  return append->GetOutput();
}

vtkSmartPointer<vtkPolyData> ContourStage::Finish(
  Session& session, vtkMultiBlockDataSet* maps, vtkSmartPointer<vtkPolyData> surface) const
{
  session.Log("contour: " + std::to_string(surface->GetNumberOfPoints()) + " vertices, " +
    std::to_string(surface->GetNumberOfCells()) + " triangles");
  if (!this->NotFitted)
  {
    vtkNew<vtkFitSurfaceFilter> fit;
    fit->SetInputData(0, surface);
    fit->SetInputDataObject(1, maps);
    session.Run(fit, "fit");
    surface = fit->GetOutput();
  }
  if (this->Simplify > 0)
  {
    vtkNew<vtkSimplifySurfaceFilter> simplify;
    simplify->SetInputData(surface);
    simplify->SetDistance(this->Simplify);
    session.Run(simplify, "simplify");
    surface = simplify->GetOutput();
    session.Log("simplify: " + std::to_string(surface->GetNumberOfPoints()) + " vertices, " +
      std::to_string(surface->GetNumberOfCells()) + " triangles");
  }
  if (this->Normals)
  {
    ComputePointNormals(surface);
  }
  return surface;
}

}
