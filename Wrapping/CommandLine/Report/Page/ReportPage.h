// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ReportPage_h
#define freespace_ReportPage_h

#include "Report/Page/DataUri.h"

#include <optional>
#include <string>
#include <vector>

namespace freespace
{

/// All text of these is plain: the page escapes it.

/// A number that is shown large: "6 clusters".
struct ReportFact
{
  std::string value;
  std::string label;
};

struct ReportPicture
{
  InlinePicture picture;
  std::string alt; ///< what is seen, for those who do not see it
};

/// A view's image and its features over it.
struct ReportView
{
  std::string name;
  std::string caption;
  ReportPicture photograph;
  ReportPicture features;
};

/// A table; the first column names the row, the others are numbers.
struct ReportTable
{
  std::string caption;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  bool totalLast = false; ///< whether the last row sums up the others
  std::vector<std::string> notes;
};

struct ReportCommand
{
  std::string what; ///< what it does
  std::string line; ///< as one gives it to a shell
};

/// The content of the page.
struct Report
{
  std::string title;
  std::string summary; ///< one or two sentences
  std::vector<ReportFact> facts;
  std::string model; ///< JSON for the viewer (ViewerModel.h)
  std::string modelCaption;
  std::vector<ReportView> views;
  std::string viewsCaption;
  std::string cameras; ///< an SVG element (CameraDrawing.h), taken as it is
  std::string camerasCaption;
  std::vector<ReportPicture> features;
  std::vector<ReportPicture> surface;
  std::vector<ReportPicture> textured;
  std::vector<ReportTable> numbers;
  std::optional<ReportTable> truth; ///< where the scene has one
  std::vector<ReportCommand> commands;
  std::string footer;
};

/// The page, self-contained: style, pictures and scripts are embedded.
std::string WriteReportPage(const Report& report);

/// "12,345".
std::string FormatCount(long long count);

/// Three significant digits, without an exponent.
std::string FormatNumber(double value);

/// "97.2 %" of a share of 1.
std::string FormatShare(double share);

/// "0.42 s", "12.3 s", "3 min 20 s".
std::string FormatSeconds(double seconds);

}

#endif
