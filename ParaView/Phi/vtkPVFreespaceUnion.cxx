// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVFreespaceUnion.h"

#include <vtkAlgorithm.h>
#include <vtkAlgorithmOutput.h>
#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkPVFreespaceUnion);

void vtkPVFreespaceUnion::SetMapsSource(vtkAlgorithm* source)
{
  this->SetInputConnection(source ? source->GetOutputPort() : nullptr);
}

// ParaView's filters ask for the time before they evaluate. An evaluation itself looks at the function's own time only,
// since there are millions of them.
vtkMTimeType vtkPVFreespaceUnion::GetMTime()
{
  const vtkMTimeType time = this->Superclass::GetMTime();
  if (time <= this->SourceTime)
  {
    return time;
  }
  if (time > this->MTime.GetMTime()) // of this object alone
  {
    this->Modified();
  }
  this->SourceTime = this->Superclass::GetMTime();
  return this->SourceTime;
}

void vtkPVFreespaceUnion::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
