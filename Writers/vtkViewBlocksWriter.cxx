// SPDX-License-Identifier: BSD-3-Clause
#include "vtkViewBlocksWriter.h"

#include "Files/AtomicOutput.h"
#include "Common/Error.h"
#include "Data/ViewBlocks.h"
#include "Data/ViewInput.h"
#include "Files/NameEncoding.h"
#include "RunWriter.h"

#include <vtkErrorCode.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkXMLMultiBlockDataWriter.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

vtkStandardNewMacro(vtkViewBlocksWriter);

namespace
{

// VTK numbers the files of the blocks from 0. Where such are there from a former run, the new ones get other
// numbers, so that the .vtm refers to the old or to the new ones at any moment.
void NumberParts(freespace::AtomicOutput& target, const std::string& fileName)
{
  namespace fs = std::filesystem;
  const std::string stem = fs::path(target.Path()).stem().string();
  const fs::path folder = fs::path(target.Path()).replace_extension();
  if (!fs::is_directory(folder))
  {
    return;
  }
  const auto parts =
    static_cast<int>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  const int first = target.FirstFreePart(parts);
  if (first == 0)
  {
    return;
  }
  std::ostringstream text;
  text << std::ifstream(target.Path(), std::ios::binary).rdbuf();
  std::string index = text.str();
  const auto nameOf = [&stem](int number) { return stem + "_" + std::to_string(number) + ".vtp"; };
  std::size_t at = 0;
  for (int i = 0; i < parts; ++i)
  {
    const std::string old = "/" + nameOf(i) + "\"";
    at = index.find(old, at);
    if (at == std::string::npos)
    {
      throw freespace::Error("Cannot write " + fileName + ": VTK gave its parts other names.");
    }
    const std::string changed = "/" + nameOf(first + i) + "\"";
    index.replace(at, old.size(), changed);
    at += changed.size();
  }
  for (int i = parts - 1; i >= 0; --i)
  {
    fs::rename(folder / nameOf(i), folder / nameOf(first + i));
  }
  target.Write(index.data(), index.size());
}

}

int vtkViewBlocksWriter::FillInputPortInformation(int, vtkInformation* info)
{
  freespace::AcceptViews(info);
  return 1;
}

void vtkViewBlocksWriter::WriteData()
{
  this->SetErrorCode(freespace::RunWriter(this, this->FileName,
    [&]
    {
      if (std::filesystem::path(this->FileName).extension() != ".vtm")
      {
        throw freespace::Error(
          "Cannot write '" + this->FileName + "': the name of a file of views ends in .vtm.");
      }
      freespace::AtomicOutput target(this->FileName);
      const auto blocks = freespace::ViewsOf(this->GetInput());
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
      if (this->InlineArrays)
      {
        writer->SetDataModeToBinary();
      }
      if (!writer->Write() || writer->GetErrorCode() != vtkErrorCode::NoError)
      {
        throw target.Failure();
      }
      NumberParts(target, this->FileName);
      target.Commit();
    }));
}

void vtkViewBlocksWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
  os << indent << "InlineArrays: " << this->InlineArrays << "\n";
}
