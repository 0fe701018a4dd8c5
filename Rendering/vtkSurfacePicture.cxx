// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfacePicture.h"

#include "Execution/AlgorithmErrors.h"
#include "CameraForVTK.h"
#include "Files/AtomicOutput.h"
#include "Common/Error.h"
#include "Data/PngBytes.h"
#include "Data/SurfaceViewpoint.h"
#include "Data/ViewBlocks.h"
#include "OffScreenWindow.h"
#include "Viewpoints/FramePoints.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkColorTransferFunction.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkErrorCode.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkLight.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <optional>

vtkStandardNewMacro(vtkSurfacePicture);

// The window and its content, created for the first image.
struct vtkSurfacePicture::Stage
{
  std::optional<freespace::Camera> view;
  vtkSmartPointer<vtkRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkActor> actor;
  vtkNew<vtkPolyDataMapper> greyMapper;
  vtkNew<vtkScalarBarActor> bar;

  void MakeWindow();
  void ShowSurface(vtkPolyData* surface, vtkPolyDataMapper* givenMapper);
  vtkSmartPointer<vtkUnsignedCharArray> ReadPixels(int width, int height, bool outlines);
};

namespace
{

using namespace freespace;

constexpr int LargestWindow = 8192; // pixels along a side; every OpenGL 3.2 of today has this

void AddCameraLight(vtkRenderer* renderer, double x, double y, double z, double intensity)
{
  vtkNew<vtkLight> light;
  light->SetLightTypeToCameraLight();
  light->SetPosition(x, y, z);
  light->SetFocalPoint(0.0, 0.0, 0.0);
  light->SetIntensity(intensity);
  renderer->AddLight(light);
}

// A key light from the upper left and one from the camera, so that no facet is black.
void SetUpLights(vtkRenderer* renderer)
{
  renderer->AutomaticLightCreationOff();
  AddCameraLight(renderer, -0.45, 0.65, 0.6, 0.36);
  AddCameraLight(renderer, 0.0, 0.0, 1.0, 0.26);
}

void SetUpGreyLook(vtkActor* actor)
{
  vtkProperty* outside = actor->GetProperty();
  outside->SetInterpolationToFlat();
  outside->SetColor(0.94, 0.97, 1.0);
  outside->SetAmbient(0.35);
  outside->SetDiffuse(1.0);
  outside->SetSpecular(0.0);
  vtkNew<vtkProperty> inside;
  inside->DeepCopy(outside);
  inside->SetColor(1.0, 0.82, 0.68);
  inside->SetAmbient(0.25);
  actor->SetBackfaceProperty(inside);
}

bool HasColours(vtkDataSetAttributes* attributes)
{
  auto* colours = vtkUnsignedCharArray::SafeDownCast(attributes->GetScalars());
  return colours && colours->GetNumberOfComponents() >= 3;
}

// A camera in this direction, as close as possible with all points in the image, with a small margin.
Camera CameraAround(
  vtkPolyData* surface, double azimuth, double elevation, const double up[3], const int size[2])
{
  const double halfAngle = vtkMath::RadiansFromDegrees(15.0);
  const double around = vtkMath::RadiansFromDegrees(azimuth);
  const double above = vtkMath::RadiansFromDegrees(elevation);
  const Eigen::Quaterniond upright = Eigen::Quaterniond::FromTwoVectors(
    Eigen::Vector3d::UnitZ(), Eigen::Vector3d(up[0], up[1], up[2]));
  // Also straight from above.
  const Eigen::Vector3d right = upright * Eigen::Vector3d(-std::sin(around), std::cos(around), 0.0);
  const Eigen::Vector3d forward = upright *
    Eigen::Vector3d(
      -std::cos(above) * std::cos(around), -std::cos(above) * std::sin(around), -std::sin(above));
  Camera camera;
  camera.width = size[0];
  camera.height = size[1];
  const double focal = size[1] / 2.0 / std::tan(halfAngle);
  camera.K << focal, 0.0, size[0] / 2.0, 0.0, focal, size[1] / 2.0, 0.0, 0.0, 1.0;
  camera.R << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  std::vector<Eigen::Vector3d> points(surface->GetNumberOfPoints());
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    surface->GetPoint(i, points[i].data());
  }
  return FramePoints(camera, points);
}

// About the middle of the image.
Camera Zoomed(Camera camera, double zoom)
{
  const Eigen::Vector2d middle(camera.width / 2.0, camera.height / 2.0);
  camera.K.topLeftCorner<2, 2>() *= zoom;
  camera.K.topRightCorner<2, 1>() =
    middle + zoom * (camera.K.topRightCorner<2, 1>() - middle * camera.K(2, 2));
  return camera;
}

// Darkens the near side of each depth discontinuity, so that an object stands out from a background of
// the same colour. The depth buffer is affine in 1 / depth and therefore over the image of a plane: its
// second difference is zero on a plane however steep, unlike that of depth, and a discontinuity is
// measured as a fraction of 1 / depth.
void DrawOutlines(
  const float* depths, const double range[2], int width, int height, unsigned char* pixels)
{
  const double faint = 0.004; // of 1 / depth
  const double full = 0.02;
  const double darkest = 0.5;
  const double scale = (range[1] - range[0]) / (range[0] * range[1]);
  for (int y = 1; y + 1 < height; ++y)
  {
    for (int x = 1; x + 1 < width; ++x)
    {
      const float* depth = depths + std::size_t(y) * width + x;
      const double disparity = 1.0 / range[0] - depth[0] * scale;
      const double across = double(depth[-1]) + depth[1] - 2.0 * depth[0];
      const double along = double(depth[-width]) + depth[width] - 2.0 * depth[0];
      const double jump = std::max(across, along) * scale / disparity;
      const double strength = std::clamp((jump - faint) / (full - faint), 0.0, 1.0);
      if (strength > 0 && depth[0] < 1.0f)
      {
        unsigned char* pixel = pixels + 3 * (std::size_t(y) * width + x);
        for (int channel = 0; channel < 3; ++channel)
        {
          pixel[channel] = static_cast<unsigned char>((1 - strength * darkest) * pixel[channel]);
        }
      }
    }
  }
}

// The mean of each square of samples x samples pixels.
void Average(const unsigned char* fine, int samples, int width, int height, unsigned char* coarse)
{
  const int half = samples * samples / 2;
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < 3 * width; ++x)
    {
      const int channel = x % 3;
      int sum = half;
      for (int row = 0; row < samples; ++row)
      {
        const std::size_t line = std::size_t(y) * samples + row;
        const unsigned char* first =
          fine + 3 * (line * width * samples + x / 3 * samples) + channel;
        for (int column = 0; column < samples; ++column)
        {
          sum += first[3 * column];
        }
      }
      *coarse++ = static_cast<unsigned char>(sum / (samples * samples));
    }
  }
}

}

void vtkSurfacePicture::Stage::MakeWindow()
{
  if (!this->window)
  {
    this->window = freespace::NewOffScreenWindow();
    this->window->AddRenderer(this->renderer);
    this->renderer->AddActor(this->actor);
    this->renderer->AddActor(this->bar);
    this->bar->UnconstrainedFontSizeOn();
    this->bar->GetTitleTextProperty()->SetColor(0.0, 0.0, 0.0);
    this->bar->GetLabelTextProperty()->SetColor(0.0, 0.0, 0.0);
    this->bar->SetNumberOfLabels(3);
    SetUpLights(this->renderer);
    SetUpGreyLook(this->actor);
  }
}

// Without a given mapper the surface is grey and lit.
void vtkSurfacePicture::Stage::ShowSurface(vtkPolyData* surface, vtkPolyDataMapper* givenMapper)
{
  vtkPolyDataMapper* mapper = givenMapper ? givenMapper : this->greyMapper.Get();
  if (mapper->GetInput() != surface)
  {
    mapper->SetInputData(surface);
  }
  this->greyMapper->SetScalarVisibility(
    HasColours(surface->GetPointData()) || HasColours(surface->GetCellData()));
  this->actor->SetMapper(mapper);
  this->actor->GetProperty()->SetLighting(!givenMapper);
}

// Renders the window and returns its pixels; null when it has none.
vtkSmartPointer<vtkUnsignedCharArray> vtkSurfacePicture::Stage::ReadPixels(
  int width, int height, bool outlines)
{
  this->window->Render();
  vtkNew<vtkUnsignedCharArray> pixels;
  const int status = this->window->GetPixelData(0, 0, width - 1, height - 1, 1, pixels);
  if (status != VTK_OK || pixels->GetNumberOfTuples() != vtkIdType(width) * height)
  {
    return nullptr;
  }
  if (outlines)
  {
    vtkNew<vtkFloatArray> depths;
    this->window->GetZbufferData(0, 0, width - 1, height - 1, depths);
    DrawOutlines(depths->GetPointer(0), this->renderer->GetActiveCamera()->GetClippingRange(),
      width, height, pixels->GetPointer(0));
  }
  return pixels;
}

vtkSurfacePicture::vtkSurfacePicture()
  : Shown(new Stage)
{
}

vtkSurfacePicture::~vtkSurfacePicture() = default;

void vtkSurfacePicture::SetView(
  const double intrinsics[9], const double cameraFromWorld[12], const int imageSize[2])
{
  try
  {
    this->Shown->view = freespace::CameraFromArrays(intrinsics, cameraFromWorld, imageSize);
    this->Modified();
  }
  catch (const freespace::Error& error)
  {
    vtkErrorMacro(<< error.what());
  }
}

void vtkSurfacePicture::SetViewBlock(vtkPolyData* block)
{
  try
  {
    const freespace::Camera camera = freespace::ViewFromBlock(block, "to look from").camera;
    freespace::CheckCamera(camera);
    this->Shown->view = camera;
    this->Modified();
  }
  catch (const freespace::Error& error)
  {
    vtkErrorMacro(<< error.what());
  }
}

void vtkSurfacePicture::NoView()
{
  this->Shown->view.reset();
  this->Modified();
}

void vtkSurfacePicture::SetMapper(vtkPolyDataMapper* mapper)
{
  if (this->Mapper != mapper)
  {
    this->Mapper = mapper;
    this->Modified();
  }
}

vtkPolyDataMapper* vtkSurfacePicture::GetMapper()
{
  return this->Mapper;
}

vtkMTimeType vtkSurfacePicture::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  return this->Mapper ? std::max(own, this->Mapper->GetMTime()) : own;
}

int vtkSurfacePicture::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

int vtkSurfacePicture::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkInformation* info = outputVector->GetInformationObject(0);
  const auto& view = this->Shown->view;
  const int extent[6] = { 0, (view ? view->width : this->Size[0]) - 1, 0,
    (view ? view->height : this->Size[1]) - 1, 0, 0 };
  info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  vtkDataObject::SetPointDataActiveScalarInfo(info, VTK_UNSIGNED_CHAR, 3);
  return 1;
}

bool vtkSurfacePicture::Check(vtkPolyData* surface, int width, int height)
{
  if (surface->GetNumberOfCells() == 0)
  {
    vtkErrorMacro("There is no surface to make a picture of.");
    return false;
  }
  if (!std::isfinite(this->Azimuth) || !std::isfinite(this->Elevation))
  {
    vtkErrorMacro("Azimuth and elevation of a picture must be finite.");
    return false;
  }
  if (!(this->Zoom > 0) || !std::isfinite(this->Zoom))
  {
    vtkErrorMacro("The zoom of a picture is " << this->Zoom << ", it must be above 0.");
    return false;
  }
  if (!(vtkMath::Norm(this->Up) > 0) || !std::isfinite(vtkMath::Norm(this->Up)))
  {
    vtkErrorMacro("What is up in a picture must be a finite direction other than 0,0,0.");
    return false;
  }
  if (width < 1 || height < 1 || std::max(width, height) > LargestWindow)
  {
    vtkErrorMacro("A picture of " << width << "x" << height << " pixels cannot be made.");
    return false;
  }
  return true;
}

// Colours by the array and shows its bar, or neither. False where the array is not there.
bool vtkSurfacePicture::ShowColors(vtkPolyData* surface)
{
  Stage& stage = *this->Shown;
  const char* name = this->ColorArray.c_str();
  vtkDataArray* ofPoints = surface->GetPointData()->GetArray(name);
  vtkDataArray* ofCells = surface->GetCellData()->GetArray(name);
  stage.bar->SetVisibility(!this->ColorArray.empty());
  if (this->ColorArray.empty() || this->Mapper)
  {
    stage.greyMapper->SetScalarModeToDefault();
    return true;
  }
  vtkDataArray* array = ofPoints ? ofPoints : ofCells;
  if (!array || array->GetNumberOfTuples() == 0)
  {
    vtkErrorMacro("The surface has no array '" << this->ColorArray << "' to colour it by.");
    return false;
  }
  double range[2];
  array->GetRange(range, array->GetNumberOfComponents() > 1 ? -1 : 0);
  ofPoints ? stage.greyMapper->SetScalarModeToUsePointFieldData()
           : stage.greyMapper->SetScalarModeToUseCellFieldData();
  stage.greyMapper->SelectColorArray(name);
  stage.greyMapper->SetColorModeToMapScalars();
  stage.greyMapper->SetScalarVisibility(true);
  vtkNew<vtkColorTransferFunction> colors;
  const double above = range[1] > range[0] ? range[1] : range[0] + 1;
  colors->AddRGBPoint(range[0], 0.23, 0.30, 0.75);
  colors->AddRGBPoint((range[0] + above) / 2, 0.87, 0.87, 0.87);
  colors->AddRGBPoint(above, 0.71, 0.02, 0.15);
  if (array->GetNumberOfComponents() > 1)
  {
    colors->SetVectorModeToMagnitude();
  }
  stage.greyMapper->SetLookupTable(colors);
  stage.bar->SetLookupTable(colors);
  stage.bar->SetTitle(name);
  return true;
}

void vtkSurfacePicture::PlaceCamera(vtkPolyData* surface, int width, int height)
{
  vtkCamera* camera = this->Shown->renderer->GetActiveCamera();
  const std::optional<freespace::Camera> viewpoint =
    this->UseViewpoint ? freespace::ViewpointOf(surface) : std::nullopt;
  const freespace::Camera from = this->Shown->view ? *this->Shown->view
    : viewpoint                                    ? freespace::WithSize(*viewpoint, width, height)
                : CameraAround(surface, this->Azimuth, this->Elevation, this->Up, this->Size);
  freespace::ApplyCamera(Zoomed(from, this->Zoom), camera);
  this->Shown->renderer->ResetCameraClippingRange();
}

int vtkSurfacePicture::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkPolyData* surface = vtkPolyData::GetData(inputVector[0]);
  vtkImageData* picture = vtkImageData::GetData(outputVector);
  Stage& stage = *this->Shown;
  const int width = stage.view ? stage.view->width : this->Size[0];
  const int height = stage.view ? stage.view->height : this->Size[1];
  if (!this->Check(surface, width, height))
  {
    return freespace::AfterError(this);
  }
  const int samples = std::min(this->Samples, LargestWindow / std::max(width, height));
  stage.MakeWindow();
  stage.ShowSurface(surface, this->Mapper);
  if (!this->ShowColors(surface))
  {
    return freespace::AfterError(this);
  }
  stage.actor->GetProperty()->SetEdgeVisibility(this->Edges);
  stage.actor->GetProperty()->SetEdgeColor(0.1, 0.1, 0.1);
  stage.actor->GetProperty()->SetLineWidth(static_cast<float>(samples));
  stage.renderer->SetBackground(this->Background);
  stage.window->SetMultiSamples(0);
  stage.window->SetSize(samples * width, samples * height);
  this->PlaceCamera(surface, width, height);
  const auto fine = stage.ReadPixels(samples * width, samples * height, !this->Mapper);
  if (!fine)
  {
    vtkErrorMacro("The render window gave no picture.");
    return freespace::AfterError(this);
  }
  picture->SetExtent(0, width - 1, 0, height - 1, 0, 0);
  picture->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  Average(fine->GetPointer(0), samples, width, height,
    static_cast<unsigned char*>(picture->GetScalarPointer()));
  return 1;
}

int vtkSurfacePicture::WritePNG(const std::string& fileName)
{
  this->Update();
  vtkImageData* picture = this->GetOutput();
  if (picture->GetNumberOfPoints() == 0)
  {
    return 0; // Update has reported it
  }
  try
  {
    freespace::AtomicOutput target(fileName);
    const auto bytes = freespace::PngBytes(picture);
    target.Write(bytes->GetPointer(0), bytes->GetNumberOfValues());
    target.Commit();
    return 1;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
}

void vtkSurfacePicture::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "View: " << (this->Shown->view ? "calibrated" : "default") << "\n";
  os << indent << "Size: " << this->Size[0] << " " << this->Size[1] << "\n";
  os << indent << "UseViewpoint: " << this->UseViewpoint << "\n";
  os << indent << "Azimuth: " << this->Azimuth << "\n";
  os << indent << "Elevation: " << this->Elevation << "\n";
  os << indent << "Samples: " << this->Samples << "\n";
  os << indent << "Background: " << this->Background[0] << " " << this->Background[1] << " "
     << this->Background[2] << "\n";
  os << indent << "Up: " << this->Up[0] << " " << this->Up[1] << " " << this->Up[2] << "\n";
  os << indent << "Zoom: " << this->Zoom << "\n";
  os << indent << "Edges: " << this->Edges << "\n";
  os << indent << "ColorArray: " << this->ColorArray << "\n";
  os << indent << "Mapper: " << this->Mapper.Get() << "\n";
}
