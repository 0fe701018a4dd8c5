// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Files/AtomicOutput.h"
#include "Common/Error.h"
#include "Data/SilhouetteBlocks.h"
#include "Data/ViewBlocks.h"
#include "Files/PathChecks.h"
#include "Output/NewFolder.h"
#include "Output/SurfaceFiles.h"
#include "Report/Page/CameraDrawing.h"
#include "Report/Page/ReportPage.h"
#include "Report/Page/ShellCommand.h"
#include "Report/ReportFigures.h"
#include "Report/ReportNumbers.h"
#include "Report/StageCache.h"
#include "Report/ViewerModel.h"
#include "Scene/Scene.h"
#include "Session/GivenOptions.h"
#include "Session/Session.h"
#include "Viewpoints/NovelCameras.h"

#include <vtkNew.h>
#include <vtkPhotographReader.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <utility>

namespace freespace
{

namespace
{

namespace fs = std::filesystem;

constexpr int mostViewsShown = 12;

struct ReportSettings
{
  std::string scene;
  std::string folder;
  std::string truth;
  std::string images;
  int viewerTriangles = 80000;
  StageCache stages;
};

/// What the figures need besides the reconstruction.
struct Surroundings
{
  Scene scene;
  vtkSmartPointer<vtkMultiBlockDataSet> photographs;
  std::vector<View> views;
  std::vector<CameraGroup> groups;
  std::vector<Eigen::Vector3d> features;
  Eigen::Vector3d middle;
  std::vector<Camera> novel;

  std::vector<Camera> References() const
  {
    std::vector<Camera> cameras;
    for (const View& view : this->views)
    {
      cameras.push_back(view.camera);
    }
    return cameras;
  }
};

void AddOptions(CLI::App& command, ReportSettings& settings)
{
  command
    .add_option("scene", settings.scene,
      "A scene.json, or a structure-from-motion model whose images are there")
    ->required()
    ->type_name("SCENE.json|MODEL");
  command
    .add_option(
      "-o,--output", settings.folder, "The folder for the page, index.html, and all results")
    ->required()
    ->type_name("DIR");
  command
    .add_option("--truth", settings.truth,
      "The true surface to compare with; default: truth/surface.ply beside the scene, if it "
      "exists")
    ->type_name("SURFACE.ply")
    ->group("Page");
  command
    .add_option("--viewer-triangles", settings.viewerTriangles,
      "Maximum number of triangles of the page's 3D model")
    ->check(CLI::Range(1000, 400000))
    ->capture_default_str()
    ->group("Page");
  command
    .add_option("--images", settings.images,
      "The folder of a model's images; default: that of --densify, or where the model has them")
    ->check(CLI::ExistingDirectory)
    ->type_name("IMAGES")
    ->group("Page");
  settings.stages.AddOptions(command);
}

// Of a model, with the images that are asked for. Throws Error where none of them is there.
Scene ReadSceneForReport(const ReportSettings& settings)
{
  Scene scene = ReadScene(settings.scene);
  if (!FeatureStage::IsModel(settings.scene))
  {
    if (!settings.images.empty() || !settings.stages.DensifyFolder().empty())
    {
      throw Error("--images and --densify are for a structure-from-motion model, and " +
        settings.scene + " is none.");
    }
    return scene;
  }
  const std::string& asked =
    settings.images.empty() ? settings.stages.DensifyFolder() : settings.images;
  scene.images = fs::absolute(asked.empty() ? scene.ImagesFolder() : asked).string();
  if (PresentImages(scene, ReadSceneImages(scene)).empty())
  {
    throw Error("A report shows the images of " + settings.scene + ", and none of them is in " +
      scene.images + ": --images names their folder.");
  }
  return scene;
}

// The scene of a model becomes a file of the report, for its pictures and for its commands.
Scene WriteSceneOfModel(Scene scene, const std::string& folder)
{
  scene.file = (fs::path(folder) / "scene.json").string();
  WriteScene(scene, scene.file);
  return scene;
}

// The images of a cluster, its reference first.
std::vector<std::string> ImagesOf(const Cluster& cluster)
{
  std::vector<std::string> images = { cluster.reference };
  for (const auto& triplet : cluster.triplets)
  {
    images.push_back(triplet[0]);
    images.push_back(triplet[2]);
  }
  return images;
}

// The cameras by cluster; where the scene names none, those of all images in one group.
std::vector<CameraGroup> CameraGroups(const Scene& scene)
{
  const std::vector<CalibratedImage> images = ReadSceneImages(scene);
  std::map<std::string, Camera> cameras;
  for (const CalibratedImage& image : images)
  {
    cameras[image.file] = image.camera;
  }
  CameraGroup all{ "images", {} };
  for (const CalibratedImage& image : PresentImages(scene, images))
  {
    all.cameras.push_back(image.camera);
  }
  std::vector<CameraGroup> groups;
  for (const Cluster& cluster : scene.clusters)
  {
    CameraGroup group{ cluster.name, {} };
    for (const std::string& image : ImagesOf(cluster))
    {
      group.cameras.push_back(cameras.at(image));
    }
    groups.push_back(group);
  }
  return groups.empty() ? std::vector<CameraGroup>{ all } : groups;
}

Surroundings LookAround(Session& session, const Scene& scene, vtkMultiBlockDataSet* features)
{
  Surroundings around;
  around.scene = scene;
  vtkNew<vtkPhotographReader> reader;
  reader->SetFileName(scene.file);
  session.Run(reader, "images");
  around.photographs = reader->GetOutput();
  around.views = ViewsFromBlocks(WithoutSilhouettes(features));
  for (const View& view : around.views)
  {
    around.features.insert(around.features.end(), view.points.begin(), view.points.end());
  }
  around.groups = CameraGroups(scene);
  around.middle = MedianPoint(around.features);
  around.novel = NovelCameras(around.views, 2);
  if (around.novel.empty())
  {
    throw Error(scene.file + " has no view from which features were found.");
  }
  return around;
}

std::array<std::uint8_t, 3> ViewerColor(std::size_t group, std::size_t count)
{
  std::array<std::uint8_t, 3> color{};
  const double hue = 205 + 360.0 * group / count; // as GroupColor
  for (int channel = 0; channel < 3; ++channel)
  {
    const double turned = (hue - 120 * channel) * M_PI / 180;
    color[channel] = static_cast<std::uint8_t>(std::lround(130 + 90 * std::cos(turned)));
  }
  return color;
}

void AddModel(
  Session& session, const ReportSettings& settings, const Surroundings& around, Report& report)
{
  std::vector<ViewerCameras> cameras;
  for (std::size_t i = 0; i < around.groups.size(); ++i)
  {
    cameras.push_back({ ViewerColor(i, around.groups.size()), around.groups[i].cameras });
  }
  vtkPolyData* surface = settings.stages.Surface();
  const ViewerModel model = MakeViewerModel(session, surface, around.photographs,
    settings.stages.Features(), cameras, around.novel[0], around.middle, settings.viewerTriangles);
  report.model = model.json;
  report.modelCaption = "Drag to turn the surface, turn the wheel or pinch to come nearer, drag "
                        "with Shift or two fingers to move it. ";
  report.modelCaption += model.triangles < surface->GetNumberOfPolys()
    ? "Simplified from " + FormatCount(surface->GetNumberOfPolys()) + " to " +
      FormatCount(model.triangles) + " triangles for this page, with a baked texture."
    : "All " + FormatCount(model.triangles) + " triangles, with a baked texture.";
}

void AddFigures(Session& session, const ReportSettings& settings, const Surroundings& around,
  const std::string& figures, Report& report)
{
  const auto features = WithoutSilhouettes(settings.stages.Features());
  report.views = FeatureFigures(
    session, around.scene, features, (fs::path(figures) / "views").string(), mostViewsShown);
  report.viewsCaption = "Each view's image, and over it the features that were found: edges "
                        "whose depth is known, coloured by it from blue (far) to red (near) "
                        "(figure 8 of the paper).";
  if (report.views.size() < around.views.size())
  {
    report.viewsCaption += " Of " + std::to_string(around.views.size()) + " views " +
      std::to_string(report.views.size()) + " are shown.";
  }
  report.cameras = DrawCameras(around.groups, around.features);
  report.camerasCaption = "The cameras, by cluster; the filled ones are the reference cameras. The "
                          "dots are features (figure 9 of the paper).";
  report.features = CloudFigures(session, features, around.novel, figures);
  report.surface = SurfaceFigures(session, settings.stages.Surface(), around.novel, figures);
  report.textured =
    TexturedFigures(session, settings.stages.Surface(), around.photographs, around.novel, figures);
}

std::string TruthFile(const ReportSettings& settings)
{
  const fs::path beside = fs::path(settings.scene).parent_path() / "truth" / "surface.ply";
  return settings.truth.empty() && IsFile(beside) ? beside.string() : settings.truth;
}

vtkSmartPointer<vtkPolyData> ReadTruth(Session& session, const ReportSettings& settings)
{
  const std::string file = TruthFile(settings);
  return file.empty() ? nullptr : ReadSurface(session, file);
}

void AddTruth(
  const ReportSettings& settings, const Surroundings& around, vtkPolyData* truth, Report& report)
{
  if (truth)
  {
    const TruthFigures figures =
      CompareWithTruth(settings.stages.Surface(), truth, around.References(), around.features);
    report.truth = TruthTable(figures, around.views.size());
    report.facts.push_back({ FormatShare(figures.within[1]), "of rays within 0.2 % of the depth" });
  }
}

std::string Line(std::vector<std::string> words, const std::vector<std::string>& options)
{
  words.insert(words.end(), options.begin(), options.end());
  return ShellCommand(words);
}

std::vector<ReportCommand> Commands(const ReportSettings& settings, const CLI::App& command)
{
  const std::string& scene = settings.scene;
  const std::string& folder = settings.folder;
  const std::string mesh = settings.stages.SurfaceFile(folder);
  const std::vector<std::string> stageOptions = settings.stages.Options();
  std::vector<std::string> all = stageOptions;
  for (const char* group : { "Take up", "Page" })
  {
    const std::vector<std::string> given = GivenOptions(command, group);
    all.insert(all.end(), given.begin(), given.end());
  }
  std::vector<ReportCommand> commands = { { "This page and all that lies beside it:",
    Line({ "freespace", "report", scene, "-o", folder }, all) } };
  if (settings.stages.AreAllMade())
  {
    commands.push_back({ "The surface alone, all stages in one:",
      Line({ "freespace", "reconstruct", scene, "-o", mesh }, stageOptions) });
  }
  const std::string stages = settings.stages.StageCommands(scene, folder);
  if (!stages.empty())
  {
    commands.push_back({ "The same, a stage at a time:", stages });
  }
  const std::string pictured =
    FeatureStage::IsModel(scene) ? (fs::path(folder) / "scene.json").string() : scene;
  commands.push_back({ "A model for other programs, and pictures all around it:",
    Line({ "freespace", "texture", mesh, "--scene", pictured, "-o",
           (fs::path(folder) / "model.glb").string() },
      {}) +
      "\n" +
      Line({ "freespace", "view", pictured, "--mesh", mesh, "--turntable", "36", "-o",
             (fs::path(folder) / "turntable").string() },
        {}) });
  return commands;
}

// The name of a scene: of its file or model, or of the folder above, where that is called as all are: scene.json,
// sparse/0.
std::string TitleOf(const std::string& scene)
{
  fs::path path = fs::absolute(scene).lexically_normal();
  const auto saysNothing = [](const std::string& name)
  {
    return name.empty() || name == "scene" || name == "sparse" ||
      std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isdigit(c); });
  };
  while (saysNothing(path.stem().string()) && path.has_relative_path())
  {
    path = path.parent_path();
  }
  return path.stem().string();
}

void AddNumbers(const ReportSettings& settings, const Surroundings& around, Report& report)
{
  const StageCache& stages = settings.stages;
  const long long triangles = stages.Surface()->GetNumberOfPolys();
  const long long inserted = InsertedFeatures(stages.Maps());
  const long long features = WithoutSilhouettes(stages.Features())->GetNumberOfPoints();
  std::size_t cameras = 0;
  for (const CameraGroup& group : around.groups)
  {
    cameras += group.cameras.size();
  }
  report.title = TitleOf(settings.scene);
  report.summary = FormatCount(features) + " features in " + std::to_string(around.views.size()) +
    " views, and the boundary of the space that they show to be free: a surface of " +
    FormatCount(triangles) + " triangles, in the colours of " +
    FormatCount(static_cast<long long>(cameras)) + " calibrated images.";
  report.facts = { { FormatCount(static_cast<long long>(cameras)), "images" },
    { std::to_string(around.views.size()), "views" }, { FormatCount(features), "features" },
    { FormatCount(inserted), "brought in by the constraint" },
    { FormatCount(triangles), "triangles" } };
  report.numbers = { ViewTable(
                       WithoutSilhouettes(stages.Features()), WithoutSilhouettes(stages.Maps())),
    SurfaceTable(stages.Surface()) };
  const ReportTable choices = ChoiceTable(stages.Times());
  if (!choices.rows.empty())
  {
    report.numbers.push_back(choices);
  }
}

void AddTimes(
  const ReportSettings& settings, double modelSeconds, double figureSeconds, Report& report)
{
  std::vector<StageTime> times = settings.stages.Times();
  double reconstruction = 0;
  bool isKnown = true;
  for (const StageTime& time : times)
  {
    reconstruction += time.seconds;
    isKnown = isKnown && time.when != "given";
  }
  if (isKnown)
  {
    report.facts.push_back({ FormatSeconds(reconstruction), "to reconstruct" });
  }
  times.push_back({ "this page's model", modelSeconds, "in this run", {} });
  times.push_back({ "this page's figures", figureSeconds, "in this run", {} });
  report.numbers.push_back(TimeTable(times));
}

void WritePage(const std::string& page, const std::string& fileName)
{
  AtomicOutput target(fileName);
  target.Write(page.data(), page.size());
  target.Commit();
}

template <typename Work>
double SecondsOf(const Work& work)
{
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void MakeReport(Session& session, ReportSettings& settings, const CLI::App& command)
{
  Scene scene = ReadSceneForReport(settings);
  const std::string file = (fs::path(settings.folder) / "index.html").string();
  const std::string figures = (fs::path(settings.folder) / "figures").string();
  settings.stages.ReadGiven(session);
  const auto truth = ReadTruth(session, settings);
  const NewFolder folder(settings.folder);
  CheckOutputFolder(file);
  settings.stages.Run(session, scene, settings.folder);
  if (FeatureStage::IsModel(scene.file))
  {
    scene = WriteSceneOfModel(std::move(scene), settings.folder);
  }
  const Surroundings around = LookAround(session, scene, settings.stages.Features());
  const NewFolder figuresFolder(figures);
  Report report;
  AddNumbers(settings, around, report);
  const double modelSeconds = SecondsOf([&]() { AddModel(session, settings, around, report); });
  const double figureSeconds =
    SecondsOf([&]() { AddFigures(session, settings, around, figures, report); });
  AddTimes(settings, modelSeconds, figureSeconds, report);
  AddTruth(settings, around, truth, report);
  report.commands = Commands(settings, command);
  report.footer = "Written by freespace " FREESPACE_VERSION ".";
  WritePage(WriteReportPage(report), file);
  session.Log("wrote " + file);
}

}

void AddReportCommand(CLI::App& program, Session& session)
{
  auto settings = std::make_shared<ReportSettings>();
  CLI::App* command = program.add_subcommand(
    "report", "Reconstruct a scene and write a report, one page that needs no network");
  AddOptions(*command, *settings);
  command->footer("What an earlier run left in DIR is taken up where nothing that it was made from "
                  "has changed.\n\nExamples:\n"
                  "  freespace report scene.json -o report\n"
                  "  freespace report scene.json -o report --cells 512 --truth surface.ply");
  command->callback(
    session.Defer([settings, &session, command]() { MakeReport(session, *settings, *command); }));
}

}
