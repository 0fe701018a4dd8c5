// SPDX-License-Identifier: BSD-3-Clause
#ifndef BlockScene_h
#define BlockScene_h

#include "Data/ViewBlocks.h"
#include "Texture/DisparityImage.h"
#include "Texture/Photograph.h"

#include <vtkCompositeDataSet.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <cmath>

/// A red block, 2 wide and 2 high, on a board of 10 x 10 with waves of green and blue, about an
/// offset; and cameras on a circle around it. The colour of each point of the surface is known.
struct BlockScene
{
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();

  freespace::TriangleMesh Mesh() const
  {
    freespace::TriangleMesh mesh;
    AddQuad(mesh, { -5, -5, 0 }, { 10, 0, 0 }, { 0, 10, 0 });
    AddQuad(mesh, { -1, -1, 2 }, { 2, 0, 0 }, { 0, 2, 0 });
    AddQuad(mesh, { -1, -1, 0 }, { 2, 0, 0 }, { 0, 0, 2 });
    AddQuad(mesh, { 1, -1, 0 }, { 0, 2, 0 }, { 0, 0, 2 });
    AddQuad(mesh, { 1, 1, 0 }, { -2, 0, 0 }, { 0, 0, 2 });
    AddQuad(mesh, { -1, 1, 0 }, { 0, -2, 0 }, { 0, 0, 2 });
    return mesh;
  }

  vtkSmartPointer<vtkPolyData> Surface() const
  {
    const freespace::TriangleMesh mesh = this->Mesh();
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const Eigen::Vector3d& point : mesh.points)
    {
      points->InsertNextPoint(point.data());
    }
    auto surface = vtkSmartPointer<vtkPolyData>::New();
    surface->AllocateExact(mesh.triangles.size(), 3 * mesh.triangles.size());
    surface->SetPoints(points);
    for (const auto& triangle : mesh.triangles)
    {
      const vtkIdType ids[3] = { triangle[0], triangle[1], triangle[2] };
      surface->InsertNextCell(VTK_TRIANGLE, 3, ids);
    }
    return surface;
  }

  bool IsOnBlock(const Eigen::Vector3d& point) const
  {
    const Eigen::Vector3d p = point - this->offset;
    return p.z() > 1e-4 * (1 + this->offset.norm() * 1e-3);
  }

  std::array<double, 3> ColorAt(const Eigen::Vector3d& point) const
  {
    const Eigen::Vector3d p = point - this->offset;
    if (this->IsOnBlock(point))
    {
      return { 200 + 30 * std::sin(3 * p.z()), 0, 0 };
    }
    return { 0, 150 + 60 * std::sin(2 * p.x()), 150 + 60 * std::cos(2 * p.y()) };
  }

  freespace::Camera CameraAt(double angle, double radius = 9, double height = 7) const
  {
    freespace::Camera camera;
    camera.width = 240;
    camera.height = 200;
    camera.K << 220, 0, 124, 0, 220, 97, 0, 0, 1;
    const Eigen::Vector3d center(radius * std::cos(angle), radius * std::sin(angle), height);
    const Eigen::Vector3d forward = (Eigen::Vector3d(0, 0, 0.5) - center).normalized();
    const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
    camera.R << right.transpose(), forward.cross(right).transpose(), forward.transpose();
    camera.t = -camera.R * (center + this->offset);
    return camera;
  }

  /// What the camera sees: four samples in each pixel, white beside the board.
  freespace::Photograph Take(const freespace::Camera& camera, const std::string& name) const
  {
    freespace::Camera fine = camera;
    fine.width *= 2;
    fine.height *= 2;
    fine.K.topRows<2>() *= 2;
    const freespace::DisparityImage image = RenderDisparity(this->Mesh(), fine);
    freespace::Photograph photograph;
    photograph.name = name;
    photograph.camera = camera;
    for (int row = 0; row < camera.height; ++row)
    {
      for (int column = 0; column < camera.width; ++column)
      {
        std::array<double, 3> sum = { 0, 0, 0 };
        for (int sample = 0; sample < 4; ++sample)
        {
          const int u = 2 * column + sample % 2;
          const int v = 2 * row + sample / 2;
          const float disparity = image.At(u, v);
          const std::array<double, 3> color = disparity > 0
            ? this->ColorAt(fine.Unproject({ u + 0.5, v + 0.5 }, 1 / disparity))
            : std::array<double, 3>{ 255, 255, 255 };
          for (int channel = 0; channel < 3; ++channel)
          {
            sum[channel] += color[channel] / 4;
          }
        }
        for (const double value : sum)
        {
          photograph.rgb.push_back(static_cast<unsigned char>(std::lround(value)));
        }
      }
    }
    return photograph;
  }

  static vtkSmartPointer<vtkMultiBlockDataSet> Blocks(
    const std::vector<freespace::Photograph>& photographs)
  {
    auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
    for (unsigned int i = 0; i < photographs.size(); ++i)
    {
      const freespace::Photograph& photograph = photographs[i];
      const freespace::Camera& camera = photograph.camera;
      vtkNew<vtkImageData> image;
      image->SetDimensions(camera.width, camera.height, 1);
      image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
      const std::size_t line = std::size_t(3) * camera.width;
      for (int row = 0; row < camera.height; ++row)
      {
        std::copy_n(photograph.rgb.data() + row * line, line,
          static_cast<unsigned char*>(image->GetScalarPointer(0, camera.height - 1 - row, 0)));
      }
      freespace::AddCamera(image, camera, photograph.name);
      blocks->SetBlock(i, image);
      blocks->GetMetaData(i)->Set(vtkCompositeDataSet::NAME(), photograph.name.c_str());
    }
    return blocks;
  }

  /// Images from `count` angles, called p0, p1 and so on.
  vtkSmartPointer<vtkMultiBlockDataSet> Photographs(int count) const
  {
    std::vector<freespace::Photograph> photographs;
    for (int i = 0; i < count; ++i)
    {
      photographs.push_back(
        this->Take(this->CameraAt(2 * M_PI * i / count), "p" + std::to_string(i)));
    }
    return Blocks(photographs);
  }

private:
  void AddQuad(freespace::TriangleMesh& mesh, const Eigen::Vector3d& corner,
    const Eigen::Vector3d& a, const Eigen::Vector3d& b) const
  {
    const int first = static_cast<int>(mesh.points.size());
    for (const Eigen::Vector3d& point : { corner, Eigen::Vector3d(corner + a),
           Eigen::Vector3d(corner + a + b), Eigen::Vector3d(corner + b) })
    {
      mesh.points.push_back(point + this->offset);
    }
    mesh.triangles.push_back({ first, first + 1, first + 2 });
    mesh.triangles.push_back({ first, first + 2, first + 3 });
  }
};

#endif
