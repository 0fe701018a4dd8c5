// SPDX-License-Identifier: BSD-3-Clause
#include "Report/StageCache.h"

#include "Output/SurfaceFiles.h"
#include "Output/ViewFiles.h"
#include "Report/Page/ShellCommand.h"
#include "Report/Page/StageRecord.h"
#include "Scene/Scene.h"
#include "Session/GivenOptions.h"
#include "Session/Session.h"

#include <chrono>
#include <filesystem>
#include <functional>

namespace freespace
{

namespace
{

namespace fs = std::filesystem;

const char* const stereoGroup = "Stereo";
const char* const modelGroup = "Structure-from-motion model";
const char* const mapsGroup = "Disparity maps";
const char* const surfaceGroup = "Surface";

// What the features depend on: a model, or the scene, its cameras and its images.
std::vector<std::string> SourcesOf(const Scene& scene)
{
  if (FeatureStage::IsModel(scene.file))
  {
    return { scene.file };
  }
  std::vector<std::string> sources = { scene.file, scene.ModelFolder() };
  for (const Cluster& cluster : scene.clusters)
  {
    for (const auto& triplet : cluster.triplets)
    {
      for (const std::string& image : triplet)
      {
        sources.push_back(scene.ImagePath(image));
      }
    }
  }
  if (scene.clusters.empty())
  {
    sources.push_back(scene.ImagesFolder());
  }
  return sources;
}

/// One stage of a run: what it is called, made from and with, and where its result lies.
struct Step
{
  std::string name;
  std::vector<std::string> options;
  std::string output;
  std::vector<std::string> inputs;
  bool isGiven = false;
};

// Reads an existing result, or computes and records it.
StageTime TakeUpOrMake(Session& session, StageRecord& record, Step step, bool fresh,
  const std::function<void()>& read, const std::function<void()>& make)
{
  if (step.isGiven)
  {
    return { step.name, 0, "given", {} };
  }
  step.options.insert(step.options.end(), step.inputs.begin(), step.inputs.end());
  step.options.push_back("freespace " FREESPACE_VERSION);
  if (!fresh && record.IsCurrent(step.name, step.options, step.output, step.inputs))
  {
    session.Log("take up " + step.output);
    read();
    return { step.name, record.Seconds(step.name), "in an earlier run",
      record.ChoicesOf(step.name) };
  }
  const auto begin = std::chrono::steady_clock::now();
  session.TakeChoices(); // of earlier stages
  make();
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  const Choices choices = session.TakeChoices();
  record.Set(step.name, step.options, taken.count(), 0, choices);
  return { step.name, taken.count(), "in this run", choices };
}

std::string InFolder(const std::string& given, const std::string& folder, const char* name)
{
  return given.empty() ? (fs::path(folder) / name).string() : given;
}

}

void StageCache::AddOptions(CLI::App& command)
{
  this->Command = &command;
  const auto addFile = [&command](
                         const char* name, std::string& file, const char* help, const char* type)
  { command.add_option(name, file, help)->type_name(type)->group("Take up"); };
  addFile(
    "--features", this->GivenFeatures, "Features to take in place of stereo's", "FEATURES.vtm");
  addFile("--maps", this->GivenMaps, "Disparity maps to take in place of making them", "MAPS.vtm");
  addFile("--mesh", this->GivenSurface, "A surface to take in place of making it", "MESH.ply");
  command
    .add_flag("--fresh", this->Fresh, "Make every stage anew, whatever an earlier run left in DIR")
    ->group("Take up");
  this->Finder.AddOptions(command);
  this->Triangulate.AddOptions(command);
  this->Contour.AddOptions(command);
}

std::string StageCache::FeaturesFile(const std::string& folder) const
{
  return InFolder(this->GivenFeatures, folder, "features.vtm");
}

std::string StageCache::MapsFile(const std::string& folder) const
{
  return InFolder(this->GivenMaps, folder, "maps.vtm");
}

std::string StageCache::SurfaceFile(const std::string& folder) const
{
  return InFolder(this->GivenSurface, folder, "mesh.ply");
}

void StageCache::ReadGiven(Session& session)
{
  if (!this->GivenFeatures.empty())
  {
    this->FoundFeatures = ReadFeatures(session, this->GivenFeatures);
  }
  if (!this->GivenMaps.empty())
  {
    this->FoundMaps = ReadMaps(session, this->GivenMaps);
  }
  if (!this->GivenSurface.empty())
  {
    this->FoundSurface = ReadSurface(session, this->GivenSurface);
  }
}

// Those of the stages that find features, as words.
std::vector<std::string> StageCache::FeatureOptions(bool isModel) const
{
  std::vector<std::string> words = GivenOptions(*this->Command, stereoGroup);
  if (isModel)
  {
    const std::vector<std::string> more = GivenOptions(*this->Command, modelGroup);
    words.insert(words.end(), more.begin(), more.end());
  }
  return words;
}

void StageCache::Run(Session& session, const Scene& scene, const std::string& folder)
{
  StageRecord record((fs::path(folder) / "stages.json").string());
  const std::string features = this->FeaturesFile(folder);
  const std::string maps = this->MapsFile(folder);
  const std::string surface = this->SurfaceFile(folder);
  this->Taken.push_back(TakeUpOrMake(
    session, record,
    { "features", this->FeatureOptions(FeatureStage::IsModel(scene.file)), features,
      SourcesOf(scene), !this->GivenFeatures.empty() },
    this->Fresh, [&]() { this->FoundFeatures = ReadViews(session, features); },
    [&]()
    {
      this->FoundFeatures = this->Finder.Run(session, scene.file);
      WriteViews(session, this->FoundFeatures, features);
    }));
  this->Taken.push_back(TakeUpOrMake(
    session, record,
    { "disparity maps", GivenOptions(*this->Command, mapsGroup), maps, { features },
      !this->GivenMaps.empty() },
    this->Fresh, [&]() { this->FoundMaps = ReadMaps(session, maps); },
    [&]()
    {
      this->FoundMaps = this->Triangulate.Run(session, this->FoundFeatures);
      WriteViews(session, this->FoundMaps, maps);
    }));
  this->Taken.push_back(TakeUpOrMake(
    session, record,
    { "surface", GivenOptions(*this->Command, surfaceGroup), surface, { maps },
      !this->GivenSurface.empty() },
    this->Fresh, [&]() { this->FoundSurface = ReadSurface(session, surface); },
    [&]()
    {
      this->FoundSurface = this->Contour.Run(session, this->FoundMaps);
      WriteSurface(session, this->FoundSurface, surface);
    }));
}

std::string StageCache::StageCommands(const std::string& source, const std::string& folder) const
{
  std::string lines;
  const bool isModel = FeatureStage::IsModel(source);
  if (isModel && !this->DensifyFolder().empty())
  {
    return lines;
  }
  const auto add = [&](const std::string& given, std::vector<std::string> words, const char* group)
  {
    if (given.empty())
    {
      const std::vector<std::string> options = GivenOptions(*this->Command, group);
      words.insert(words.end(), options.begin(), options.end());
      lines += (lines.empty() ? "" : "\n") + ShellCommand(words);
    }
  };
  const std::string features = this->FeaturesFile(folder);
  const std::string maps = this->MapsFile(folder);
  add(this->GivenFeatures, { "freespace", isModel ? "sparse" : "stereo", source, "-o", features },
    isModel ? modelGroup : stereoGroup);
  add(this->GivenMaps, { "freespace", "triangulate", features, "-o", maps }, mapsGroup);
  add(this->GivenSurface, { "freespace", "contour", maps, "-o", this->SurfaceFile(folder) },
    surfaceGroup);
  return lines;
}

std::vector<std::string> StageCache::Options() const
{
  std::vector<std::string> words;
  for (const char* group : { stereoGroup, modelGroup, mapsGroup, surfaceGroup })
  {
    const std::vector<std::string> given = GivenOptions(*this->Command, group);
    words.insert(words.end(), given.begin(), given.end());
  }
  return words;
}

bool StageCache::AreAllMade() const
{
  return this->GivenFeatures.empty() && this->GivenMaps.empty() && this->GivenSurface.empty();
}

}
