// SPDX-License-Identifier: BSD-3-Clause
// From images to a surface: ReconstructScene SCENE.json OUT.ply [CELLS]
#include <vtkDelaunayDisparityFilter.h>
#include <vtkEdgeStereoReader.h>
#include <vtkFreespaceSurfaceFilter.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkSurfaceWriter.h>

#include <charconv>
#include <cstring>
#include <iostream>
#include <system_error>

int main(int argc, char* argv[])
{
  if (argc < 3)
  {
    std::cerr << "usage: ReconstructScene SCENE.json OUT.ply [CELLS]\n";
    return 2;
  }
  vtkNew<vtkFreespaceSurfaceFilter> surface;
  if (argc > 3)
  {
    int cells = 0;
    const char* end = argv[3] + std::strlen(argv[3]);
    const auto [stop, code] = std::from_chars(argv[3], end, cells);
    if (code != std::errc() || stop != end)
    {
      std::cerr << "CELLS: '" << argv[3] << "' is not a whole number\n";
      return 2;
    }
    surface->SetCells(cells);
  }
  vtkNew<vtkEdgeStereoReader> stereo;
  stereo->SetFileName(argv[1]);
  vtkNew<vtkDelaunayDisparityFilter> maps;
  maps->SetInputConnection(stereo->GetOutputPort());
  maps->Update();
  if (maps->GetOutput()->GetNumberOfBlocks() == 0)
  {
    return 1; // VTK has printed why
  }
  std::cout << maps->GetOutput()->GetNumberOfBlocks() << " disparity maps, "
            << maps->GetOutput()->GetNumberOfPoints() << " points\n";

  surface->SetInputConnection(maps->GetOutputPort());
  vtkNew<vtkSurfaceWriter> writer;
  writer->SetInputConnection(surface->GetOutputPort());
  writer->SetFileName(argv[2]);
  return writer->Write() ? 0 : 1;
}
