// SPDX-License-Identifier: BSD-3-Clause
#include "Output/ViewFiles.h"

#include "Common/Error.h"
#include "Files/FileExtension.h"
#include "Output/SurfaceFiles.h"
#include "Session/Session.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkViewBlocksReader.h>
#include <vtkViewBlocksWriter.h>

namespace freespace
{

namespace
{

vtkIdType CountTriangles(vtkMultiBlockDataSet* views)
{
  vtkIdType triangles = 0;
  for (unsigned int i = 0; i < views->GetNumberOfBlocks(); ++i)
  {
    auto* view = vtkPolyData::SafeDownCast(views->GetBlock(i));
    triangles += view ? view->GetNumberOfPolys() : 0;
  }
  return triangles;
}

}

vtkSmartPointer<vtkMultiBlockDataSet> ReadViews(Session& session, const std::string& fileName)
{
  vtkNew<vtkViewBlocksReader> reader;
  reader->SetFileName(fileName);
  session.Run(reader, "read");
  return reader->GetOutput();
}

vtkSmartPointer<vtkMultiBlockDataSet> ReadFeatures(Session& session, const std::string& fileName)
{
  vtkSmartPointer<vtkMultiBlockDataSet> features = ReadViews(session, fileName);
  if (CountTriangles(features) > 0)
  {
    throw Error("'" + fileName +
      "' holds disparity maps, which are triangulated already: 'freespace contour' takes them.");
  }
  return features;
}

vtkSmartPointer<vtkMultiBlockDataSet> ReadMaps(Session& session, const std::string& fileName)
{
  vtkSmartPointer<vtkMultiBlockDataSet> maps = ReadViews(session, fileName);
  if (CountTriangles(maps) == 0 && maps->GetNumberOfPoints() > 0)
  {
    throw Error("'" + fileName +
      "' holds features, not disparity maps: run 'freespace triangulate' on it first.");
  }
  return maps;
}

void CheckViewsName(const std::string& fileName)
{
  CheckOutputFolder(fileName);
  if (LowerCaseExtension(fileName) != ".vtm")
  {
    throw Error("Cannot write '" + fileName + "': the name of a file of views ends in .vtm.");
  }
}

void WriteViews(Session& session, vtkMultiBlockDataSet* views, const std::string& fileName)
{
  vtkNew<vtkViewBlocksWriter> writer;
  writer->SetInputDataObject(views);
  writer->SetFileName(fileName);
  session.Write(writer);
  session.Log("wrote " + fileName);
}

}
