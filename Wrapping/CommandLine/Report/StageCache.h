// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_StageCache_h
#define freespace_StageCache_h

#include "Session/Choices.h"
#include "Stages/ContourStage.h"
#include "Stages/FeatureStage.h"
#include "Stages/TriangulateStage.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>

#include <string>
#include <vector>

namespace freespace
{

struct Scene;

/// The time of a stage, and whether it was in this run.
struct StageTime
{
  std::string name;
  double seconds = 0;
  std::string when; ///< "in this run", or "in an earlier run", or "given" and of unknown time
  Choices choices;  ///< what the stage chose by itself
};

/// Features, disparity maps and surface of a scene in a folder, computed or reused.
class StageCache
{
public:
  /// The options of the stages, those of reconstruct, and files that take a stage's place.
  void AddOptions(CLI::App& command);

  /// Reads the files that replace a stage, so that faults are reported before hours of work. Throws Error
  /// naming the file.
  void ReadGiven(Session& session);

  /// Computes what is neither given nor in the folder, is older than its inputs, or was made with other
  /// options or by another version. The file of the scene is a scene.json or a model. Throws Error when a stage fails.
  void Run(Session& session, const Scene& scene, const std::string& folder);

  /// The folder of --densify; empty without it.
  const std::string& DensifyFolder() const { return this->Finder.DensifyFolder(); }

  vtkMultiBlockDataSet* Features() const { return this->FoundFeatures; }
  vtkMultiBlockDataSet* Maps() const { return this->FoundMaps; }
  vtkPolyData* Surface() const { return this->FoundSurface; }
  const std::vector<StageTime>& Times() const { return this->Taken; }

  /// Where they lie.
  std::string FeaturesFile(const std::string& folder) const;
  std::string MapsFile(const std::string& folder) const;
  std::string SurfaceFile(const std::string& folder) const;

  /// The commands that make them, a stage at a time, for a shell; empty where a model is densified, which
  /// no single stage does.
  std::string StageCommands(const std::string& source, const std::string& folder) const;

  /// The options of all stages that were given, as words.
  std::vector<std::string> Options() const;

  /// Whether no file takes a stage's place.
  bool AreAllMade() const;

private:
  std::vector<std::string> FeatureOptions(bool isModel) const;

  CLI::App* Command = nullptr;
  FeatureStage Finder;
  TriangulateStage Triangulate;
  ContourStage Contour;
  std::string GivenFeatures;
  std::string GivenMaps;
  std::string GivenSurface;
  bool Fresh = false;

  vtkSmartPointer<vtkMultiBlockDataSet> FoundFeatures;
  vtkSmartPointer<vtkMultiBlockDataSet> FoundMaps;
  vtkSmartPointer<vtkPolyData> FoundSurface;
  std::vector<StageTime> Taken;
};

}

#endif
