// SPDX-License-Identifier: BSD-3-Clause
// A project of somebody else's that uses the installed library.
#include <vtkOutlierFilter.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkSurfaceWriter.h>
#include <vtkViewBlocksReader.h>

int main()
{
  vtkNew<vtkMultiBlockDataSet> empty;
  vtkNew<vtkOutlierFilter> support;
  support->SetInputDataObject(empty);
  support->Update();
  vtkNew<vtkViewBlocksReader> reader;
  reader->SetFileName("none.vtm");
  return support->GetOutput()->GetNumberOfBlocks() == 0 &&
      vtkSurfaceWriter::CanWriteFile("a.ply") && !vtkSurfaceWriter::CanWriteFile("a.txt")
    ? 0
    : 1;
}
