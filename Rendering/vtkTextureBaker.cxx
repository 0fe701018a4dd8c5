// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTextureBaker.h"

#include "Common/Error.h"
#include "Execution/AlgorithmErrors.h"
#include "Execution/AlgorithmProgress.h"
#include "Execution/SMPParallelFor.h"
#include "Data/ObservedTriangles.h"
#include "Data/SurfaceMesh.h"
#include "PhotographBlocks.h"
#include "Texture/TextureAtlas.h"

#include <vtkCellArray.h>
#include <vtkErrorCode.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

vtkStandardNewMacro(vtkTextureBaker);

namespace
{

using namespace freespace;

void SetTexture(const TextureAtlas& atlas, vtkImageData* texture)
{
  texture->SetDimensions(atlas.width, atlas.height, 1);
  texture->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const std::size_t line = std::size_t(3) * atlas.width;
  for (int row = 0; row < atlas.height; ++row)
  {
    std::copy_n(atlas.rgb.data() + row * line, line,
      static_cast<unsigned char*>(texture->GetScalarPointer(0, atlas.height - 1 - row, 0)));
  }
}

// The colours of points are sampled from the atlas, so that they are those of the texture.
void AddColors(const TextureAtlas& atlas, vtkPolyData* surface)
{
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("RGB");
  colors->SetNumberOfComponents(3);
  for (const Eigen::Vector2d& at : atlas.coordinates)
  {
    const int column = std::clamp(static_cast<int>(at.x() * atlas.width), 0, atlas.width - 1);
    const int row = std::clamp(static_cast<int>(at.y() * atlas.height), 0, atlas.height - 1);
    colors->InsertNextTypedTuple(&atlas.rgb[3 * (std::size_t(row) * atlas.width + column)]);
  }
  surface->GetPointData()->SetScalars(colors);
}

void SetSurface(const TriangleMesh& mesh, const TextureAtlas& atlas, vtkPolyData* surface)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetName("TextureCoordinates");
  coordinates->SetNumberOfComponents(2);
  for (std::size_t i = 0; i < atlas.source.size(); ++i)
  {
    points->InsertNextPoint(mesh.points[atlas.source[i]].data());
    coordinates->InsertNextTuple2(atlas.coordinates[i].x(), 1 - atlas.coordinates[i].y());
  }
  vtkNew<vtkCellArray> triangles;
  for (const std::array<int, 3>& triangle : atlas.triangles)
  {
    const vtkIdType ids[3] = { triangle[0], triangle[1], triangle[2] };
    triangles->InsertNextCell(3, ids);
  }
  surface->SetPoints(points);
  surface->SetPolys(triangles);
  surface->GetPointData()->SetTCoords(coordinates);
  AddColors(atlas, surface);
}

// A triangle that is there again would have a chart of its own.
TriangleMesh MeshWithoutRepeated(vtkPolyData* surface)
{
  vtkNew<vtkPolyData> once;
  once->ShallowCopy(surface);
  if (once->GetPolys()->IsHomogeneous() == 3)
  {
    DropRepeated(once);
  }
  return MeshFromPolyData(once);
}

// What the surface is moved to the origin by where it lies far from it, as in UTM coordinates: charts are
// cut and images rendered in single precision. No triangle's colour depends on it.
Eigen::Vector3d LocalOrigin(const TriangleMesh& mesh)
{
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : mesh.points)
  {
    box.extend(point);
  }
  const bool isFar = box.center().norm() > 10 * box.diagonal().norm();
  return isFar ? Eigen::Vector3d(box.center()) : Eigen::Vector3d::Zero();
}

// Of the images as they are given and copied, and of how far they see the surface, MiB.
double MemoryOf(const std::vector<Photograph>& photographs)
{
  double pixels = 0;
  for (const Photograph& photograph : photographs)
  {
    pixels += static_cast<double>(photograph.camera.width) * photograph.camera.height;
  }
  return pixels * MemoryOfPixel / (1 << 20);
}

}

vtkTextureBaker::vtkTextureBaker()
{
  this->SetNumberOfOutputPorts(2);
  const freespace::TextureAtlasOptions atlas;
  this->TexelSize = atlas.texel;
  this->LargestTexture = atlas.largest;
  this->MemoryLimit = atlas.memory;
  const freespace::SurfaceColorOptions look;
  this->Sharpness = look.sharpness;
  this->Leveling = look.level;
  this->Feather = look.visibility.feather;
}

void vtkTextureBaker::SetPhotographs(vtkMultiBlockDataSet* photographs)
{
  if (this->Photographs != photographs)
  {
    this->Photographs = photographs;
    this->Modified();
  }
}

vtkMultiBlockDataSet* vtkTextureBaker::GetPhotographs()
{
  return this->Photographs;
}

vtkImageData* vtkTextureBaker::GetTexture()
{
  return vtkImageData::SafeDownCast(this->GetOutputDataObject(1));
}

vtkMTimeType vtkTextureBaker::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  return this->Photographs ? std::max(own, this->Photographs->GetMTime()) : own;
}

int vtkTextureBaker::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkPolyData" : "vtkImageData");
  return 1;
}

int vtkTextureBaker::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  // The size of the texture is known only after baking: every request is served with all of it.
  const int nothing[6] = { 0, -1, 0, -1, 0, -1 };
  outputVector->GetInformationObject(1)->Set(
    vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), nothing, 6);
  return 1;
}

int vtkTextureBaker::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkPolyData* surface = vtkPolyData::GetData(outputVector, 0);
  vtkImageData* texture = vtkImageData::GetData(outputVector, 1);
  try
  {
    const freespace::Progress progress = AlgorithmProgress(this);
    const TriangleMesh mesh = MeshWithoutRepeated(vtkPolyData::GetData(inputVector[0]));
    if (mesh.triangles.empty())
    {
      throw Error("There is no surface to texture.");
    }
    const Eigen::Vector3d origin = LocalOrigin(mesh);
    TriangleMesh local = mesh;
    for (Eigen::Vector3d& point : local.points)
    {
      point -= origin;
    }
    std::vector<Photograph> photographs = PhotographsFromBlocks(this->Photographs);
    const double imageMemory = MemoryOf(photographs);
    if (this->MemoryLimit > 0 && imageMemory >= this->MemoryLimit)
    {
      throw Error("The images take " + std::to_string(std::lround(imageMemory)) +
        " MiB, and the limit of the memory is " + std::to_string(std::lround(this->MemoryLimit)) +
        " MiB.");
    }
    for (Photograph& photograph : photographs)
    {
      photograph.camera.t += photograph.camera.R * origin;
    }
    SurfaceColorOptions look;
    look.sharpness = this->Sharpness;
    look.level = this->Leveling != 0;
    look.visibility.feather = this->Feather;
    const SurfaceColor color(local, std::move(photographs), look, SMPParallelFor);
    progress(0.2);
    TextureAtlasOptions options;
    options.texel = this->TexelSize;
    options.largest = this->LargestTexture;
    options.memory = this->MemoryLimit > 0 ? this->MemoryLimit - imageMemory : 0;
    options.unseen = 255 * Eigen::Vector3d(this->UnseenColor);
    const TextureAtlas atlas =
      BakeTexture(local, color, options, SMPParallelFor, progress.Part(0.2, 1.0));
    this->NumberOfCharts = atlas.charts;
    this->BakedTexelSize = atlas.texel;
    SetSurface(mesh, atlas, surface);
    SetTexture(atlas, texture);
    return 1;
  }
  catch (...)
  {
    return AfterException(this);
  }
}

void vtkTextureBaker::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Photographs: " << this->Photographs.Get() << "\n";
  os << indent << "TexelSize: " << this->TexelSize << "\n";
  os << indent << "MemoryLimit: " << this->MemoryLimit << "\n";
  os << indent << "LargestTexture: " << this->LargestTexture << "\n";
  os << indent << "Sharpness: " << this->Sharpness << "\n";
  os << indent << "Leveling: " << this->Leveling << "\n";
  os << indent << "Feather: " << this->Feather << "\n";
  os << indent << "UnseenColor: " << this->UnseenColor[0] << " " << this->UnseenColor[1] << " "
     << this->UnseenColor[2] << "\n";
  os << indent << "NumberOfCharts: " << this->NumberOfCharts << "\n";
  os << indent << "BakedTexelSize: " << this->BakedTexelSize << "\n";
}
