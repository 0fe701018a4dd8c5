// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_PngBytes_h
#define freespace_PngBytes_h

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

namespace freespace
{

/// A picture as a PNG in memory: libpng, which has its own words for a full disk, is kept away from it.
inline vtkSmartPointer<vtkUnsignedCharArray> PngBytes(vtkImageData* picture)
{
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(picture);
  writer->WriteToMemoryOn();
  writer->Write();
  return writer->GetResult();
}

}

#endif
