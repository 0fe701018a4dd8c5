// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ReportNumbers_h
#define freespace_ReportNumbers_h

#include "Report/Page/ReportPage.h"
#include "Report/StageCache.h"
#include "Report/TruthComparison.h"

namespace freespace
{

/// The tables of a report.

/// Each view's features, what the minimum disparity constraint brought in, and triangles.
ReportTable ViewTable(vtkMultiBlockDataSet* features, vtkMultiBlockDataSet* maps);

/// What the stages chose by themselves; without rows where they chose nothing.
ReportTable ChoiceTable(const std::vector<StageTime>& stages);

/// The surface: vertices, triangles, size.
ReportTable SurfaceTable(vtkPolyData* surface);

/// The time of each stage.
ReportTable TimeTable(const std::vector<StageTime>& times);

/// The figures against the truth, with what they mean.
ReportTable TruthTable(const TruthFigures& figures, std::size_t cameras);

/// How many features of other views are in the maps.
long long InsertedFeatures(vtkMultiBlockDataSet* maps);

}

#endif
