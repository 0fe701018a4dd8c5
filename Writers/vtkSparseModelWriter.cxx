// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSparseModelWriter.h"

#include "Common/Error.h"
#include "Data/ViewInput.h"
#include "RunWriter.h"
#include "SparseModel/ColmapModel.h"
#include "Blocks/SparseModelBlocks.h"

#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkSparseModelWriter);

int vtkSparseModelWriter::FillInputPortInformation(int, vtkInformation* info)
{
  freespace::AcceptViews(info);
  return 1;
}

void vtkSparseModelWriter::WriteData()
{
  this->SetErrorCode(freespace::RunWriter(this, this->FileName,
    [&]
    {
      if (this->FileName.empty())
      {
        throw freespace::Error("Cannot write the camera model: its folder has no name.");
      }
      const freespace::SparseModel model =
        freespace::ModelFromBlocks(freespace::ViewsOf(this->GetInput()));
      freespace::WriteColmapModel(model, this->FileName,
        this->Binary ? freespace::ColmapFormat::Binary : freespace::ColmapFormat::Text);
    }));
}

void vtkSparseModelWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
  os << indent << "Binary: " << this->Binary << "\n";
}
