// SPDX-License-Identifier: BSD-3-Clause
// From images to a surface: ReconstructScene SCENE.json OUT.ply [CELLS]
#include <vtkDelaunayDisparityFilter.h>
#include <vtkEdgeStereoReader.h>
#include <vtkFreespaceSurfaceFilter.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkSurfaceWriter.h>

#include <cstdlib>
#include <iostream>

int main(int argc, char* argv[])
{
  if (argc < 3)
  {
    std::cerr << "usage: ReconstructScene SCENE.json OUT.ply [CELLS]\n";
    return 2;
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

  vtkNew<vtkFreespaceSurfaceFilter> surface;
  surface->SetInputConnection(maps->GetOutputPort());
  if (argc > 3)
  {
    surface->SetCells(std::atoi(argv[3]));
  }
  vtkNew<vtkSurfaceWriter> writer;
  writer->SetInputConnection(surface->GetOutputPort());
  writer->SetFileName(argv[2]);
  return writer->Write() ? 0 : 1;
}
