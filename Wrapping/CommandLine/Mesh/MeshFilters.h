// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_MeshFilters_h
#define freespace_MeshFilters_h

#include <vtkSmartPointer.h>

#include <string>

class vtkPolyData;

namespace freespace
{

class Session;

///@{
/// Each does one operation on a surface of triangles, with VTK's filters and this project's, and returns a new
/// one. The value has been checked by MeshValues.h. Each throws Error when it fails.
vtkSmartPointer<vtkPolyData> Crop(Session& session, const std::string& box, vtkPolyData* surface);
vtkSmartPointer<vtkPolyData> KeepLargest(
  Session& session, const std::string& count, vtkPolyData* surface);
vtkSmartPointer<vtkPolyData> DropCrumbs(
  Session& session, const std::string& area, vtkPolyData* surface);
vtkSmartPointer<vtkPolyData> Smooth(
  Session& session, const std::string& length, vtkPolyData* surface);
vtkSmartPointer<vtkPolyData> Simplify(
  Session& session, const std::string& length, vtkPolyData* surface);
vtkSmartPointer<vtkPolyData> Decimate(
  Session& session, const std::string& count, vtkPolyData* surface);
vtkSmartPointer<vtkPolyData> Fill(Session& session, const std::string& size, vtkPolyData* surface);
vtkSmartPointer<vtkPolyData> Transform(
  Session& session, const std::string& fileName, vtkPolyData* surface);
vtkSmartPointer<vtkPolyData> Scale(
  Session& session, const std::string& factor, vtkPolyData* surface);
vtkSmartPointer<vtkPolyData> Shift(
  Session& session, const std::string& vector, vtkPolyData* surface);
vtkSmartPointer<vtkPolyData> AddNormals(Session& session, const std::string&, vtkPolyData* surface);
vtkSmartPointer<vtkPolyData> ColorFromScene(
  Session& session, const std::string& scene, vtkPolyData* surface);
///@}

}

#endif
