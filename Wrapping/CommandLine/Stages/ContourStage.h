// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ContourStage_h
#define freespace_ContourStage_h

#include "Options/GlobalShiftOption.h"
#include "Options/UnionOptions.h"

#include <CLI/CLI.hpp>

#include <vtkSmartPointer.h>

#include <string>
#include <vector>

class vtkBisectionContourFilter;
class vtkMultiBlockDataSet;
class vtkPolyData;

namespace freespace
{

class Session;

/// disparity maps -> surface: vtkFreespaceUnion, vtkBisectionContourFilter, vtkFitSurfaceFilter.
///
/// Has the options that its own command and `reconstruct` share. Run throws Error when it fails.
class ContourStage
{
public:
  void AddOptions(CLI::App& command);

  /// Null in processes that do not write it.
  vtkSmartPointer<vtkPolyData> Run(Session& session, vtkMultiBlockDataSet* maps) const;

  /// The filters that make it from the maps.
  vtkSmartPointer<vtkBisectionContourFilter> MakeFilter(vtkMultiBlockDataSet* maps) const;

  /// Chooses the region and the lattice, and logs them in a line.
  void Choose(Session& session, vtkBisectionContourFilter* contour) const;

  /// Writes it to a file a piece at a time where it does not fit into the memory limit, but its pieces do
  /// and the file is a .ply. False, with nothing done, where it fits, or cannot be had like that: then
  /// Make tells why.
  bool Stream(Session& session, vtkBisectionContourFilter* contour, vtkMultiBlockDataSet* maps,
    const std::string& fileName) const;

  /// Makes the surface, as Run does once the lattice is chosen.
  vtkSmartPointer<vtkPolyData> Make(
    Session& session, vtkBisectionContourFilter* contour, vtkMultiBlockDataSet* maps) const;

  /// Of the file that the surface is written to.
  const GlobalShiftOption& GlobalShift() const { return this->Shift; }

private:
  vtkSmartPointer<vtkPolyData> MakeWhole(
    Session& session, vtkBisectionContourFilter* contour) const;
  vtkSmartPointer<vtkPolyData> Join(
    Session& session, const std::vector<vtkSmartPointer<vtkPolyData>>& pieces) const;
  vtkSmartPointer<vtkPolyData> Finish(
    Session& session, vtkMultiBlockDataSet* maps, vtkSmartPointer<vtkPolyData> surface) const;

  // Gives the surface a viewpoint (Output/Viewpoint.h), by the features in the region.
  static void GiveViewpoint(
    vtkBisectionContourFilter* contour, vtkMultiBlockDataSet* maps, vtkPolyData* surface);
  static void TellCrumbs(Session& session, vtkIdType triangles);

  UnionOptions Union;
  std::string Cells = "auto";
  double MemoryLimit = -1; // MiB; 0: none; below 0: a share of what the machine has
  bool NotSharp = false;
  bool NotFitted = false;
  double Simplify = 0.0;
  std::string Crumbs = "drop";
  bool Normals = false;
  bool Observed = false;
  GlobalShiftOption Shift;
};

}

#endif
