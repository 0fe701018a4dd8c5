// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFreespaceSurfaceFilter.h"

#include "Data/ViewInput.h"
#include "Execution/AlgorithmErrors.h"
#include "Execution/PieceRequest.h"
#include "Freespace/FreespaceUnion.h"
#include "vtkBisectionContourFilter.h"
#include "vtkFitSurfaceFilter.h"
#include "vtkFreespaceUnion.h"

#include <vtkCommand.h>
#include <vtkErrorCode.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <string>

vtkStandardNewMacro(vtkFreespaceSurfaceFilter);

namespace
{

// Passes the progress of a part of the work on, and an abort back to it; keeps the first error.
class PartObserver : public vtkCommand
{
public:
  static PartObserver* New() { return new PartObserver; }

  void Execute(vtkObject* caller, unsigned long event, void* data) override
  {
    if (event == vtkCommand::ErrorEvent)
    {
      this->Error = this->Error.empty() ? Sentence(static_cast<const char*>(data)) : this->Error;
    }
    else if (auto* part = vtkAlgorithm::SafeDownCast(caller))
    {
      const double fraction = *static_cast<double*>(data);
      this->Outer->UpdateProgress(this->Begin + fraction * (this->End - this->Begin));
      part->SetAbortExecute(this->Outer->GetAbortExecute());
    }
  }

  vtkAlgorithm* Outer = nullptr;
  double Begin = 0.0;
  double End = 1.0;
  std::string Error;

private:
  // An error without the place in the source and the object, which vtkErrorMacro puts before it.
  static std::string Sentence(const std::string& text)
  {
    const std::size_t begin = text.find("): ");
    const std::size_t end = text.find_last_not_of(" \n");
    return begin == std::string::npos ? text : text.substr(begin + 3, end - begin - 2);
  }
};

// Watches an object while it is in scope.
class Watch
{
public:
  Watch(vtkObject* object, PartObserver* observer)
    : Object(object)
    , Tags{ object->AddObserver(vtkCommand::ProgressEvent, observer),
      object->AddObserver(vtkCommand::ErrorEvent, observer) }
  {
  }
  ~Watch()
  {
    for (const unsigned long tag : this->Tags)
    {
      this->Object->RemoveObserver(tag);
    }
  }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

private:
  vtkObject* Object;
  unsigned long Tags[2];
};

constexpr double ShareOfContour = 0.5; // of the time, where the surface is fitted

}

vtkFreespaceSurfaceFilter::vtkFreespaceSurfaceFilter()
{
  this->Contour->SetImplicitFunction(this->FreespaceUnion);
  this->InnerTime = this->TimeOfSettings();
}

vtkFreespaceSurfaceFilter::~vtkFreespaceSurfaceFilter() = default;

vtkFreespaceUnion* vtkFreespaceSurfaceFilter::GetFreespaceUnion()
{
  return this->FreespaceUnion;
}

vtkBisectionContourFilter* vtkFreespaceSurfaceFilter::GetContour()
{
  return this->Contour;
}

vtkFitSurfaceFilter* vtkFreespaceSurfaceFilter::GetFit()
{
  return this->Fit;
}

void vtkFreespaceSurfaceFilter::SetCells(int cells)
{
  this->Contour->SetCells(cells);
}

int vtkFreespaceSurfaceFilter::GetCells()
{
  return this->Contour->GetCells();
}

void vtkFreespaceSurfaceFilter::SetMinimumViews(int views)
{
  this->FreespaceUnion->SetMinimumViews(views);
}

int vtkFreespaceSurfaceFilter::GetMinimumViews()
{
  return this->FreespaceUnion->GetMinimumViews();
}

vtkMTimeType vtkFreespaceSurfaceFilter::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  const vtkMTimeType inner = this->TimeOfSettings();
  return inner > this->InnerTime ? std::max(own, inner) : own;
}

vtkMTimeType vtkFreespaceSurfaceFilter::TimeOfSettings()
{
  return std::max(
    { this->FreespaceUnion->GetMTime(), this->Contour->GetMTime(), this->Fit->GetMTime() });
}

int vtkFreespaceSurfaceFilter::FillInputPortInformation(int, vtkInformation* info)
{
  freespace::AcceptViews(info);
  return 1;
}

int vtkFreespaceSurfaceFilter::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  outputVector->GetInformationObject(0)->Set(CAN_HANDLE_PIECE_REQUEST(), 1);
  return 1;
}

// Every piece of the surface needs all maps.
int vtkFreespaceSurfaceFilter::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  vtkInformation* input = inputVector[0]->GetInformationObject(0);
  input->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), 0);
  input->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), 1);
  input->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  return 1;
}

int vtkFreespaceSurfaceFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkInformation* information = outputVector->GetInformationObject(0);
  vtkPolyData* output = vtkPolyData::GetData(information);
  // The pipeline's own data may be released while the function holds the maps.
  vtkNew<vtkMultiBlockDataSet> maps;
  try
  {
    freespace::RefuseGhosts(information);
    maps->ShallowCopy(freespace::ViewsOf(inputVector[0]));
  }
  catch (...)
  {
    return freespace::AfterException(this);
  }
  this->FreespaceUnion->SetMaps(maps);
  const int cells = this->Contour->GetCells();
  this->FreespaceUnion->SetHullMargin(this->HullMargin >= 0
      ? this->HullMargin
      : freespace::FreespaceUnionOptions::MarginOfLattice(cells));

  const bool hasPieces =
    information->Has(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES()) != 0;
  const int piece =
    hasPieces ? information->Get(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER()) : 0;
  const int pieces =
    hasPieces ? information->Get(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES()) : 1;
  const bool isFitted = this->FitSurface && pieces == 1;
  vtkNew<PartObserver> observer;
  observer->Outer = this;
  observer->End = isFitted ? ShareOfContour : 1.0;
  const Watch unionWatch(this->FreespaceUnion, observer), contourWatch(this->Contour, observer);
  this->Contour->UpdatePiece(piece, pieces, 0);
  output->ShallowCopy(this->Contour->GetOutput());
  if (isFitted && output->GetNumberOfPolys() > 0 && observer->Error.empty())
  {
    observer->Begin = ShareOfContour;
    observer->End = 1.0;
    const Watch fitWatch(this->Fit, observer);
    this->Fit->SetInputData(0, this->Contour->GetOutput());
    this->Fit->SetInputDataObject(1, maps);
    this->Fit->Update();
    output->ShallowCopy(this->Fit->GetOutput());
    this->Fit->RemoveAllInputs();
    this->Fit->GetOutput()->Initialize();
  }
  this->Contour->GetOutput()->Initialize();
  this->FreespaceUnion->SetMaps(nullptr);
  this->InnerTime = this->TimeOfSettings();
  if (!observer->Error.empty())
  {
    vtkErrorMacro(<< observer->Error);
    return freespace::AfterError(this);
  }
  return 1;
}

void vtkFreespaceSurfaceFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "HullMargin: " << this->HullMargin << "\n";
  os << indent << "FitSurface: " << this->FitSurface << "\n";
  os << indent << "FreespaceUnion:\n";
  this->FreespaceUnion->PrintSelf(os, indent.GetNextIndent());
  os << indent << "Contour:\n";
  this->Contour->PrintSelf(os, indent.GetNextIndent());
  os << indent << "Fit:\n";
  this->Fit->PrintSelf(os, indent.GetNextIndent());
}
