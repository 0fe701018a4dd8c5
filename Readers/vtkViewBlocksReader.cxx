// SPDX-License-Identifier: BSD-3-Clause
#include "vtkViewBlocksReader.h"

#include "Error.h"
#include "ViewBlocks.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLMultiBlockDataReader.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <vector>

vtkStandardNewMacro(vtkViewBlocksReader);

namespace
{

// VTK's reader reports a block that it could not read through error events only.
void CountError(vtkObject*, unsigned long, void* count, void*)
{
  ++*static_cast<int*>(count);
}

// A truncated file may still parse, and VTK's reader is silent where warnings are switched off: look
// for the end of the file.
bool IsWhole(const std::string& fileName)
{
  std::ifstream file(fileName, std::ios::binary | std::ios::ate);
  const std::streamoff size = file ? static_cast<std::streamoff>(file.tellg()) : 0;
  const std::streamoff tail = std::min<std::streamoff>(size, 32);
  std::string end(static_cast<std::size_t>(tail), '\0');
  file.seekg(size - tail);
  file.read(&end[0], tail);
  return file && end.find("</VTKFile>") != std::string::npos;
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
  if (!std::filesystem::is_regular_file(fileName))
  {
    throw freespace::Error("Cannot read " + fileName + ": there is no such file.");
  }
  vtkSmartPointer<vtkXMLDataElement> root;
  if (IsWhole(fileName))
  {
    root.TakeReference(vtkXMLUtilities::ReadElementFromFile(fileName.c_str()));
  }
  if (!root)
  {
    throw freespace::Error("Cannot read " + fileName + ": it is truncated or not a .vtm file.");
  }
  std::vector<std::string> files;
  CollectBlockFiles(root, files);
  for (const std::string& file : files)
  {
    const auto path = std::filesystem::path(fileName).parent_path() / file;
    if (!IsWhole(path.string()))
    {
      throw freespace::Error("Cannot read " + fileName + ": its file " + file
        + " is missing or truncated.");
    }
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
  vtkSmartPointer<vtkMultiBlockDataSet> blocks
    = vtkMultiBlockDataSet::SafeDownCast(reader->GetOutputDataObject(0));
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
