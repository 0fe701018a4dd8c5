// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOccupancyMapWriter.h"

#include "Files/AtomicOutput.h"
#include "Files/GlobalShift.h"
#include "Common/Error.h"
#include "Files/FileExtension.h"
#include "Common/ParallelForWithProgress.h"
#include "Data/Boxes.h"
#include "Data/ViewBlocks.h"
#include "Data/ViewInput.h"
#include "Execution/AlgorithmProgress.h"
#include "Execution/SMPParallelFor.h"
#include "Freespace/FreespaceUnion.h"
#include "RunWriter.h"
#include "Texture/DisparityImage.h"
#include "vtkFreespaceUnion.h"

#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>

#include <octomap/octomap.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

vtkStandardNewMacro(vtkOccupancyMapWriter);

namespace
{

using namespace freespace;

/// Where the views of disparity maps have looked.
class LookedAt
{
public:
  LookedAt(const std::vector<DisparityMap>& maps, const Progress& progress)
    : Images(maps.size())
  {
    for (const DisparityMap& map : maps)
    {
      this->Cameras.push_back(map.camera);
    }
    ParallelForWithProgress(maps.size(), SMPParallelFor, progress,
      [&](std::size_t i, const CancellationFlag&) {
        this->Images[i] = RenderDisparity({ maps[i].points, maps[i].triangles }, maps[i].camera);
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
  Eigen::Vector3d shift; // of its origin
  std::array<std::int64_t, 3> first = {};
  std::array<std::int64_t, 3> count = {};

  Lattice(const double bounds[6], double resolution, const Eigen::Vector3d& globalShift)
    : shift(globalShift)
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
      const double low = std::floor((bounds[2 * axis] - this->shift[axis]) / this->side);
      const double high = std::floor((bounds[2 * axis + 1] - this->shift[axis]) / this->side);
      cells *= high - low + 1;
      if (!(low >= -32768 && high < 32768 && cells <= 1e9))
      {
        throw Error("A resolution of " + std::to_string(this->side) +
          " asks for more cells than an OctoMap can hold around its origin, which a global shift "
          "moves, or a billion.");
      }
      this->first[axis] = static_cast<std::int64_t>(low);
      this->count[axis] = static_cast<std::int64_t>(high - low) + 1;
    }
  }

  std::int64_t NumberOfCells() const { return this->count[0] * this->count[1] * this->count[2]; }

  /// Of a cell, less the shift; they are counted along x, then y, then z.
  Eigen::Vector3d Middle(std::int64_t cell) const
  {
    const std::int64_t index[3] = { cell % this->count[0], cell / this->count[0] % this->count[1],
      cell / this->count[0] / this->count[1] };
    Eigen::Vector3d middle;
    for (int axis = 0; axis < 3; ++axis)
    {
      middle[axis] = (this->first[axis] + index[axis] + 0.5) * this->side;
    }
    return middle;
  }
};

// What is in each cell of a range of the lattice, which is counted along x, then y, then z.
void ClassifyCells(const Lattice& lattice, const FreespaceUnion& phi, const LookedAt& lookedAt,
  std::int64_t first, std::vector<Cell>& cells)
{
  constexpr std::size_t together = 256;
  SMPParallelFor((cells.size() + together - 1) / together,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin * together; i < std::min(end * together, cells.size()); ++i)
      {
        const Eigen::Vector3d point = lattice.Middle(first + i) + lattice.shift;
        cells[i] = !lookedAt(point) ? Unknown : phi.IsFree(point) ? Free : Occupied;
      }
    });
}

void FillTree(const Lattice& lattice, const FreespaceUnion& phi, const LookedAt& lookedAt,
  const Progress& progress, octomap::OcTree& tree)
{
  constexpr std::int64_t batch = 4096; // a few hundredths of a second, even with a thousand views
  const std::int64_t count = lattice.NumberOfCells();
  std::vector<Cell> cells;
  for (std::int64_t first = 0; first < count; first += batch)
  {
    progress(static_cast<double>(first) / count);
    cells.resize(std::min(batch, count - first));
    ClassifyCells(lattice, phi, lookedAt, first, cells);
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      if (cells[i] != Unknown)
      {
        const Eigen::Vector3f middle = lattice.Middle(first + i).cast<float>();
        tree.setNodeValue(octomap::point3d(middle.x(), middle.y(), middle.z()),
          cells[i] == Free ? tree.getClampingThresMinLog() : tree.getClampingThresMaxLog(), true);
      }
    }
  }
  progress(1.0);
}

// Prunes equal cells to a larger one, and updates the values of the others.
void Prune(octomap::OcTree& tree, octomap::OcTreeNode* node, const CancellationFlag& stop)
{
  ThrowIfCancelled(stop);
  for (unsigned int i = 0; i < 8; ++i)
  {
    if (tree.nodeChildExists(node, i))
    {
      octomap::OcTreeNode* child = tree.getNodeChild(node, i);
      if (tree.nodeHasChildren(child))
      {
        Prune(tree, child, stop);
      }
    }
  }
  if (!tree.pruneNode(node))
  {
    node->updateOccupancyChildren();
  }
}

/// A file that reports how much is written, and stops on request.
class WatchedFile : public std::filebuf
{
public:
  WatchedFile(const std::string& fileName, double expectedBytes, const Progress& progress)
    : Expected(expectedBytes)
    , Told(progress)
  {
    this->open(fileName, std::ios::out | std::ios::binary);
  }

protected:
  std::streamsize xsputn(const char* bytes, std::streamsize count) override
  {
    constexpr std::int64_t step = 1 << 16;
    const std::int64_t before = this->Written;
    this->Written += count;
    if (before / step != this->Written / step)
    {
      this->Told(std::min(this->Written / this->Expected, 1.0));
    }
    return std::filebuf::xsputn(bytes, count);
  }

private:
  double Expected;
  const Progress& Told;
  std::int64_t Written = 0;
};

// OctoMap's own functions write no comment of ours. Its readers skip it.
void WriteShifted(
  const octomap::OcTree& tree, bool isBinary, const std::string& comment, std::ostream& stream)
{
  stream << "# Octomap OcTree " << (isBinary ? "binary " : "") << "file\n# " << comment << "\nid "
         << tree.getTreeType() << "\nsize " << tree.size() << "\nres " << tree.getResolution()
         << "\ndata\n";
  isBinary ? tree.writeBinaryData(stream) : tree.writeData(stream);
}

void WriteTree(const octomap::OcTree& tree, const AtomicOutput& target, bool isBinary,
  const Eigen::Vector3d& globalShift, const Progress& progress)
{
  constexpr double bytesPerNode = 5.0, bytesPerBinaryNode = 2.0; // at most
  WatchedFile file(
    target.Path(), (isBinary ? bytesPerBinaryNode : bytesPerNode) * (1.0 + tree.size()), progress);
  std::ostream stream(&file);
  stream.exceptions(std::ios::badbit); // lets the wish to stop through
  bool written = false;
  try
  {
    if (globalShift.isZero(0))
    {
      written = isBinary ? tree.writeBinaryConst(stream) : tree.write(stream);
    }
    else
    {
      WriteShifted(tree, isBinary, GlobalShiftComment(globalShift), stream);
      written = stream.good();
    }
  }
  catch (const std::ios::failure&)
  {
    // Told below.
  }
  if (!written || !file.close())
  {
    throw target.Failure();
  }
  progress(1.0);
}

/// Parts of the progress.
constexpr double Built = 0.3, Rendered = 0.35, Indexed = 0.4, Filled = 0.8, Pruned = 0.9;

}

vtkOccupancyMapWriter::vtkOccupancyMapWriter()
{
  const freespace::FreespaceUnionOptions options;
  this->HullMargin = options.hullMargin;
  this->MinimumViews = options.minimumViews;
  this->Contradiction = options.contradiction;
}

int vtkOccupancyMapWriter::FillInputPortInformation(int, vtkInformation* info)
{
  freespace::AcceptViews(info);
  return 1;
}

void vtkOccupancyMapWriter::WriteData()
{
  this->SetErrorCode(RunWriter(this, this->FileName,
    [&]
    {
      const std::string ending = LowerCaseExtension(this->FileName);
      if (ending != ".bt" && ending != ".ot")
      {
        throw Error(
          "Cannot write '" + this->FileName + "': an OctoMap's file name ends in .bt or .ot.");
      }
      freespace::FreespaceUnionOptions options;
      options.hullMargin = this->HullMargin;
      options.minimumViews = this->MinimumViews;
      options.contradiction = this->Contradiction;
      options.Check();
      if (!(this->Resolution >= 0 && std::isfinite(this->Resolution)))
      {
        throw Error("The resolution of an occupancy map must be a length, or 0.");
      }
      AtomicOutput target(this->FileName);
      const auto blocks = freespace::ViewsOf(this->GetInput());
      const freespace::Progress progress = AlgorithmProgress(this);
      vtkNew<vtkFreespaceUnion> phi;
      phi->SetMaps(blocks);
      phi->SetHullMargin(this->HullMargin);
      phi->SetMinimumViews(this->MinimumViews);
      phi->SetContradiction(this->Contradiction);
      if (this->RegionMode == vtkFreespaceUnion::BOX_REGION)
      {
        phi->SetRegion(this->Region);
      }
      phi->SetRegionMode(this->RegionMode);
      const auto core = phi->GetCore(progress.Part(0.0, Built));
      double bounds[6];
      phi->GetBounds(bounds);
      if (!core || bounds[0] > bounds[1])
      {
        throw Error("Cannot write " + this->FileName + ": the disparity maps have no features.");
      }
      const Eigen::Vector3d shift = this->AutomaticGlobalShift ? SuggestGlobalShift(BoxOf(bounds))
                                                               : Eigen::Vector3d(this->GlobalShift);
      if (!shift.allFinite())
      {
        throw Error("The global shift of an occupancy map must be finite.");
      }
      const Lattice lattice(bounds, this->Resolution, shift);
      octomap::OcTree tree(lattice.side);
      const LookedAt lookedAt(MapsFromBlocks(blocks), progress.Part(Built, Rendered));
      core->IndexForPoints(progress.Part(Rendered, Indexed));
      FillTree(lattice, *core, lookedAt, progress.Part(Indexed, Filled), tree);
      RunWithProgress(progress.Part(Filled, Pruned),
        [&](const CancellationFlag& stop)
        {
          if (tree.getRoot())
          {
            Prune(tree, tree.getRoot(), stop);
          }
        });
      WriteTree(tree, target, ending == ".bt", shift, progress.Part(Pruned, 1.0));
      target.Commit();
    }));
}

void vtkOccupancyMapWriter::SetRegion(const double bounds[6])
{
  if (this->RegionMode != vtkFreespaceUnion::BOX_REGION ||
    !std::equal(bounds, bounds + 6, this->Region))
  {
    std::copy(bounds, bounds + 6, this->Region);
    this->RegionMode = vtkFreespaceUnion::BOX_REGION;
    this->Modified();
  }
}

void vtkOccupancyMapWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "GlobalShift: " << this->GlobalShift[0] << " " << this->GlobalShift[1] << " "
     << this->GlobalShift[2] << "\n";
  os << indent << "AutomaticGlobalShift: " << this->AutomaticGlobalShift << "\n";
  os << indent << "HullMargin: " << this->HullMargin << "\n";
  os << indent << "MinimumViews: " << this->MinimumViews << "\n";
  os << indent << "Contradiction: " << this->Contradiction << "\n";
  os << indent << "RegionMode: " << this->RegionMode << "\n";
  os << indent << "Region:";
  for (double bound : this->Region)
  {
    os << " " << bound;
  }
  os << "\n";
}
