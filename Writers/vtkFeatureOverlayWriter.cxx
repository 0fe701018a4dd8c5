// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFeatureOverlayWriter.h"

#include "Data/SilhouetteBlocks.h"
#include "Data/ViewBlocks.h"
#include "Data/ViewInput.h"
#include "Execution/AlgorithmProgress.h"
#include "Files/FileNames.h"
#include "Images/FeatureOverlay.h"
#include "RunWriter.h"

#include <vtkCellArray.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <filesystem>

vtkStandardNewMacro(vtkFeatureOverlayWriter);

namespace
{

std::vector<std::vector<int>> ChainsOf(vtkPolyData* block)
{
  std::vector<std::vector<int>> chains;
  vtkCellArray* lines = block->GetLines();
  for (vtkIdType cell = 0; cell < lines->GetNumberOfCells(); ++cell)
  {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    lines->GetCellAtId(cell, size, ids);
    chains.emplace_back(ids, ids + size);
  }
  return chains;
}

void MakeFolder(const std::string& folder)
{
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
  {
    throw freespace::Error("Cannot make the folder " + folder + ": " + error.message() + ".");
  }
}

}

int vtkFeatureOverlayWriter::FillInputPortInformation(int, vtkInformation* info)
{
  freespace::AcceptViews(info);
  return 1;
}

void vtkFeatureOverlayWriter::WriteData()
{
  this->SetErrorCode(freespace::RunWriter(this, this->OutputFolder,
    [&]
    {
      if (this->OutputFolder.empty())
      {
        throw freespace::Error("Cannot write pictures: their folder has no name.");
      }
      const freespace::Progress progress = freespace::AlgorithmProgress(this);
      const auto blocks = freespace::WithoutSilhouettes(freespace::ViewsOf(this->GetInput()));
      const std::vector<freespace::View> views = freespace::ViewsFromBlocks(blocks);
      std::vector<std::string> names;
      for (const freespace::View& view : views)
      {
        names.push_back(view.name);
      }
      names = freespace::FileNamesOf(names);
      MakeFolder(this->OutputFolder);
      for (std::size_t i = 0; i < views.size(); ++i)
      {
        progress(static_cast<double>(i) / views.size());
        auto* block = vtkPolyData::SafeDownCast(blocks->GetBlock(static_cast<unsigned int>(i)));
        freespace::WriteFeatureOverlay(views[i], ChainsOf(block), this->ImagesFolder,
          (std::filesystem::path(this->OutputFolder) / (names[i] + ".png")).string());
      }
    }));
}

void vtkFeatureOverlayWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ImagesFolder: " << this->ImagesFolder << "\n";
  os << indent << "OutputFolder: " << this->OutputFolder << "\n";
}
