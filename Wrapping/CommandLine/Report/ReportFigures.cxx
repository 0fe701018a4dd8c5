// SPDX-License-Identifier: BSD-3-Clause
#include "Report/ReportFigures.h"

#include "Data/ViewBlocks.h"
#include "Files/FileNames.h"
#include "Files/PathChecks.h"
#include "Scene/Scene.h"
#include "Session/Session.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkFeatureOverlayWriter.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkSurfacePicture.h>
#include <vtkUnsignedCharArray.h>
#include <vtkViewDependentTextureMapper.h>

#include <algorithm>
#include <filesystem>

namespace freespace
{

namespace
{

namespace fs = std::filesystem;

constexpr int widestInPage = 900;  // of a figure, pixels
constexpr int widestInViews = 640; // of a view's image

// Some of the views whose image files exist, evenly chosen.
vtkSmartPointer<vtkMultiBlockDataSet> PickViews(
  const Scene& scene, vtkMultiBlockDataSet* features, int most)
{
  std::vector<unsigned int> there;
  const std::vector<View> views = ViewsFromBlocks(features);
  for (unsigned int i = 0; i < views.size(); ++i)
  {
    if (IsThere(scene.ImagePath(views[i].imageFile)))
    {
      there.push_back(i);
    }
  }
  const std::size_t count = std::min<std::size_t>(there.size(), most);
  auto picked = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (std::size_t i = 0; i < count; ++i)
  {
    const unsigned int from = there[i * there.size() / count];
    SetNamedBlock(picked, static_cast<unsigned int>(i), views[from].name,
      vtkPolyData::SafeDownCast(features->GetBlock(from)));
  }
  return picked;
}

// So that dark features stand out from the dark background.
double Lightened(double color)
{
  return 90 + color * 165 / 255;
}

vtkSmartPointer<vtkPolyData> Cloud(vtkMultiBlockDataSet* features)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> vertices;
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("RGB");
  colors->SetNumberOfComponents(3);
  for (unsigned int block = 0; block < features->GetNumberOfBlocks(); ++block)
  {
    auto* view = vtkPolyData::SafeDownCast(features->GetBlock(block));
    vtkDataArray* known = view->GetPointData()->GetArray("RGB");
    const double plain[3] = { 225, 225, 225 };
    for (vtkIdType i = 0; i < view->GetNumberOfPoints(); ++i)
    {
      const vtkIdType id = points->InsertNextPoint(view->GetPoint(i));
      vertices->InsertNextCell(1, &id);
      const double* color = known ? known->GetTuple(i) : plain;
      colors->InsertNextTuple3(Lightened(color[0]), Lightened(color[1]), Lightened(color[2]));
    }
  }
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(points);
  cloud->SetVerts(vertices);
  cloud->GetPointData()->SetScalars(colors);
  return cloud;
}

// What is seen from each camera, as NAMEa.png, NAMEb.png ...
std::vector<ReportPicture> Shoot(Session& session, vtkSurfacePicture* picture,
  const std::vector<Camera>& cameras, const fs::path& folder, const std::string& name,
  const std::string& alt)
{
  std::vector<ReportPicture> pictures;
  for (const Camera& camera : cameras)
  {
    View view;
    view.camera = camera;
    picture->SetViewBlock(BlockFromView(view));
    const std::string letter(1, static_cast<char>('a' + pictures.size()));
    session.Run(picture, name + letter);
    const std::string file = (folder / (name + letter + ".png")).string();
    picture->WritePNG(file);
    session.ThrowIfFailed();
    pictures.push_back({ InlinePictureFromFile(file, widestInPage),
      alt + (pictures.empty() ? "" : ", from another viewpoint") });
  }
  return pictures;
}

}

std::vector<ReportView> FeatureFigures(Session& session, const Scene& scene,
  vtkMultiBlockDataSet* features, const std::string& folder, int most)
{
  const auto picked = PickViews(scene, features, most);
  vtkNew<vtkFeatureOverlayWriter> overlay;
  overlay->SetInputDataObject(picked);
  overlay->SetImagesFolder(scene.ImagesFolder());
  overlay->SetOutputFolder(folder);
  session.Write(overlay);
  std::vector<ReportView> figures;
  const std::vector<View> views = ViewsFromBlocks(picked);
  std::vector<std::string> names;
  for (const View& view : views)
  {
    names.push_back(view.name);
  }
  names = FileNamesOf(names); // as the overlay's writer has them
  for (const View& view : views)
  {
    const std::string photograph = scene.ImagePath(view.imageFile);
    const std::string drawn = (fs::path(folder) / (names[figures.size()] + ".png")).string();
    const std::string count = FormatCount(static_cast<long long>(view.points.size()));
    const int widest = figures.empty() ? widestInPage : widestInViews; // the first is shown large
    figures.push_back({ view.name, count + " features over " + view.imageFile,
      { InlinePictureFromFile(photograph, widest), "The image " + view.imageFile },
      { InlinePictureFromFile(drawn, widest),
        count + " features over " + view.imageFile + ", blue far and red near" } });
  }
  return figures;
}

std::vector<ReportPicture> CloudFigures(Session& session, vtkMultiBlockDataSet* features,
  const std::vector<Camera>& cameras, const std::string& folder)
{
  vtkNew<vtkPolyDataMapper> mapper;
  vtkNew<vtkSurfacePicture> picture;
  picture->SetInputDataObject(Cloud(features));
  picture->SetMapper(mapper);
  picture->SetSamples(1); // a feature is a pixel
  picture->SetBackground(0.07, 0.08, 0.1);
  return Shoot(session, picture, cameras, folder, "features",
    FormatCount(features->GetNumberOfPoints()) + " features as points in space");
}

std::vector<ReportPicture> SurfaceFigures(Session& session, vtkPolyData* surface,
  const std::vector<Camera>& cameras, const std::string& folder)
{
  vtkNew<vtkSurfacePicture> picture;
  picture->SetInputDataObject(surface);
  return Shoot(session, picture, cameras, folder, "surface", "The surface in grey");
}

std::vector<ReportPicture> TexturedFigures(Session& session, vtkPolyData* surface,
  vtkMultiBlockDataSet* photographs, const std::vector<Camera>& cameras, const std::string& folder)
{
  vtkNew<vtkViewDependentTextureMapper> mapper;
  mapper->SetPhotographs(photographs);
  vtkNew<vtkSurfacePicture> picture;
  picture->SetInputDataObject(surface);
  picture->SetMapper(mapper);
  picture->SetSamples(1); // the mapper samples edges by itself
  return Shoot(
    session, picture, cameras, folder, "textured", "The surface in the colours of the images");
}

}
