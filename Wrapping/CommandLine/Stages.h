// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Stages_h
#define freespace_Stages_h

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

/// The stages of a reconstruction: each has the options that its own command and `reconstruct` share,
/// and runs the VTK classes that do it. Run throws Error when a stage fails.

/// scene.json -> features: vtkEdgeStereoReader.
class StereoStage
{
public:
  void AddOptions(CLI::App& command);
  vtkSmartPointer<vtkMultiBlockDataSet> Run(Session& session, const std::string& scene) const;

private:
  double MinimumDepth = 0;
  double MaximumDepth = 0;
  std::string EveryImage = "auto"; // empty: on
};

/// features -> disparity maps: vtkFeatureSupportFilter, vtkDelaunayDisparityFilter.
class TriangulateStage
{
public:
  void AddOptions(CLI::App& command);
  vtkSmartPointer<vtkMultiBlockDataSet> Run(Session& session, vtkMultiBlockDataSet* features) const;

private:
  double SupportRadius = 4;
  int SupportNeighbors = 0;
  double Tolerance = 0.0002;
  int SupportingNeighbors = 2;
  int SeeThroughViews = 0;
  int ViolatingFeatures = 0;
  double LongestEdge = 0;
  double GreatestDepthRatio = 0;
  bool KeepEdges = false;
  std::string Background = "auto";
};

/// disparity maps -> surface: vtkFreespaceUnion, vtkBisectionContourFilter.
class ContourStage
{
public:
  void AddOptions(CLI::App& command);
  vtkSmartPointer<vtkPolyData> Run(Session& session, vtkMultiBlockDataSet* maps) const;

  /// What makes it of the maps.
  vtkSmartPointer<vtkBisectionContourFilter> MakeFilter(vtkMultiBlockDataSet* maps) const;

  /// Writes it to a file a piece at a time where it does not fit into the memory limit, but its pieces do
  /// and the file is a .ply. False, with nothing done, where it fits, or cannot be had like that: then
  /// RunPiece tells why.
  bool Stream(Session& session, vtkBisectionContourFilter* contour, vtkMultiBlockDataSet* maps,
    const std::string& fileName) const;

  /// One of the pieces that Join makes the same surface of.
  vtkSmartPointer<vtkPolyData> RunPiece(
    Session& session, vtkBisectionContourFilter* contour, int piece, int pieces) const;
  vtkSmartPointer<vtkPolyData> Join(
    Session& session, const std::vector<vtkSmartPointer<vtkPolyData>>& pieces) const;

private:
  int Cells = 256;
  double MemoryLimit = -1; // MiB; 0: none; below 0: a share of what the machine has
  double HullMargin = -1;  // below 0: somewhat more than a cell
  int MinimumViews = 1;
  bool NotSharp = false;
  double Simplify = 0.0;
  bool Observed = false;
};

/// Reads a .vtm of features or disparity maps.
vtkSmartPointer<vtkMultiBlockDataSet> ReadViews(Session& session, const std::string& fileName);

/// The same for what 'stereo' or 'sparse' wrote. Throws Error when they are triangulated already.
vtkSmartPointer<vtkMultiBlockDataSet> ReadFeatures(Session& session, const std::string& fileName);

/// The same for what 'triangulate' wrote. Throws Error when there are features but no triangles.
vtkSmartPointer<vtkMultiBlockDataSet> ReadMaps(Session& session, const std::string& fileName);

/// Writes them.
void WriteViews(Session& session, vtkMultiBlockDataSet* views, const std::string& fileName);

/// Reads a surface (.ply .stl .obj .vtp).
vtkSmartPointer<vtkPolyData> ReadSurface(Session& session, const std::string& fileName);

/// Writes a surface; the ending of the file name chooses the format.
void WriteSurface(Session& session, vtkPolyData* surface, const std::string& fileName);

/// Throws Error when a file's folder cannot be written: before hours of work, not after.
void CheckOutputFolder(const std::string& fileName);

/// The same, and unless the ending of a surface's file name is known.
void CheckSurfaceName(const std::string& fileName);

}

#endif
