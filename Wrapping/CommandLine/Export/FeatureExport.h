// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_FeatureExport_h
#define freespace_FeatureExport_h

#include <vtkSmartPointer.h>

#include <string>

class vtkMultiBlockDataSet;
class vtkPolyData;

namespace freespace
{

/// The features of all views, a vertex each, with the point data View (int, the number of its block) and, where all
/// views have them, RGB.
vtkSmartPointer<vtkPolyData> FeaturePoints(vtkMultiBlockDataSet* views);

/// The same with the chains of the views as polylines instead. Features of no chain are left out.
vtkSmartPointer<vtkPolyData> FeatureChains(vtkMultiBlockDataSet* views);

/// The features as rows of a table: view, x, y, z, pixel_x, pixel_y, depth, the colours where they are and each other
/// array of one number.
std::string FeatureRows(vtkMultiBlockDataSet* views);

/// Cameras as frusta of a depth, or one that suits them for 0, with the cell data Camera (int), and their
/// names as the field data Cameras.
vtkSmartPointer<vtkPolyData> Frusta(vtkMultiBlockDataSet* cameras, double depth);

}

#endif
