// SPDX-License-Identifier: BSD-3-Clause
#include "Stages.h"

#include "Error.h"
#include "Session.h"

#include <vtkBisectionContourFilter.h>
#include <vtkDelaunayDisparityFilter.h>
#include <vtkEdgeStereoReader.h>
#include <vtkFeatureSupportFilter.h>
#include <vtkFreespaceUnion.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSurfaceReader.h>
#include <vtkSurfaceWriter.h>
#include <vtkViewBlocksReader.h>
#include <vtkViewBlocksWriter.h>

namespace freespace
{

namespace
{

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
    ->capture_default_str()
    ->group("Stereo");
  command
    .add_option("--max-depth", this->MaximumDepth, "Farthest depth to search; 0: from the cameras")
    ->capture_default_str()
    ->group("Stereo");
}

vtkSmartPointer<vtkMultiBlockDataSet> StereoStage::Run(
  Session& session, const std::string& scene) const
{
  vtkNew<vtkEdgeStereoReader> stereo;
  stereo->SetFileName(scene);
  stereo->SetMinimumDepth(this->MinimumDepth);
  stereo->SetMaximumDepth(this->MaximumDepth);
  session.Run(stereo, "stereo");
  vtkSmartPointer<vtkMultiBlockDataSet> features = stereo->GetOutput();
  session.Tell("stereo: " + std::to_string(features->GetNumberOfBlocks()) + " views, " +
    std::to_string(features->GetNumberOfPoints()) + " features");
  return features;
}

void TriangulateStage::AddOptions(CLI::App& command)
{
  command.add_option("--support-radius", this->SupportRadius, "Neighbourhood of a feature, pixels")
    ->check(CLI::PositiveNumber)
    ->capture_default_str()
    ->group("Disparity maps");
  command
    .add_option("--support", this->SupportNeighbors,
      "Neighbours that must agree with a feature for it to count; 0 keeps all")
    ->check(CLI::NonNegativeNumber)
    ->capture_default_str()
    ->group("Disparity maps");
  command
    .add_option("--tolerance", this->Tolerance,
      "How far another view's feature may stick out of the free space, fraction of its depth")
    ->check(CLI::NonNegativeNumber)
    ->capture_default_str()
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
    .add_option("--hull-margin", this->HullMargin,
      "How far the hull of the features is pushed out, fraction of its diagonal; 0 is the paper")
    ->check(CLI::NonNegativeNumber)
    ->capture_default_str()
    ->group("Surface");
  command
    .add_option("--min-views", this->MinimumViews, "Views that must agree that a point is free")
    ->check(CLI::PositiveNumber)
    ->capture_default_str()
    ->group("Surface");
  command
    .add_flag("--sharp,!--no-sharp", this->Sharp, "Rebuild sharp edges and corners (default on)")
    ->group("Surface");
  command
    .add_flag("--observed", this->Observed,
      "Keep only what was seen: an open surface without the hull and silhouette walls")
    ->group("Surface");
}

vtkSmartPointer<vtkPolyData> ContourStage::Run(Session& session, vtkMultiBlockDataSet* maps) const
{
  vtkNew<vtkFreespaceUnion> phi;
  phi->SetMaps(maps);
  phi->SetHullMargin(this->HullMargin);
  phi->SetMinimumViews(this->MinimumViews);
  vtkNew<vtkBisectionContourFilter> contour;
  contour->SetImplicitFunction(phi);
  contour->SetCells(this->Cells);
  contour->SetSharpEdges(this->Sharp);
  contour->SetObservedOnly(this->Observed);
  session.Run(contour, "contour");
  vtkSmartPointer<vtkPolyData> surface = contour->GetOutput();
  session.Tell("contour: " + std::to_string(surface->GetNumberOfPoints()) + " vertices, " +
    std::to_string(surface->GetNumberOfCells()) + " triangles");
  return surface;
}

vtkSmartPointer<vtkMultiBlockDataSet> ReadViews(Session& session, const std::string& fileName)
{
  vtkNew<vtkViewBlocksReader> reader;
  reader->SetFileName(fileName);
  session.Run(reader, "read");
  return reader->GetOutput();
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

void CheckSurfaceName(const std::string& fileName)
{
  if (!vtkSurfaceWriter::CanWriteFile(fileName))
  {
    throw Error(
      "Cannot write '" + fileName + "': a surface's file name ends in .ply, .stl, .obj or .vtp.");
  }
}

}
