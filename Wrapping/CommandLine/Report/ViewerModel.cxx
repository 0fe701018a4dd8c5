// SPDX-License-Identifier: BSD-3-Clause
#include "Report/ViewerModel.h"

#include "Common/Error.h"
#include "Report/Page/DataUri.h"
#include "Session/Session.h"
#include "Viewpoints/LookAt.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkJPEGWriter.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkQuadricDecimation.h>
#include <vtkTextureBaker.h>
#include <vtkUnsignedCharArray.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace freespace
{

namespace
{

constexpr vtkIdType mostFeatures = 60000;
constexpr int largestTexture = 2048; // every WebGL 2 has this

/// Coordinates in the box of the surface, as fractions of 65535.
struct Box
{
  Eigen::Vector3d origin;
  Eigen::Vector3d size;

  bool Contains(const Eigen::Vector3d& point) const
  {
    return ((point - origin).array() >= 0).all() && ((point - origin - size).array() <= 0).all();
  }
  void Append(const Eigen::Vector3d& point, std::vector<std::uint16_t>& values) const
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const double share = (point[axis] - origin[axis]) / size[axis];
      values.push_back(
        static_cast<std::uint16_t>(std::lround(65535 * std::clamp(share, 0.0, 1.0))));
    }
  }
};

Box BoxOf(vtkPolyData* surface)
{
  const double* bounds = surface->GetBounds();
  const Eigen::Vector3d low(bounds[0], bounds[2], bounds[4]);
  const Eigen::Vector3d high(bounds[1], bounds[3], bounds[5]);
  return { low, (high - low).cwiseMax(1e-9 * (high - low).norm() + 1e-300) };
}

vtkSmartPointer<vtkPolyData> Simplify(Session& session, vtkPolyData* surface, int mostTriangles)
{
  if (surface->GetNumberOfPolys() <= mostTriangles)
  {
    return surface;
  }
  vtkNew<vtkQuadricDecimation> decimation;
  decimation->SetInputDataObject(surface);
  decimation->SetTargetReduction(1 - double(mostTriangles) / surface->GetNumberOfPolys());
  session.Run(decimation, "simplify");
  return decimation->GetOutput();
}

std::string TextureUri(Session& session, vtkImageData* texture)
{
  vtkNew<vtkJPEGWriter> writer;
  writer->SetInputDataObject(texture);
  writer->SetQuality(85);
  writer->WriteToMemoryOn();
  writer->Write();
  session.ThrowIfFailed();
  vtkUnsignedCharArray* jpeg = writer->GetResult();
  return "data:image/jpeg;base64," +
    Base64(jpeg->GetPointer(0), static_cast<std::size_t>(jpeg->GetNumberOfValues()));
}

void AddSurface(vtkPolyData* surface, const Box& box, nlohmann::json& model)
{
  std::vector<std::uint16_t> points;
  std::vector<std::uint16_t> texels;
  vtkDataArray* coordinates = surface->GetPointData()->GetTCoords();
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    box.Append(Eigen::Vector3d(surface->GetPoint(i)), points);
    for (int axis = 0; axis < 2; ++axis)
    {
      const double at = std::clamp(coordinates->GetComponent(i, axis), 0.0, 1.0);
      texels.push_back(static_cast<std::uint16_t>(std::lround(65535 * at)));
    }
  }
  std::vector<std::uint32_t> triangles;
  vtkIdType size = 0;
  const vtkIdType* ids = nullptr;
  vtkCellArray* cells = surface->GetPolys();
  for (cells->InitTraversal(); cells->GetNextCell(size, ids);)
  {
    for (vtkIdType corner = 1; corner + 1 < size; ++corner)
    {
      for (const vtkIdType id : { ids[0], ids[corner], ids[corner + 1] })
      {
        triangles.push_back(static_cast<std::uint32_t>(id));
      }
    }
  }
  model["points"] = Base64(points);
  model["texels"] = Base64(texels);
  model["triangles"] = Base64(triangles);
}

void AddFeatures(vtkMultiBlockDataSet* features, const Box& box, nlohmann::json& model)
{
  const vtkIdType step = features->GetNumberOfPoints() / mostFeatures + 1;
  std::vector<std::uint16_t> points;
  std::vector<std::uint8_t> colors;
  for (unsigned int block = 0; block < features->GetNumberOfBlocks(); ++block)
  {
    auto* view = vtkPolyData::SafeDownCast(features->GetBlock(block));
    vtkDataArray* known = view->GetPointData()->GetArray("RGB");
    for (vtkIdType i = 0; i < view->GetNumberOfPoints(); i += step)
    {
      const Eigen::Vector3d point(view->GetPoint(i));
      if (box.Contains(point))
      {
        box.Append(point, points);
        for (int channel = 0; channel < 3; ++channel)
        {
          colors.push_back(
            known ? static_cast<std::uint8_t>(known->GetComponent(i, channel)) : 200);
        }
      }
    }
  }
  model["features"] = Base64(points);
  model["featureColors"] = Base64(colors);
}

// Each camera a pyramid of eight lines, a tenth as deep as it is far from the middle.
void AddCameras(
  const std::vector<ViewerCameras>& groups, const Eigen::Vector3d& middle, nlohmann::json& model)
{
  std::vector<double> lines;
  std::vector<int> colors;
  const auto add = [&](const Eigen::Vector3d& point, const std::array<std::uint8_t, 3>& color)
  {
    lines.insert(lines.end(), point.data(), point.data() + 3);
    colors.insert(colors.end(), color.begin(), color.end());
  };
  for (const ViewerCameras& group : groups)
  {
    for (const Camera& camera : group.cameras)
    {
      const double depth = 0.1 * (camera.Center() - middle).norm();
      const double w = camera.width;
      const double h = camera.height;
      const Eigen::Vector2d corners[4] = { { 0, 0 }, { w, 0 }, { w, h }, { 0, h } };
      for (int i = 0; i < 4; ++i)
      {
        const Eigen::Vector3d corner = camera.Unproject(corners[i], depth);
        add(camera.Center(), group.color);
        add(corner, group.color);
        add(corner, group.color);
        add(camera.Unproject(corners[(i + 1) % 4], depth), group.color);
      }
    }
  }
  model["cameras"] = lines;
  model["cameraColors"] = colors;
}

std::array<double, 3> Numbers(const Eigen::Vector3d& vector)
{
  return { vector.x(), vector.y(), vector.z() };
}

}

ViewerModel MakeViewerModel(Session& session, vtkPolyData* surface,
  vtkMultiBlockDataSet* photographs, vtkMultiBlockDataSet* features,
  const std::vector<ViewerCameras>& cameras, const Camera& first, const Eigen::Vector3d& middle,
  int mostTriangles)
{
  const auto small = Simplify(session, surface, mostTriangles);
  vtkNew<vtkTextureBaker> baker;
  baker->SetInputDataObject(small);
  baker->SetPhotographs(photographs);
  baker->SetLargestTexture(largestTexture);
  session.Run(baker, "texture");
  vtkPolyData* textured = baker->GetOutput();
  const Box box = BoxOf(textured);
  nlohmann::json model;
  AddSurface(textured, box, model);
  AddFeatures(features, box, model);
  AddCameras(cameras, middle, model);
  model["texture"] = TextureUri(session, baker->GetTexture());
  model["origin"] = Numbers(box.origin);
  model["size"] = Numbers(box.size);
  model["middle"] = Numbers(box.origin + box.size / 2);
  model["radius"] = box.size.norm() / 2;
  model["position"] = Numbers(first.Center());
  model["target"] = Numbers(middle);
  model["up"] = Numbers(-first.R.row(1));
  model["tangent"] = 0.5 * first.height / first.K(1, 1);
  return { model.dump(), static_cast<long long>(textured->GetNumberOfPolys()) };
}

}
