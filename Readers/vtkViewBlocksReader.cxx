// SPDX-License-Identifier: BSD-3-Clause
#include "vtkViewBlocksReader.h"

#include "Execution/AlgorithmErrors.h"
#include "Common/Error.h"
#include "Data/ViewBlocks.h"
#include "Files/NameEncoding.h"
#include "XML/XMLFileCheck.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkErrorCode.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkXMLMultiBlockDataReader.h>

#include <filesystem>
#include <string>

vtkStandardNewMacro(vtkViewBlocksReader);

namespace
{

// VTK's reader reports a block that it could not read through error events only.
void CountError(vtkObject*, unsigned long, void* count, void*)
{
  ++*static_cast<int*>(count);
}

void CheckFiles(const std::string& fileName)
{
  for (const std::string& file : freespace::CheckXMLFile(fileName))
  {
    freespace::CheckXMLFile((std::filesystem::path(fileName).parent_path() / file).string());
  }
}

vtkSmartPointer<vtkMultiBlockDataSet> ReadWhole(const std::string& fileName)
{
  CheckFiles(fileName);
  int errors = 0;
  vtkNew<vtkCallbackCommand> onError;
  onError->SetCallback(CountError);
  onError->SetClientData(&errors);
  vtkNew<vtkXMLMultiBlockDataReader> reader;
  reader->AddObserver(vtkCommand::ErrorEvent, onError);
  reader->SetReaderErrorObserver(onError);
  reader->SetParserErrorObserver(onError);
  reader->SetFileName(fileName.c_str());
  reader->Update();
  vtkSmartPointer<vtkMultiBlockDataSet> blocks =
    vtkMultiBlockDataSet::SafeDownCast(reader->GetOutputDataObject(0));
  if (errors > 0 || !blocks || blocks->GetNumberOfBlocks() == 0)
  {
    throw freespace::Error(
      "Cannot read " + fileName + ": it or one of its .vtp files is not what VTK's writers make.");
  }
  return blocks;
}

void CheckBlocks(vtkMultiBlockDataSet* blocks, const std::string& fileName)
{
  try
  {
    for (unsigned int i = 0; i < blocks->GetNumberOfBlocks(); ++i)
    {
      if (auto* block = vtkPolyData::SafeDownCast(blocks->GetBlock(i)))
      {
        freespace::CheckCells(block, fileName);
      }
    }
    freespace::ViewsFromBlocks(blocks);
  }
  catch (const freespace::Error& error)
  {
    throw freespace::Error(fileName + ": " + error.what());
  }
}

}

vtkViewBlocksReader::vtkViewBlocksReader()
{
  this->SetNumberOfInputPorts(0);
}

int vtkViewBlocksReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputVector);
  this->SetErrorCode(vtkErrorCode::NoError);
  try
  {
    const auto blocks = freespace::WithNames(ReadWhole(this->FileName), freespace::NameFromUtf8);
    CheckBlocks(blocks, this->FileName);
    output->ShallowCopy(blocks);
  }
  catch (...)
  {
    this->SetErrorCode(freespace::ErrorCodeOf(this->FileName));
    return freespace::AfterException(this);
  }
  return 1;
}

void vtkViewBlocksReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
}
