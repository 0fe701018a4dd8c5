// SPDX-License-Identifier: BSD-3-Clause
#include "Options/EdgeThresholds.h"

#include "Session/NumberValidators.h"
#include "Stereo/EdgeStereo.h"

#include <vtkEdgeStereoReader.h>

namespace freespace
{

EdgeThresholds::EdgeThresholds()
{
  const EdgeStereoOptions options;
  this->Smoothing = options.edges.smoothing;
  this->LowContrast = options.edges.lowContrast;
  this->HighContrast = options.edges.highContrast;
  this->Tolerance = options.matching.tolerance;
  this->MinimumAngle = options.matching.minimumAngle;
  this->ColorTolerance = options.matching.colorTolerance;
  this->MinimumRun = options.matching.minimumRun;
}

void EdgeThresholds::AddTo(CLI::App& command, const std::string& group)
{
  const auto add = [&](
                     const char* name, double& value, const char* help, const CLI::Validator& check)
  { command.add_option(name, value, help)->check(check)->capture_default_str()->group(group); };
  add("--smoothing", this->Smoothing, "Sigma of the Gaussian of the edge detector, pixels",
    Positive());
  add("--low-contrast", this->LowContrast,
    "Minimum gradient of an edge pixel, grey levels per pixel", Positive());
  add("--high-contrast", this->HighContrast,
    "Gradient that a chain of edge pixels must reach somewhere, grey levels per pixel; not below "
    "--low-contrast",
    Positive());
  add("--match-tolerance", this->Tolerance,
    "Maximum distance of an edge from where two other images predict it, pixels", Positive());
  add("--edge-angle", this->MinimumAngle,
    "Minimum angle between an edge and the epipolar line, degrees", Between(0.01, 89.99));
  add("--color-tolerance", this->ColorTolerance,
    "Maximum mean difference of the colours on the more similar side of an edge, grey levels",
    Positive());
  command
    .add_option(
      "--min-run", this->MinimumRun, "Minimum number of consecutive pixels of an edge that match")
    ->check(CLI::Range(1, 1000000))
    ->capture_default_str()
    ->group(group);
}

void EdgeThresholds::SetUp(vtkEdgeStereoReader* reader) const
{
  reader->SetSmoothing(this->Smoothing);
  reader->SetLowContrast(this->LowContrast);
  reader->SetHighContrast(this->HighContrast);
  reader->SetTolerance(this->Tolerance);
  reader->SetMinimumAngle(this->MinimumAngle);
  reader->SetColorTolerance(this->ColorTolerance);
  reader->SetMinimumRun(this->MinimumRun);
}

}
