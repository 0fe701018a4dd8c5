// SPDX-License-Identifier: BSD-3-Clause
#include "XML/XMLFileCheck.h"

#include "Common/Error.h"
#include "Common/ParseNumber.h"
#include "Text/TextSource.h"
#include "XML/XMLArrayHeader.h"

#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkXMLParser.h>

#include <algorithm>
#include <cstring>
#include <string_view>

namespace freespace
{

namespace
{

constexpr int deepest = 16; // elements in elements; a .vtp has 5
constexpr std::string_view appendedTag = "<AppendedData";

/// Walks over the elements of a file without keeping them.
class ElementWalk : public vtkXMLParser
{
public:
  static ElementWalk* New();
  vtkTypeMacro(ElementWalk, vtkXMLParser);

  std::string Fault; ///< the first one, as a clause
  std::vector<std::string> Files;
  std::vector<double> Offsets; ///< of arrays in the appended section
  bool IsCompressed = false;
  bool HasLongHeader = false; ///< UInt64 in place of UInt32
  bool IsAppendedText = false;
  std::size_t Length = 0;

  void Finish()
  {
    if (this->GreatestIndex >= static_cast<double>(std::max<std::size_t>(this->Datasets, 1)))
    {
      this->Tell("a block has an index beyond the number of blocks");
    }
    const double most = static_cast<double>(this->Length) *
      (this->IsCompressed ? ArrayHeader::mostCompressed : 4); // "0 " is a number of 8 bytes
    if (!(this->DeclaredBytes <= most + 4096))
    {
      this->Tell("it is truncated, or counts more values than it holds");
    }
  }

protected:
  void StartElement(const char* name, const char** attributes) override
  {
    if (++this->Depth > deepest)
    {
      this->Tell("its elements are nested too deeply");
      return;
    }
    if (this->Depth == 1 && std::strcmp(name, "VTKFile") != 0)
    {
      this->Tell("it is not a file of VTK");
    }
    this->Attributes = attributes;
    this->Take(name);
  }

  void EndElement(const char*) override
  {
    if (this->IsInArray && !this->InlineText.empty())
    {
      const ArrayHeader header{ this->InlineText, true, this->IsCompressed, this->HasLongHeader };
      if (!header.Fits(this->InlineLength))
      {
        this->Tell("it is truncated, or counts more values than it holds");
      }
    }
    this->IsInArray = false;
    --this->Depth;
  }

  void CharacterDataHandler(const char* data, int length) override
  {
    for (int i = 0; i < length && this->IsInArray; ++i)
    {
      if (std::strchr(" \t\r\n", data[i]) == nullptr)
      {
        ++this->InlineLength;
        if (this->InlineText.size() < ArrayHeader::mostText)
        {
          this->InlineText.push_back(data[i]);
        }
      }
    }
  }

  void ReportXmlParseError() override { this->Tell("it is truncated or not a file of VTK"); }

private:
  void Tell(const std::string& fault)
  {
    if (this->Fault.empty())
    {
      this->Fault = fault;
    }
  }

  std::string_view Attribute(const char* name) const
  {
    for (const char** at = this->Attributes; at && at[0]; at += 2)
    {
      if (std::strcmp(at[0], name) == 0)
      {
        return at[1];
      }
    }
    return {};
  }

  // An attribute that counts something; 0 without it.
  double Count(const char* name)
  {
    std::string_view text = this->Attribute(name);
    while (!text.empty() && text.front() == ' ')
    {
      text.remove_prefix(1);
    }
    if (text.empty())
    {
      return 0;
    }
    const auto value = ParseNumber<double>(text);
    if (!value || !(*value >= 0 && *value < 1e15))
    {
      this->Tell("its attribute " + std::string(name) + " is no count");
      return 0;
    }
    return *value;
  }

  void Take(const std::string_view name)
  {
    if (name == "VTKFile")
    {
      this->IsCompressed = !this->Attribute("compressor").empty();
      this->HasLongHeader = this->Attribute("header_type") == "UInt64";
    }
    else if (name == "Piece")
    {
      this->Points = this->Count("NumberOfPoints");
      this->Cells = 0;
      for (const char* kind :
        { "NumberOfVerts", "NumberOfLines", "NumberOfStrips", "NumberOfPolys", "NumberOfCells" })
      {
        this->Cells += this->Count(kind);
      }
      this->DeclaredBytes += 8 * this->Cells;
    }
    else if (name == "PointData" || name == "Points" || name == "CellData")
    {
      this->Tuples = name == "CellData" ? this->Cells : this->Points;
    }
    else if (name == "FieldData" || name == "Polys" || name == "Verts" || name == "Lines" ||
      name == "Strips")
    {
      this->Tuples = 0;
    }
    else if (name == "DataArray" || name == "Array")
    {
      this->TakeArray();
    }
    else if (name == "AppendedData")
    {
      this->IsAppendedText = this->Attribute("encoding") != "raw";
    }
    else if (name == "DataSet" || name == "Block")
    {
      this->TakeBlock();
    }
  }

  void TakeArray()
  {
    const double components = std::max(this->Count("NumberOfComponents"), 1.0);
    const double tuples = std::max(this->Tuples, this->Count("NumberOfTuples"));
    const std::string_view type = this->Attribute("type");
    const double size = type.find("64") != std::string_view::npos ? 8
      : type.find("32") != std::string_view::npos                 ? 4
      : type.find("16") != std::string_view::npos                 ? 2
                                                                  : 1;
    this->DeclaredBytes += tuples * components * size;
    const std::string_view format = this->Attribute("format");
    if (format == "appended")
    {
      this->Offsets.push_back(this->Count("offset"));
    }
    this->IsInArray = format == "binary";
    this->InlineText.clear();
    this->InlineLength = 0;
  }

  void TakeBlock()
  {
    ++this->Datasets;
    this->GreatestIndex = std::max(this->GreatestIndex, this->Count("index"));
    if (const std::string_view file = this->Attribute("file"); !file.empty())
    {
      this->Files.emplace_back(file);
    }
  }

  int Depth = 0;
  const char** Attributes = nullptr;
  std::size_t Datasets = 0;
  double GreatestIndex = -1;
  double Points = 0, Cells = 0, Tuples = 0;
  double DeclaredBytes = 0;
  bool IsInArray = false; ///< whose values are inline, in base64
  std::string InlineText; ///< the first of them
  std::size_t InlineLength = 0;
};

vtkStandardNewMacro(ElementWalk);

// The elements, a piece at a time so that a fault ends it.
void Walk(ElementWalk* walk, std::string_view text)
{
  constexpr std::size_t piece = 1 << 16;
  vtkNew<vtkCallbackCommand> silence;
  walk->AddObserver(vtkCommand::ErrorEvent, silence);
  walk->AddObserver(vtkCommand::WarningEvent, silence);
  bool isRead = walk->InitializeParser() != 0;
  for (; isRead && walk->Fault.empty() && !text.empty();
       text.remove_prefix(std::min(piece, text.size())))
  {
    const auto length = static_cast<unsigned int>(std::min(piece, text.size()));
    isRead = walk->ParseChunk(text.data(), length) != 0;
  }
  if (isRead && walk->Fault.empty())
  {
    isRead = walk->CleanupParser() != 0;
  }
  else
  {
    walk->CleanupParser();
  }
  if (!isRead && walk->Fault.empty())
  {
    walk->Fault = "it is truncated or not a file of VTK";
  }
}

// The arrays of an appended section lie in it with all their bytes.
void CheckAppended(ElementWalk* walk, std::string_view section)
{
  const std::size_t begin = section.find('_');
  const std::size_t end = section.rfind("</AppendedData>");
  if (begin == std::string_view::npos || end == std::string_view::npos || end <= begin)
  {
    walk->Fault = "it is truncated or not a file of VTK";
    return;
  }
  section = section.substr(begin + 1, end - begin - 1);
  for (double offset : walk->Offsets)
  {
    const double left = static_cast<double>(section.size()) - offset;
    const std::string_view text =
      section.substr(left > 0 ? static_cast<std::size_t>(offset) : section.size());
    const ArrayHeader header{ text, walk->IsAppendedText, walk->IsCompressed, walk->HasLongHeader };
    if (!header.Fits(text.size()))
    {
      walk->Fault = "it is truncated: its appended section ends before its arrays";
      return;
    }
  }
}

bool AreCellsOf(vtkCellArray* cells, vtkIdType points)
{
  vtkDataArray* offsets = cells->GetOffsetsArray();
  const auto ids = static_cast<double>(cells->GetNumberOfConnectivityIds());
  double last = 0;
  for (vtkIdType i = 0; i < offsets->GetNumberOfValues(); ++i)
  {
    const double offset = offsets->GetComponent(i, 0);
    if (!(offset >= last && offset <= ids) || (i == 0 && offset != 0))
    {
      return false;
    }
    last = offset;
  }
  vtkIdType size = 0;
  const vtkIdType* corners = nullptr;
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
  {
    cells->GetCellAtId(cell, size, corners);
    if (!std::all_of(
          corners, corners + size, [points](vtkIdType id) { return id >= 0 && id < points; }))
    {
      return false;
    }
  }
  return true;
}

}

std::vector<std::string> CheckXMLFile(const std::string& fileName)
{
  return CheckXMLContent(ReadWholeFile(fileName), fileName);
}

std::vector<std::string> CheckXMLContent(const std::string& content, const std::string& fileName)
{
  vtkNew<ElementWalk> walk;
  walk->Length = content.size();
  const std::string_view all(content);
  const std::size_t appended = all.find(appendedTag);
  const std::size_t tagEnd =
    appended == std::string_view::npos ? appended : all.find('>', appended);
  if (tagEnd == std::string_view::npos)
  {
    Walk(walk, all);
  }
  else
  {
    Walk(walk, std::string(all.substr(0, tagEnd + 1)) + "</AppendedData></VTKFile>");
    if (walk->Fault.empty())
    {
      CheckAppended(walk, all.substr(tagEnd + 1));
    }
  }
  if (walk->Fault.empty() &&
    all.find("</VTKFile>", all.size() - std::min<std::size_t>(all.size(), 64)) ==
      std::string_view::npos)
  {
    walk->Fault = "it is truncated or not a file of VTK";
  }
  walk->Finish();
  if (!walk->Fault.empty())
  {
    throw Error("Cannot read " + fileName + ": " + walk->Fault + ".");
  }
  return walk->Files;
}

void CheckCells(vtkPolyData* surface, const std::string& fileName)
{
  const vtkIdType points = surface->GetNumberOfPoints();
  for (vtkCellArray* cells :
    { surface->GetVerts(), surface->GetLines(), surface->GetPolys(), surface->GetStrips() })
  {
    if (cells && !AreCellsOf(cells, points))
    {
      throw Error(
        "Cannot read " + fileName + ": it has a cell with a corner that is none of its points.");
    }
  }
}

}
