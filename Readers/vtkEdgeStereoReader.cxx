// SPDX-License-Identifier: BSD-3-Clause
#include "vtkEdgeStereoReader.h"

#include "AlgorithmProgress.h"
#include "EdgeStereo.h"
#include "ProposeClusters.h"
#include "SMPParallelFor.h"
#include "ViewBlocks.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <opencv2/core/utility.hpp>

#include <algorithm>
#include <exception>
#include <filesystem>

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

// As many clusters at a time as there are threads: this bounds the memory and lets the calling
// thread report progress in between. The first cluster in the scene's order that fails decides the
// error.
std::vector<freespace::EdgeView> FindAllFeatures(const freespace::Scene& scene,
  const freespace::EdgeStereoOptions& options, const freespace::Progress& progress)
{
  const std::vector<freespace::CalibratedImage> images = freespace::ReadSceneImages(scene);
  const SingleThreadedOpenCV guard;
  const std::size_t count = scene.clusters.size();
  const std::size_t batch =
    static_cast<std::size_t>(std::max(1, vtkSMPTools::GetEstimatedNumberOfThreads()));
  std::vector<freespace::EdgeView> views(count);
  for (std::size_t first = 0; first < count; first += batch)
  {
    progress(static_cast<double>(first) / count);
    const std::size_t size = std::min(batch, count - first);
    std::vector<std::exception_ptr> errors(size);
    freespace::SMPParallelFor(size,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          try
          {
            views[first + i] =
              freespace::FindFeatures(scene, images, scene.clusters[first + i], options);
          }
          catch (...)
          {
            errors[i] = std::current_exception();
          }
        }
      });
    for (const std::exception_ptr& error : errors)
    {
      if (error)
      {
        std::rethrow_exception(error);
      }
    }
  }
  progress(1.0);
  return views;
}

}

vtkEdgeStereoReader::vtkEdgeStereoReader()
{
  this->SetNumberOfInputPorts(0);
}

vtkMTimeType vtkEdgeStereoReader::GetMTime()
{
  std::error_code error;
  const auto time = std::filesystem::last_write_time(this->FileName, error);
  const long long ticks = error ? 0 : static_cast<long long>(time.time_since_epoch().count());
  if (ticks != this->FileTime)
  {
    this->FileTime = ticks;
    this->FileChanged.Modified();
  }
  return std::max(this->Superclass::GetMTime(), this->FileChanged.GetMTime());
}

int vtkEdgeStereoReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputVector);
  try
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
    if (this->MinimumDepth > 0)
    {
      options.matching.maximumDisparity = 1 / this->MinimumDepth;
    }
    if (this->MaximumDepth > 0)
    {
      options.matching.minimumDisparity = 1 / this->MaximumDepth;
    }
    options.Check();
    const freespace::Scene scene = freespace::ReadSceneWithClusters(this->FileName);
    const std::vector<freespace::EdgeView> views =
      FindAllFeatures(scene, options, freespace::AlgorithmProgress(this));
    for (std::size_t i = 0; i < views.size(); ++i)
    {
      freespace::SetNamedBlock(output, static_cast<unsigned int>(i), views[i].name,
        freespace::BlockFromEdgeView(views[i]));
    }
  }
  catch (...)
  {
    return freespace::AfterException(this, output);
  }
  return 1;
}

void vtkEdgeStereoReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
  os << indent << "MinimumDepth: " << this->MinimumDepth << "\n";
  os << indent << "MaximumDepth: " << this->MaximumDepth << "\n";
  os << indent << "Smoothing: " << this->Smoothing << "\n";
  os << indent << "LowContrast: " << this->LowContrast << "\n";
  os << indent << "HighContrast: " << this->HighContrast << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "MinimumAngle: " << this->MinimumAngle << "\n";
  os << indent << "ColorTolerance: " << this->ColorTolerance << "\n";
  os << indent << "MinimumRun: " << this->MinimumRun << "\n";
}
