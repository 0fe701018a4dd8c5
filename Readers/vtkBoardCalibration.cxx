// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBoardCalibration.h"

#include "Calibration/BoardCalibration.h"
#include "Calibration/BoardImages.h"
#include "Calibration/BoardText.h"
#include "Common/Error.h"
#include "Execution/AlgorithmErrors.h"
#include "Execution/AlgorithmProgress.h"
#include "Execution/SMPParallelFor.h"
#include "Blocks/SparseModelBlocks.h"

#include <vtkErrorCode.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>

#include <algorithm>
#include <filesystem>
#include <limits>

vtkStandardNewMacro(vtkBoardCalibration);

namespace fs = std::filesystem;

struct vtkBoardCalibration::Result
{
  freespace::Board board;
  freespace::BoardCalibration calibration;
  freespace::SparseModel model;
  std::string folder;
};

namespace
{

// The deepest folder that holds all files.
std::string CommonFolder(const std::vector<std::string>& files)
{
  fs::path common = fs::absolute(files.front()).parent_path();
  for (const std::string& file : files)
  {
    const fs::path folder = fs::absolute(file).parent_path();
    fs::path shared;
    for (auto a = common.begin(), b = folder.begin();
         a != common.end() && b != folder.end() && *a == *b; ++a, ++b)
    {
      shared /= *a;
    }
    common = shared;
  }
  return common.string();
}

// Every corner of every image.
std::vector<freespace::SparseView> ViewsOf(const freespace::SparseModel& model)
{
  freespace::SparseViewOptions options;
  options.minimumTrackLength = 1;
  options.maximumError = std::numeric_limits<double>::infinity();
  options.minimumAngle = 0;
  options.minimumFeatures = 0;
  return freespace::ViewsFromModel(model, options);
}

// The first that cannot be read, or the first.
std::string FirstFault(const std::vector<std::string>& files)
{
  const auto found = std::find_if(files.begin(), files.end(),
    [](const std::string& file)
    { return !vtksys::SystemTools::TestFileAccess(file, vtksys::TEST_FILE_READ); });
  return found != files.end() ? *found : files.empty() ? std::string() : files.front();
}

std::string Format(double value)
{
  char text[40];
  std::snprintf(text, sizeof(text), "%.3f", value);
  return text;
}

}

vtkBoardCalibration::vtkBoardCalibration()
  : Calibrated(std::make_unique<Result>())
{
  this->SetNumberOfInputPorts(0);
  const freespace::BoardCalibrationOptions options;
  this->MaximumCoefficients = options.maximumCoefficients;
  this->SquarePixels = options.squarePixels;
  this->MinimumCorners = options.minimumCorners;
}

vtkBoardCalibration::~vtkBoardCalibration() = default;

void vtkBoardCalibration::AddFileName(const std::string& fileName)
{
  this->FileNames.push_back(fileName);
  this->Modified();
}

void vtkBoardCalibration::ClearFileNames()
{
  this->FileNames.clear();
  this->Modified();
}

int vtkBoardCalibration::GetNumberOfFileNames()
{
  return static_cast<int>(this->FileNames.size());
}

int vtkBoardCalibration::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputVector);
  *this->Calibrated = {};
  try
  {
    if (this->FileNames.empty())
    {
      throw freespace::Error("There are no images to calibrate from.");
    }
    freespace::BoardCalibrationOptions options;
    options.board = freespace::BoardFromText(this->Board);
    options.maximumCoefficients = this->MaximumCoefficients;
    options.squarePixels = this->SquarePixels != 0;
    options.minimumCorners = this->MinimumCorners;
    Result result;
    result.board = options.board;
    result.calibration = freespace::CalibrateFromBoard(
      this->FileNames, options, freespace::SMPParallelFor, freespace::AlgorithmProgress(this));
    result.folder = CommonFolder(this->FileNames);
    result.model = result.calibration.Model(options.board, result.folder);
    freespace::BlocksFromModel(result.model, ViewsOf(result.model), output);
    *this->Calibrated = std::move(result);
  }
  catch (...)
  {
    this->SetErrorCode(freespace::ErrorCodeOf(FirstFault(this->FileNames)));
    return freespace::AfterException(this);
  }
  return 1;
}

double vtkBoardCalibration::GetReprojectionError()
{
  return this->Calibrated->calibration.error;
}

std::string vtkBoardCalibration::GetText()
{
  std::string text;
  for (const freespace::BoardImage& image : this->Calibrated->calibration.images)
  {
    text += image.file + ": ";
    text += image.used ? std::to_string(image.corners.ids.size()) + " corners, error " +
        Format(image.error) + " pixels\n"
                       : "not used, " + image.reason + "\n";
  }
  if (this->Calibrated->calibration.hasFormerLayout)
  {
    text += "the board has the layout of OpenCV before 4.6\n";
  }
  for (const freespace::SparseCamera& camera : this->Calibrated->model.cameras)
  {
    text += "camera of " + std::to_string(camera.width) + " x " + std::to_string(camera.height) +
      " pixels: " + freespace::LensModelName(camera.model);
    for (double parameter : camera.parameters)
    {
      text += " " + Format(parameter);
    }
    text += "\n";
  }
  return text;
}

std::string vtkBoardCalibration::GetImagesFolder()
{
  return this->Calibrated->folder;
}

int vtkBoardCalibration::WritePictures(const std::string& folder)
{
  try
  {
    freespace::WriteBoardPictures(this->Calibrated->calibration, folder);
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  return 1;
}

int vtkBoardCalibration::WriteScene(const std::string& fileName, const std::string& model)
{
  try
  {
    if (this->Calibrated->model.images.empty())
    {
      throw freespace::Error("Cannot write " + fileName + ": nothing was calibrated.");
    }
    freespace::Scene scene;
    scene.file = fileName;
    const fs::path target = fs::absolute(fileName).parent_path();
    scene.images = fs::proximate(this->Calibrated->folder, target).string();
    scene.model = fs::proximate(fs::absolute(model), target).string();
    scene.board = this->Calibrated->board;
    freespace::WriteScene(scene, fileName);
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  return 1;
}

void vtkBoardCalibration::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfFileNames: " << this->FileNames.size() << "\n";
  os << indent << "Board: " << this->Board << "\n";
  os << indent << "MaximumCoefficients: " << this->MaximumCoefficients << "\n";
  os << indent << "SquarePixels: " << this->SquarePixels << "\n";
  os << indent << "MinimumCorners: " << this->MinimumCorners << "\n";
  os << indent << "ReprojectionError: " << this->GetReprojectionError() << "\n";
}
