// SPDX-License-Identifier: BSD-3-Clause
#include "vtkViewBlocksWriter.h"

#include "Common/AtomicOutput.h"
#include "Common/Error.h"
#include "Data/ViewBlocks.h"
#include "Files/NameEncoding.h"
#include "RunWriter.h"

#include <vtkErrorCode.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkXMLMultiBlockDataWriter.h>

#include <filesystem>

vtkStandardNewMacro(vtkViewBlocksWriter);

int vtkViewBlocksWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkMultiBlockDataSet");
  return 1;
}

void vtkViewBlocksWriter::WriteData()
{
  this->SetErrorCode(freespace::RunWriter(this,
    [&]
    {
      if (std::filesystem::path(this->FileName).extension() != ".vtm")
      {
        throw freespace::Error(
          "Cannot write '" + this->FileName + "': the name of a file of views ends in .vtm.");
      }
      freespace::AtomicOutput target(this->FileName);
      auto* blocks = vtkMultiBlockDataSet::SafeDownCast(this->GetInput());
      if (!blocks)
      {
        throw freespace::Error("Cannot write " + this->FileName + ": there are no views.");
      }
      vtkNew<vtkXMLMultiBlockDataWriter> writer;
      writer->SetInputDataObject(freespace::WithNames(blocks, freespace::Utf8FromName));
      writer->SetFileName(target.Path().c_str());
      // As fast as the disk: zlib and base64 take longer than all that made the maps.
      writer->SetCompressorTypeToLZ4();
      writer->EncodeAppendedDataOff();
      if (!writer->Write() || writer->GetErrorCode() != vtkErrorCode::NoError)
      {
        throw target.Failure();
      }
      target.Commit();
    }));
}

void vtkViewBlocksWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
}
