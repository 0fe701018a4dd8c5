// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_EdgeThresholds_h
#define freespace_EdgeThresholds_h

#include "Stereo/EdgeStereo.h"

#include <CLI/CLI.hpp>

#include <string>

class vtkEdgeStereoReader;

namespace freespace
{

/// The options for the thresholds of the edge stereo: of edges in an image, and of their matches.
class EdgeThresholds
{
public:
  void AddTo(CLI::App& command, const std::string& group);
  void SetUp(vtkEdgeStereoReader* reader) const;

private:
  EdgeStereoOptions Options;
};

}

#endif
