// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOccupancyMapWriter.h"

#include "AlgorithmProgress.h"
#include "AtomicOutput.h"
#include "DisparityImage.h"
#include "Error.h"
#include "SMPParallelFor.h"
#include "ViewBlocks.h"
#include "vtkFreespaceUnion.h"

#include <vtkErrorCode.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>

#include <octomap/octomap.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

vtkStandardNewMacro(vtkOccupancyMapWriter);

namespace
{

using namespace freespace;

/// Where the views of disparity maps have looked.
class LookedAt
{
public:
  explicit LookedAt(const std::vector<DisparityMap>& maps)
    : Images(maps.size())
  {
    for (const DisparityMap& map : maps)
    {
      this->Cameras.push_back(map.camera);
    }
    SMPParallelFor(maps.size(),
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          this->Images[i] = RenderDisparity({ maps[i].points, maps[i].triangles }, maps[i].camera);
        }
      });
  }

  bool operator()(const Eigen::Vector3d& point) const
  {
    for (std::size_t i = 0; i < this->Cameras.size(); ++i)
    {
      const Camera& camera = this->Cameras[i];
      if (camera.Depth(point) > 0)
      {
        const Eigen::Vector2d pixel = camera.Project(point);
        if (pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < camera.width &&
          pixel.y() < camera.height &&
          this->Images[i].At(static_cast<int>(pixel.x()), static_cast<int>(pixel.y())) > 0)
        {
          return true;
        }
      }
    }
    return false;
  }

private:
  std::vector<Camera> Cameras;
  std::vector<DisparityImage> Images;
};

enum Cell : unsigned char
{
  Unknown,
  Free,
  Occupied
};

/// The cells of OctoMap's lattice that a box touches.
struct Lattice
{
  double side = 0;
  std::array<std::int64_t, 3> first = {};
  std::array<std::int64_t, 3> count = {};

  Lattice(const double bounds[6], double resolution)
  {
    double longest = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      longest = std::max(longest, bounds[2 * axis + 1] - bounds[2 * axis]);
    }
    this->side = resolution > 0 ? resolution : longest / 128;
    double cells = 1;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double low = std::floor(bounds[2 * axis] / this->side);
      const double high = std::floor(bounds[2 * axis + 1] / this->side);
      cells *= high - low + 1;
      if (!(low >= -32768 && high < 32768 && cells <= 1e9))
      {
        throw Error("a resolution of " + std::to_string(this->side) +
          " asks for more cells than an OctoMap can hold around its origin, or a billion");
      }
      this->first[axis] = static_cast<std::int64_t>(low);
      this->count[axis] = static_cast<std::int64_t>(high - low) + 1;
    }
  }

  double Middle(int axis, std::int64_t index) const
  {
    return (this->first[axis] + index + 0.5) * this->side;
  }
};

void FillTree(const Lattice& lattice, vtkFreespaceUnion* phi, const LookedAt& lookedAt,
  const Progress& progress, octomap::OcTree& tree)
{
  const auto [nx, ny, nz] = lattice.count;
  std::vector<Cell> slab(nx * ny);
  for (std::int64_t z = 0; z < nz; ++z)
  {
    SMPParallelFor(ny,
      [&, nx = nx](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin * nx; i < end * nx; ++i)
        {
          Eigen::Vector3d point(
            lattice.Middle(0, i % nx), lattice.Middle(1, i / nx), lattice.Middle(2, z));
          slab[i] = !lookedAt(point)                  ? Unknown
            : phi->EvaluateFunction(point.data()) > 0 ? Free
                                                      : Occupied;
        }
      });
    for (std::int64_t i = 0; i < nx * ny; ++i)
    {
      if (slab[i] != Unknown)
      {
        const octomap::point3d middle(static_cast<float>(lattice.Middle(0, i % nx)),
          static_cast<float>(lattice.Middle(1, i / nx)), static_cast<float>(lattice.Middle(2, z)));
        tree.setNodeValue(middle,
          slab[i] == Free ? tree.getClampingThresMinLog() : tree.getClampingThresMaxLog(), true);
      }
    }
    progress(double(z + 1) / nz);
  }
  tree.updateInnerOccupancy();
  tree.prune();
}

}

int vtkOccupancyMapWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkMultiBlockDataSet");
  return 1;
}

void vtkOccupancyMapWriter::WriteData()
{
  this->SetErrorCode(vtkErrorCode::NoError);
  try
  {
    const std::string ending = std::filesystem::path(this->FileName).extension().string();
    if (ending != ".bt" && ending != ".ot")
    {
      throw Error("an OctoMap's file name ends in .bt or .ot");
    }
    AtomicOutput target(this->FileName);
    auto* blocks = vtkMultiBlockDataSet::SafeDownCast(this->GetInput());
    const std::vector<DisparityMap> maps = MapsFromBlocks(blocks);
    vtkNew<vtkFreespaceUnion> phi;
    phi->SetMaps(blocks);
    phi->SetHullMargin(this->HullMargin);
    phi->SetMinimumViews(this->MinimumViews);
    phi->Update();
    double bounds[6];
    phi->GetBounds(bounds);
    if (!phi->IsValid() || bounds[0] > bounds[1])
    {
      throw Error("the disparity maps have no features");
    }
    const Lattice lattice(bounds, this->Resolution);
    octomap::OcTree tree(lattice.side);
    FillTree(lattice, phi, LookedAt(maps), freespace::AlgorithmProgress(this), tree);
    const bool written =
      ending == ".bt" ? tree.writeBinaryConst(target.Path()) : tree.write(target.Path());
    if (!written)
    {
      throw Error("the disk is full or failed");
    }
    target.Commit();
  }
  catch (const Aborted&)
  {
    this->SetErrorCode(vtkErrorCode::UserError);
  }
  catch (const std::exception& error)
  {
    const std::string fault = error.what();
    const bool isWhole = fault.rfind("Cannot write ", 0) == 0;
    vtkErrorMacro(<< (isWhole ? fault : "Cannot write '" + this->FileName + "': " + fault));
    this->SetErrorCode(vtkErrorCode::CannotOpenFileError);
  }
}

void vtkOccupancyMapWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "HullMargin: " << this->HullMargin << "\n";
  os << indent << "MinimumViews: " << this->MinimumViews << "\n";
}
