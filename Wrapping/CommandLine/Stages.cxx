// SPDX-License-Identifier: BSD-3-Clause
#include "Stages.h"

#include "AtomicOutput.h"
#include "Error.h"
#include "FileEnding.h"
#include "PieceStream.h"
#include "NotNegative.h"
#include "Session.h"
#include "SurfaceViewpoint.h"
#include "Viewpoint.h"

#include <vtkAppendPiecesFilter.h>
#include <vtkBisectionContourFilter.h>
#include <vtkDelaunayDisparityFilter.h>
#include <vtkEdgeStereoReader.h>
#include <vtkFeatureSupportFilter.h>
#include <vtkFreespaceUnion.h>
#include <vtkSimplifySurfaceFilter.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSurfaceReader.h>
#include <vtkSurfaceWriter.h>
#include <vtkViewBlocksReader.h>
#include <vtkViewBlocksWriter.h>

#include <sstream>

#include <unistd.h>

namespace freespace
{

namespace
{

// What the surface in a .ply of 2^31 vertices would take as one, in MiB.
constexpr double LargestPly = 150000;

// What no cell of a lattice exceeds, in MiB: five triangles.
constexpr double WorstCell = 5 * 60.0 / (1024 * 1024);

// Three quarters of the machine's memory, in MiB.
double ShareOfMemory()
{
  const double pages = static_cast<double>(sysconf(_SC_PHYS_PAGES));
  return 0.75 * pages * sysconf(_SC_PAGESIZE) / (1024 * 1024);
}

vtkIdType CountTriangles(vtkMultiBlockDataSet* views)
{
  vtkIdType triangles = 0;
  for (unsigned int i = 0; i < views->GetNumberOfBlocks(); ++i)
  {
    auto* view = vtkPolyData::SafeDownCast(views->GetBlock(i));
    triangles += view ? view->GetNumberOfPolys() : 0;
  }
  return triangles;
}

// Whether features are points of a structure-from-motion model rather than of edges.
bool AreIsolated(vtkMultiBlockDataSet* features)
{
  for (unsigned int i = 0; i < features->GetNumberOfBlocks(); ++i)
  {
    auto* view = vtkPolyData::SafeDownCast(features->GetBlock(i));
    if (!view || !view->GetPointData()->HasArray("PointId"))
    {
      return false;
    }
  }
  return true;
}

}

void StereoStage::AddOptions(CLI::App& command)
{
  command
    .add_option("--min-depth", this->MinimumDepth, "Nearest depth to search; 0: from the cameras")
    ->check(NotNegative())
    ->capture_default_str()
    ->group("Stereo");
  command
    .add_option("--max-depth", this->MaximumDepth, "Farthest depth to search; 0: from the cameras")
    ->check(NotNegative())
    ->capture_default_str()
    ->group("Stereo");
  command
    .add_option("--every-image", this->EveryImage,
      "Every image of a cluster is a view (on), which sees more and takes about eight times as "
      "long, "
      "or its middle one alone (off); auto is off but in small scenes that name no clusters")
    ->check(CLI::IsMember({ "auto", "on", "off" }))
    ->expected(0, 1)
    ->default_str("auto")
    ->group("Stereo");
}

vtkSmartPointer<vtkMultiBlockDataSet> StereoStage::Run(
  Session& session, const std::string& scene) const
{
  if (this->MaximumDepth > 0 && this->MinimumDepth >= this->MaximumDepth)
  {
    std::ostringstream fault;
    fault << "The nearest depth, --min-depth " << this->MinimumDepth
          << ", must be less than the farthest, --max-depth " << this->MaximumDepth << ".";
    throw Error(fault.str());
  }
  vtkNew<vtkEdgeStereoReader> stereo;
  stereo->SetFileName(scene);
  stereo->SetMinimumDepth(this->MinimumDepth);
  stereo->SetMaximumDepth(this->MaximumDepth);
  using Reader = vtkEdgeStereoReader;
  stereo->SetEveryImage(this->EveryImage == "auto" ? Reader::WHERE_NONE_WAS_CHOSEN
      : this->EveryImage == "off"                  ? Reader::NEVER
                                                   : Reader::ALWAYS);
  session.Run(stereo, "stereo");
  vtkSmartPointer<vtkMultiBlockDataSet> features = stereo->GetOutput();
  session.Tell("stereo: " + std::to_string(features->GetNumberOfBlocks()) + " views, " +
    std::to_string(features->GetNumberOfPoints()) + " features");
  return features;
}

void TriangulateStage::AddOptions(CLI::App& command)
{
  command.add_option("--support-radius", this->SupportRadius, "Neighbourhood of a feature, pixels")
    ->check(Positive())
    ->capture_default_str()
    ->group("Disparity maps");
  command
    .add_option("--support", this->SupportNeighbors,
      "Neighbours that must agree with a feature for it to count; 0 keeps all")
    ->check(NotNegative())
    ->capture_default_str()
    ->group("Disparity maps");
  command
    .add_option("--tolerance", this->Tolerance,
      "How far another view's feature may stick out of the free space, fraction of its depth")
    ->check(NotNegative())
    ->capture_default_str()
    ->group("Disparity maps");
  command
    .add_option("--neighbors", this->SupportingNeighbors,
      "Of a feature's six nearest ones so many must agree with it, or it is an outlier; 0 keeps "
      "all")
    ->check(CLI::Range(0, 6))
    ->capture_default_str()
    ->group("Disparity maps");
  command
    .add_option("--see-through", this->SeeThroughViews,
      "A feature that so many other views see through is an outlier; 0: none is")
    ->check(CLI::Range(0, 1000))
    ->capture_default_str()
    ->group("Disparity maps");
  command
    .add_option("--violating", this->ViolatingFeatures,
      "A triangle that so many features of other views violate is wrong, and with it the feature "
      "that "
      "it goes back to; 0: none is")
    ->check(CLI::Range(0, 1000))
    ->capture_default_str()
    ->group("Disparity maps");
  command
    .add_option("--longest-edge", this->LongestEdge,
      "Triangles with a longer edge in the image carve nothing, pixels; 0: no limit")
    ->check(NotNegative())
    ->capture_default_str()
    ->group("Disparity maps");
  command
    .add_option("--depth-ratio", this->GreatestDepthRatio,
      "Triangles over a greater ratio of depths carve nothing; 0: no limit")
    ->check(NotNegative())
    ->capture_default_str()
    ->group("Disparity maps");
  command
    .add_flag("--keep-edges", this->KeepEdges, "No triangle crosses an edge that the stereo saw")
    ->group("Disparity maps");
  command
    .add_option("--background", this->Background,
      "Continue the background behind occluding edges: on, off, or auto, which is off for the "
      "isolated points of a structure-from-motion model")
    ->check(CLI::IsMember({ "auto", "on", "off" }))
    ->capture_default_str()
    ->group("Disparity maps");
}

vtkSmartPointer<vtkMultiBlockDataSet> TriangulateStage::Run(
  Session& session, vtkMultiBlockDataSet* features) const
{
  vtkNew<vtkFeatureSupportFilter> support;
  support->SetInputDataObject(features);
  support->SetRadius(this->SupportRadius);
  support->SetMinimumNeighbors(this->SupportNeighbors);
  session.Run(support, "support");
  vtkNew<vtkDelaunayDisparityFilter> maps;
  maps->SetInputConnection(support->GetOutputPort());
  maps->SetTolerance(this->Tolerance);
  maps->SetSupportingNeighbors(this->SupportingNeighbors);
  maps->SetSeeThroughViews(this->SeeThroughViews);
  maps->SetViolatingFeatures(this->ViolatingFeatures);
  maps->SetLongestEdge(this->LongestEdge);
  maps->SetGreatestDepthRatio(this->GreatestDepthRatio);
  maps->SetKeepEdges(this->KeepEdges);
  maps->SetContinueBackground(
    this->Background == "on" || (this->Background == "auto" && !AreIsolated(features)));
  session.Run(maps, "triangulate");
  vtkSmartPointer<vtkMultiBlockDataSet> result = maps->GetOutput();
  session.Tell("triangulate: " + std::to_string(result->GetNumberOfPoints()) + " points, " +
    std::to_string(result->GetNumberOfCells()) + " triangles");
  return result;
}

void ContourStage::AddOptions(CLI::App& command)
{
  command.add_option("--cells", this->Cells, "Lattice cells along the longest side")
    ->check(CLI::Range(1, 65536))
    ->capture_default_str()
    ->group("Surface");
  command
    .add_option("--memory-limit", this->MemoryLimit,
      "Memory that the surface and its making may take, MiB; 0: no limit; otherwise three quarters "
      "of what the machine has")
    ->check(NotNegative())
    ->group("Surface");
  command
    .add_option("--hull-margin", this->HullMargin,
      "How far the hull of the features is pushed out, fraction of its diagonal; 0 is the paper; "
      "otherwise somewhat more than a lattice cell")
    ->check(CLI::Range(0.0, 10.0))
    ->group("Surface");
  command
    .add_option("--min-views", this->MinimumViews, "Views that must agree that a point is free")
    ->check(Positive())
    ->capture_default_str()
    ->group("Surface");
  command
    .add_flag("--no-sharp", this->NotSharp,
      "Do not rebuild sharp edges and corners between the lattice's vertices")
    ->group("Surface");
  command
    .add_option("--simplify", this->Simplify,
      "Leave out vertices where the surface is flat; it moves by this length at most; 0: none")
    ->check(NotNegative())
    ->capture_default_str()
    ->group("Surface");
  command
    .add_flag("--observed", this->Observed,
      "Keep only what was seen: an open surface without the hull and silhouette walls")
    ->group("Surface");
}

vtkSmartPointer<vtkPolyData> ContourStage::Run(Session& session, vtkMultiBlockDataSet* maps) const
{
  const auto surface =
    this->Join(session, { this->RunPiece(session, this->MakeFilter(maps), 0, 1) });
  AddViewpoint(maps, surface);
  return surface;
}

vtkSmartPointer<vtkBisectionContourFilter> ContourStage::MakeFilter(
  vtkMultiBlockDataSet* maps) const
{
  vtkNew<vtkFreespaceUnion> phi;
  phi->SetMaps(maps);
  // A floor on the hull has to be thick enough for the lattice to see it, and no thicker.
  constexpr double cells = 1.25;
  phi->SetHullMargin(this->HullMargin < 0 ? cells / this->Cells : this->HullMargin);
  phi->SetMinimumViews(this->MinimumViews);
  auto contour = vtkSmartPointer<vtkBisectionContourFilter>::New();
  contour->SetImplicitFunction(phi);
  contour->SetCells(this->Cells);
  contour->SetSharpEdges(!this->NotSharp);
  contour->SetMemoryLimit(this->MemoryLimit < 0 ? ShareOfMemory() : this->MemoryLimit);
  return contour;
}

vtkSmartPointer<vtkPolyData> ContourStage::RunPiece(
  Session& session, vtkBisectionContourFilter* contour, int piece, int pieces) const
{
  contour->SetObservedOnly(this->Observed && pieces == 1);
  session.Run(contour, "contour", piece, pieces);
  return contour->GetOutput();
}

bool ContourStage::Stream(Session& session, vtkBisectionContourFilter* contour,
  vtkMultiBlockDataSet* maps, const std::string& fileName) const
{
  const double limit = contour->GetMemoryLimit();
  // Most lattices are too small to have such a surface.
  const double worst = std::pow(this->Cells, 3) * WorstCell;
  if (limit == 0 || worst <= limit || this->Observed || this->Simplify > 0 ||
    LowerCaseEnding(fileName) != ".ply")
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
  AddViewpoint(maps, nothingButViewpoint);
  stream.Finish(ViewpointComment(nothingButViewpoint));
  session.Tell("contour: " + std::to_string(stream.NumberOfPoints()) + " vertices, " +
    std::to_string(stream.NumberOfTriangles()) + " triangles");
  session.Tell("wrote " + fileName);
  return true;
}

vtkSmartPointer<vtkPolyData> ContourStage::Join(
  Session& session, const std::vector<vtkSmartPointer<vtkPolyData>>& pieces) const
{
  vtkSmartPointer<vtkPolyData> surface = pieces.front();
  if (pieces.size() > 1)
  {
    vtkNew<vtkAppendPiecesFilter> append;
    append->SetObservedOnly(this->Observed);
    for (vtkPolyData* piece : pieces)
    {
      append->AddInputData(piece);
    }
    session.Run(append, "join");
    surface = append->GetOutput();
  }
  session.Tell("contour: " + std::to_string(surface->GetNumberOfPoints()) + " vertices, " +
    std::to_string(surface->GetNumberOfCells()) + " triangles");
  if (this->Simplify > 0)
  {
    vtkNew<vtkSimplifySurfaceFilter> simplify;
    simplify->SetInputData(surface);
    simplify->SetDistance(this->Simplify);
    session.Run(simplify, "simplify");
    surface = simplify->GetOutput();
    session.Tell("simplify: " + std::to_string(surface->GetNumberOfPoints()) + " vertices, " +
      std::to_string(surface->GetNumberOfCells()) + " triangles");
  }
  return surface;
}

vtkSmartPointer<vtkMultiBlockDataSet> ReadViews(Session& session, const std::string& fileName)
{
  vtkNew<vtkViewBlocksReader> reader;
  reader->SetFileName(fileName);
  session.Run(reader, "read");
  return reader->GetOutput();
}

vtkSmartPointer<vtkMultiBlockDataSet> ReadFeatures(Session& session, const std::string& fileName)
{
  vtkSmartPointer<vtkMultiBlockDataSet> features = ReadViews(session, fileName);
  if (CountTriangles(features) > 0)
  {
    throw Error("'" + fileName +
      "' holds disparity maps, which are triangulated already: 'freespace contour' takes them.");
  }
  return features;
}

vtkSmartPointer<vtkMultiBlockDataSet> ReadMaps(Session& session, const std::string& fileName)
{
  vtkSmartPointer<vtkMultiBlockDataSet> maps = ReadViews(session, fileName);
  if (CountTriangles(maps) == 0 && maps->GetNumberOfPoints() > 0)
  {
    throw Error("'" + fileName +
      "' holds features, not disparity maps: run 'freespace triangulate' on it first.");
  }
  return maps;
}

void WriteViews(Session& session, vtkMultiBlockDataSet* views, const std::string& fileName)
{
  vtkNew<vtkViewBlocksWriter> writer;
  writer->SetInputDataObject(views);
  writer->SetFileName(fileName);
  session.Write(writer);
  session.Tell("wrote " + fileName);
}

vtkSmartPointer<vtkPolyData> ReadSurface(Session& session, const std::string& fileName)
{
  vtkNew<vtkSurfaceReader> reader;
  reader->SetFileName(fileName);
  session.Run(reader, "read");
  return reader->GetOutput();
}

void WriteSurface(Session& session, vtkPolyData* surface, const std::string& fileName)
{
  vtkNew<vtkSurfaceWriter> writer;
  writer->SetInputDataObject(surface);
  writer->SetFileName(fileName);
  session.Write(writer);
  session.Tell("wrote " + fileName);
}

void CheckOutputFolder(const std::string& fileName)
{
  const AtomicOutput probe(fileName);
}

void CheckSurfaceName(const std::string& fileName)
{
  CheckOutputFolder(fileName);
  if (!vtkSurfaceWriter::CanWriteFile(fileName))
  {
    throw Error(
      "Cannot write '" + fileName + "': a surface's file name ends in .ply, .stl, .obj or .vtp.");
  }
}

}
