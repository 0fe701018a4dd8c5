// SPDX-License-Identifier: BSD-3-Clause
#include "vtkEdgeStereoReader.h"

#include "ClusterOptions.h"
#include "Blocks/ImageBlocks.h"
#include "Common/Error.h"
#include "Data/ViewBlocks.h"
#include "Data/ViewInput.h"
#include "Execution/AlgorithmErrors.h"
#include "Execution/AlgorithmProgress.h"
#include "Execution/SMPParallelFor.h"
#include "Agreement/CheckedScene.h"
#include "Agreement/SceneFeatures.h"
#include "Refinement/CameraRefinement.h"
#include "Scene/EveryImage.h"
#include "Silhouettes/SilhouetteMaps.h"
#include "Stereo/EdgeStereo.h"
#include "vtkClusterProposal.h"

#include <vtkErrorCode.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <opencv2/core/utility.hpp>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <set>
#include <sstream>

vtkStandardNewMacro(vtkEdgeStereoReader);

namespace
{

// OpenCV's own threads would compete with ours, which already work on a cluster each.
class SingleThreadedOpenCV
{
public:
  SingleThreadedOpenCV() { cv::setNumThreads(1); }
  ~SingleThreadedOpenCV() { cv::setNumThreads(this->Before); }
  SingleThreadedOpenCV(const SingleThreadedOpenCV&) = delete;
  void operator=(const SingleThreadedOpenCV&) = delete;

private:
  int Before = cv::getNumThreads();
};

// Up to this number of images, a view of every image takes little time; with more, the references see enough.
constexpr std::size_t FewImages = 15;

std::size_t NumberOfImages(const std::vector<freespace::Cluster>& clusters)
{
  std::set<std::string> images;
  for (const freespace::Cluster& cluster : clusters)
  {
    for (const auto& triplet : cluster.triplets)
    {
      images.insert(triplet.begin(), triplet.end());
    }
  }
  return images.size();
}

// The files that the features are computed from, beside the scene.json.
std::vector<std::string> FilesOf(const freespace::Scene& scene)
{
  std::set<std::string> files;
  std::error_code error;
  if (scene.pixels)
  {
    return {};
  }
  for (const auto& entry : std::filesystem::directory_iterator(scene.ModelFolder(), error))
  {
    files.insert(entry.path().string());
  }
  for (const freespace::Cluster& cluster : scene.clusters)
  {
    for (const auto& triplet : cluster.triplets)
    {
      for (const std::string& image : triplet)
      {
        files.insert(scene.ImagePath(image));
        files.insert(scene.MaskPath(image));
      }
    }
  }
  return { files.begin(), files.end() };
}

// Changes when one of the files is written, created or removed.
long long TimeOfFiles(const std::string& scene, const std::vector<std::string>& others)
{
  std::uint64_t time = 0;
  const auto add = [&time](const std::string& file)
  {
    std::error_code error;
    const auto written = std::filesystem::last_write_time(file, error);
    time = 31 * time + (error ? 0 : static_cast<std::uint64_t>(written.time_since_epoch().count()));
  };
  add(scene);
  std::for_each(others.begin(), others.end(), add);
  return static_cast<long long>(time);
}

// The cameras of the scene's images, refined by its edges if requested; and a line about it.
std::vector<freespace::CalibratedImage> CamerasOf(const freespace::CheckedScene& checked,
  freespace::EdgeStore& edges, const freespace::MatcherOptions& matching, int mode,
  const freespace::ParallelFor& parallelFor, const freespace::Progress& progress,
  std::string& summary)
{
  constexpr std::size_t small = 200; // images
  const freespace::SparseModel& model = checked.model;
  const bool isWanted = mode == vtkEdgeStereoReader::REFINE_ALWAYS ||
    (mode == vtkEdgeStereoReader::REFINE_SMALL_SCENES && model.images.size() <= small);
  if (!isWanted)
  {
    summary = "as given" +
      (mode == vtkEdgeStereoReader::REFINE_NEVER
          ? std::string()
          : ", because there are more than " + std::to_string(small) + " images");
    return freespace::CalibratedImages(model);
  }
  const freespace::CameraRefinement refined = freespace::RefineCameras(checked.given, model, edges,
    matching, freespace::CameraRefinementOptions(), parallelFor, progress, checked.tracks);
  std::ostringstream line;
  line.precision(2);
  if (refined.isRefined)
  {
    line << "refined by the edges, which lie " << refined.residuals.residualAfter
         << " pixels from where the cameras expect them in the median, "
         << refined.residuals.residualBefore << " before";
  }
  else
  {
    line << "as given, they fit the edges";
  }
  summary = line.str();
  return refined.images;
}

// What the reader works on.
struct Input
{
  freespace::Scene scene;
  freespace::SparseModel model;
};

Input InMemory(freespace::MemoryScene memory)
{
  return { std::move(memory.scene), std::move(memory.model) };
}

Input InFile(const std::string& fileName, std::string& imageSummary)
{
  freespace::Scene scene = freespace::ReadScene(fileName);
  freespace::SparseModel model = freespace::ReadSceneModel(scene, &imageSummary);
  return { std::move(scene), std::move(model) };
}

// The views' blocks, then those of the silhouettes.
void FillBlocks(const std::vector<freespace::EdgeView>& views,
  const std::vector<freespace::DisparityMap>& silhouettes, vtkMultiBlockDataSet* output)
{
  const auto append = [output](const std::string& name, vtkPolyData* block)
  { freespace::SetNamedBlock(output, output->GetNumberOfBlocks(), name, block); };
  for (const freespace::EdgeView& view : views)
  {
    append(view.name, freespace::BlockFromEdgeView(view));
  }
  for (const freespace::DisparityMap& map : silhouettes)
  {
    append(map.name, freespace::BlockFromMap(map));
  }
}

}

vtkEdgeStereoReader::vtkEdgeStereoReader()
{
  this->SetNumberOfInputPorts(1);
  const freespace::EdgeStereoOptions options;
  this->Smoothing = options.edges.smoothing;
  this->LowContrast = options.edges.lowContrast;
  this->HighContrast = options.edges.highContrast;
  this->Tolerance = options.matching.tolerance;
  this->MinimumAngle = options.matching.minimumAngle;
  this->ColorTolerance = options.matching.colorTolerance;
  this->MinimumRun = options.matching.minimumRun;
  this->Patches = options.patches.isOn;
}

vtkEdgeStereoReader::~vtkEdgeStereoReader() = default;

int vtkEdgeStereoReader::FillInputPortInformation(int, vtkInformation* info)
{
  freespace::AcceptViews(info);
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

void vtkEdgeStereoReader::AddTriplet(const std::string& cluster, const std::string& first,
  const std::string& reference, const std::string& last)
{
  this->Triplets.push_back({ cluster, first, reference, last });
  this->Modified();
}

void vtkEdgeStereoReader::RemoveAllTriplets()
{
  this->Triplets.clear();
  this->Modified();
}

int vtkEdgeStereoReader::GetNumberOfTriplets()
{
  return static_cast<int>(this->Triplets.size());
}

vtkCxxSetSmartPointerMacro(vtkEdgeStereoReader, ClusterProposal, vtkClusterProposal);

vtkClusterProposal* vtkEdgeStereoReader::GetClusterProposal()
{
  return this->ClusterProposal;
}

vtkMTimeType vtkEdgeStereoReader::GetMTime()
{
  const long long time = TimeOfFiles(this->FileName, this->FilesRead);
  if (time != this->FilesTime)
  {
    this->FilesTime = time;
    this->FilesChanged.Modified();
  }
  const vtkMTimeType proposal = this->ClusterProposal ? this->ClusterProposal->GetMTime() : 0;
  return std::max({ this->Superclass::GetMTime(), this->FilesChanged.GetMTime(), proposal });
}

freespace::EdgeStereoOptions vtkEdgeStereoReader::StereoOptions() const
{
  if (this->MinimumDepth < 0 || this->MaximumDepth < 0)
  {
    throw freespace::Error("The depths that edge stereo searches cannot be negative.");
  }
  freespace::EdgeStereoOptions options;
  options.edges.smoothing = this->Smoothing;
  options.edges.lowContrast = this->LowContrast;
  options.edges.highContrast = this->HighContrast;
  options.matching.tolerance = this->Tolerance;
  options.matching.minimumAngle = this->MinimumAngle;
  options.matching.colorTolerance = this->ColorTolerance;
  options.matching.minimumRun = this->MinimumRun;
  options.patches.isOn = this->Patches;
  if (this->MinimumDepth > 0)
  {
    options.matching.maximumDisparity = 1 / this->MinimumDepth;
  }
  if (this->MaximumDepth > 0)
  {
    options.matching.minimumDisparity = 1 / this->MaximumDepth;
  }
  options.Check();
  return options;
}

// The scene of the connected images.
freespace::MemoryScene vtkEdgeStereoReader::SceneOf(vtkInformationVector* images) const
{
  if (!this->FileName.empty())
  {
    throw freespace::Error("Images are connected, and there is the scene " + this->FileName + ".");
  }
  std::vector<freespace::Cluster> clusters;
  for (const auto& [name, first, reference, last] : this->Triplets)
  {
    auto cluster = std::find_if(clusters.begin(), clusters.end(),
      [&name = name](const freespace::Cluster& known) { return known.name == name; });
    if (cluster == clusters.end())
    {
      cluster = clusters.insert(clusters.end(), freespace::Cluster{ name, reference, {} });
    }
    cluster->triplets.push_back({ first, reference, last });
  }
  return { freespace::ImagesFromBlocks(freespace::ViewsOf(images)), std::move(clusters) };
}

// And says so.
bool vtkEdgeStereoReader::IsEveryImageAView(std::size_t images)
{
  const bool isIt =
    this->EveryImage == ALWAYS || (this->EveryImage == IN_SMALL_SCENES && images <= FewImages);
  this->ViewSummary =
    isIt ? "every image of a cluster is one" : "the reference of each cluster is one";
  if (this->EveryImage == IN_SMALL_SCENES)
  {
    this->ViewSummary += ", because the clusters have " + std::to_string(images) + " images, " +
      (isIt ? "no more than " : "more than ") + std::to_string(FewImages);
  }
  return isIt;
}

int vtkEdgeStereoReader::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputVector);
  this->FilesRead.clear();
  this->ClusterSummary.clear();
  this->ImageSummary.clear();
  this->CameraSummary.clear();
  this->ViewSummary.clear();
  this->FilesTime = TimeOfFiles(this->FileName, this->FilesRead);
  this->SetErrorCode(vtkErrorCode::NoError);
  const bool isInMemory = inputVector[0]->GetNumberOfInformationObjects() > 0;
  try
  {
    const freespace::EdgeStereoOptions options = this->StereoOptions();
    if (!isInMemory && !this->Triplets.empty())
    {
      throw freespace::Error("There are triplets, but no images are connected.");
    }
    Input input = isInMemory ? InMemory(this->SceneOf(inputVector[0]))
                             : InFile(this->FileName, this->ImageSummary);
    const freespace::Scene& given = input.scene;
    if (this->MaskIsFree && given.masks.empty())
    {
      throw freespace::Error("Masks are asked to show free space, but the scene " + given.file +
        (given.file.empty() ? "in memory" : "") + " has none.");
    }
    const SingleThreadedOpenCV guard;
    freespace::EdgeStore edges(given, options.edges);
    const freespace::Progress progress = freespace::AlgorithmProgress(this);
    const freespace::ParallelFor parallelFor(freespace::SMPParallelFor, this->Shared);
    freespace::CheckedScene checked =
      freespace::CheckScene(given, std::move(input.model), edges, options.matching,
        this->ClusterProposal ? freespace::ClusterOptionsOf(this->ClusterProposal)
                              : freespace::ClusterProposalOptions(),
        this->CheckImages, parallelFor, progress.Part(0, 0.2));
    freespace::Scene& scene = checked.scene;
    this->ClusterSummary = checked.choice;
    this->FilesRead = FilesOf(scene);
    this->FilesTime = TimeOfFiles(this->FileName, this->FilesRead);
    const std::size_t needed = scene.clusters.size();
    if (this->IsEveryImageAView(NumberOfImages(scene.clusters)))
    {
      const auto others = freespace::ClustersOfEveryImage(scene.clusters);
      scene.clusters.insert(scene.clusters.end(), others.begin(), others.end());
    }
    const std::vector<freespace::CalibratedImage> images =
      CamerasOf(checked, edges, options.matching, this->RefineCameras, parallelFor,
        progress.Part(0.2, 0.6), this->CameraSummary);
    const std::vector<freespace::EdgeView> views = freespace::FindSceneFeatures(scene, images,
      edges, needed, options, parallelFor, progress.Part(0.6, 0.95), checked.warnings);
    const std::vector<freespace::DisparityMap> silhouettes = this->MaskIsFree
      ? freespace::SilhouetteMaps(scene, images, views, parallelFor, progress.Part(0.95, 1))
      : std::vector<freespace::DisparityMap>();
    for (const std::string& warning : checked.warnings)
    {
      vtkWarningMacro(<< warning);
    }
    FillBlocks(views, silhouettes, output);
  }
  catch (...)
  {
    if (!isInMemory)
    {
      this->SetErrorCode(freespace::ErrorCodeOf(this->FileName));
    }
    return freespace::AfterException(this);
  }
  return 1;
}

void vtkEdgeStereoReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
  os << indent << "NumberOfTriplets: " << this->Triplets.size() << "\n";
  os << indent << "MinimumDepth: " << this->MinimumDepth << "\n";
  os << indent << "MaximumDepth: " << this->MaximumDepth << "\n";
  os << indent << "Smoothing: " << this->Smoothing << "\n";
  os << indent << "LowContrast: " << this->LowContrast << "\n";
  os << indent << "HighContrast: " << this->HighContrast << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "MinimumAngle: " << this->MinimumAngle << "\n";
  os << indent << "ColorTolerance: " << this->ColorTolerance << "\n";
  os << indent << "MinimumRun: " << this->MinimumRun << "\n";
  os << indent << "Patches: " << this->Patches << "\n";
  os << indent << "EveryImage: " << this->EveryImage << "\n";
  os << indent << "RefineCameras: " << this->RefineCameras << "\n";
  os << indent << "MaskIsFree: " << this->MaskIsFree << "\n";
  os << indent << "CheckImages: " << this->CheckImages << "\n";
  os << indent << "ClusterProposal: " << this->ClusterProposal.Get() << "\n";
  os << indent << "ImageSummary: " << this->ImageSummary << "\n";
  os << indent << "ClusterSummary: " << this->ClusterSummary << "\n";
}
