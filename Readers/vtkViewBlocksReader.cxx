// SPDX-License-Identifier: BSD-3-Clause
#include "vtkViewBlocksReader.h"

#include "Common/Error.h"
#include "Data/ViewBlocks.h"
#include "Text/WholeFile.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLMultiBlockDataReader.h>
#include <vtkXMLUtilities.h>

#include <filesystem>
#include <vector>

vtkStandardNewMacro(vtkViewBlocksReader);

namespace
{

// VTK's reader reports a block that it could not read through error events only.
void CountError(vtkObject*, unsigned long, void* count, void*)
{
  ++*static_cast<int*>(count);
}

// The files of the blocks that a .vtm names, relative to it.
void CollectBlockFiles(vtkXMLDataElement* element, std::vector<std::string>& files)
{
  for (int i = 0; i < element->GetNumberOfNestedElements(); ++i)
  {
    vtkXMLDataElement* nested = element->GetNestedElement(i);
    if (const char* file = nested->GetAttribute("file"))
    {
      files.push_back(file);
    }
    CollectBlockFiles(nested, files);
  }
}

void CheckFilesAreWhole(const std::string& fileName)
{
  freespace::CheckWholeVTKFile(fileName);
  vtkSmartPointer<vtkXMLDataElement> root;
  root.TakeReference(vtkXMLUtilities::ReadElementFromFile(fileName.c_str()));
  std::vector<std::string> files;
  if (root)
  {
    CollectBlockFiles(root, files);
  }
  for (const std::string& file : files)
  {
    freespace::CheckWholeVTKFile((std::filesystem::path(fileName).parent_path() / file).string());
  }
}

vtkSmartPointer<vtkMultiBlockDataSet> ReadWhole(const std::string& fileName)
{
  CheckFilesAreWhole(fileName);
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
  try
  {
    const auto blocks = ReadWhole(this->FileName);
    CheckBlocks(blocks, this->FileName);
    output->ShallowCopy(blocks);
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    output->Initialize();
    return 0;
  }
  return 1;
}

void vtkViewBlocksReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
}
