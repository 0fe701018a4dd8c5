// SPDX-License-Identifier: BSD-3-Clause
// A flight over a landscape: many views, each of which sees a small part. The environment variable
// FREESPACE_LARGE_VIEWS sets their number; a thousand make ten million observations.
#include "Support/PlainSettings.h"
#include "vtkBisectionContourFilter.h"
#include "vtkDelaunayDisparityFilter.h"
#include "vtkFreespaceUnion.h"
#include "vtkSparseModelReader.h"

#include "Common/ParseNumber.h"
#include "SparseModel/ColmapModel.h"
#include "Support/TemporaryFolder.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <random>

#include <sys/resource.h>

using namespace freespace;

namespace
{

constexpr double cameraDistance = 1.0; // between neighbours
constexpr double flightHeight = 4.0;

double TerrainHeight(double x, double y)
{
  return 0.3 * std::sin(0.9 * x) * std::cos(0.7 * y) + 0.1 * std::sin(3 * x + 2 * y);
}

int NumberOfViews()
{
  const char* variable = std::getenv("FREESPACE_LARGE_VIEWS");
  return freespace::ParseNumber<int>(variable ? variable : "100").value();
}

// Views from above on a square lattice. About ten thousand points are seen by each, and each point by
// about seven views.
SparseModel MakeFlight(int views)
{
  SparseModel model;
  model.cameras.push_back({ 1, LensModel::Pinhole, 4000, 4000, { 6000, 6000, 2000, 2000 } });
  const int columns = static_cast<int>(std::ceil(std::sqrt(views)));
  for (int i = 0; i < views; ++i)
  {
    SparseImage& image = model.images.emplace_back();
    image.id = static_cast<std::uint32_t>(i);
    image.name = std::to_string(i) + ".jpg";
    image.camera = 1;
    image.rotation = { 0, 1, 0, 0 }; // looks down
    // x_cam = (x, -y, -z) + t
    image.translation = { -cameraDistance * (i % columns), cameraDistance * (i / columns),
      flightHeight };
  }
  const std::vector<CalibratedImage> images = CalibratedImages(model);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-1, columns * cameraDistance);
  const int points = 1450 * columns * columns;
  for (int k = 0; k < points; ++k)
  {
    SparsePoint point;
    const double x = place(random), y = place(random);
    point.id = static_cast<std::uint64_t>(k);
    point.position = { x, y, TerrainHeight(x, y) };
    const int column = static_cast<int>(std::lround(x)), row = static_cast<int>(std::lround(y));
    for (int r = row - 2; r <= row + 2; ++r)
    {
      for (int c = column - 2; c <= column + 2; ++c)
      {
        const int i = r * columns + c;
        if (r < 0 || c < 0 || c >= columns || i >= views)
        {
          continue;
        }
        const Eigen::Vector2d pixel = images[i].camera.Project(point.position);
        if (images[i].camera.Sees(pixel))
        {
          SparseImage& image = model.images[i];
          point.track.push_back(
            { image.id, static_cast<std::uint32_t>(image.observations.size()) });
          image.observations.push_back({ pixel, point.id });
        }
      }
    }
    model.points.push_back(std::move(point));
  }
  return model;
}

double PeakMegabytes()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024.0;
}

// Tells how far the test is, with time and memory.
class Log
{
public:
  void operator()(const std::string& what) const
  {
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - this->Begin;
    std::cout << what << ": " << time.count() << " s, " << PeakMegabytes() << " MB at most"
              << std::endl;
  }

private:
  std::chrono::steady_clock::time_point Begin = std::chrono::steady_clock::now();
};

}

TEST(LargeModel, WithinEightGigabytesForTenMillionObservations)
{
  const Log log;
  TemporaryFolder folder;
  std::size_t observations = 0;
  {
    const SparseModel model = MakeFlight(NumberOfViews());
    for (const SparseImage& image : model.images)
    {
      observations += image.observations.size();
    }
    WriteColmapModel(model, folder.Path("model"), ColmapFormat::Binary);
  }
  log(std::to_string(observations) + " observations");
  vtkNew<vtkSparseModelReader> reader;
  reader->SetFileName(folder.Path("model"));
  reader->ReleaseDataFlagOn(); // what was used is dropped
  reader->Update();
  ASSERT_EQ(static_cast<int>(reader->GetOutput()->GetNumberOfBlocks()), NumberOfViews());
  log("read");
  vtkNew<vtkDelaunayDisparityFilter> maps;
  maps->SetInputConnection(reader->GetOutputPort());
  maps->SetContinueBackground(false);
  maps->Update();
  ASSERT_EQ(static_cast<int>(maps->GetOutput()->GetNumberOfBlocks()), NumberOfViews());
  log("triangulated");
  vtkNew<vtkFreespaceUnion> phi;
  SetPlain(phi.Get());
  phi->SetMaps(maps->GetOutput());
  phi->Update();
  log("united");
  double outside = 0;
  for (int k = 0; k < 1000; ++k)
  {
    // Above the terrain is free, within it is matter.
    const double x = 0.5 + 0.005 * k, y = 0.5 + 0.004 * k;
    double above[3] = { x, y, TerrainHeight(x, y) + 0.05 };
    double below[3] = { x, y, TerrainHeight(x, y) - 0.05 };
    outside += phi->EvaluateFunction(above) < 0 || phi->EvaluateFunction(below) > 0;
  }
  EXPECT_LE(outside, 10);
  vtkNew<vtkBisectionContourFilter> contour;
  SetPlainContour(contour.Get());
  contour->SetImplicitFunction(phi);
  contour->Update();
  EXPECT_GT(contour->GetOutput()->GetNumberOfCells(), 10000);
  log("contoured");
  // 8 GB for ten million; the rest is what every program takes.
  EXPECT_LT(PeakMegabytes(), 300 + observations * 800e-6);
}
