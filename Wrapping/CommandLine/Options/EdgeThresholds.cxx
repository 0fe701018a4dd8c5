// SPDX-License-Identifier: BSD-3-Clause
#include "Options/EdgeThresholds.h"

#include "Session/NumberValidators.h"

#include <vtkEdgeStereoReader.h>

namespace freespace
{

void EdgeThresholds::AddTo(CLI::App& command, const std::string& group)
{
  const auto add = [&](
                     const char* name, double& value, const char* help, const CLI::Validator& check)
  { command.add_option(name, value, help)->check(check)->capture_default_str()->group(group); };
  add("--smoothing", this->Options.edges.smoothing,
    "Sigma of the Gaussian of the edge detector, pixels", Positive());
  add("--low-contrast", this->Options.edges.lowContrast,
    "Minimum gradient of an edge pixel, grey levels per pixel", Positive());
  add("--high-contrast", this->Options.edges.highContrast,
    "Gradient that a chain of edge pixels must reach somewhere, grey levels per pixel; not below "
    "--low-contrast",
    Positive());
  add("--match-tolerance", this->Options.matching.tolerance,
    "Maximum distance of an edge from where two other images predict it, pixels", Positive());
  add("--edge-angle", this->Options.matching.minimumAngle,
    "Minimum angle between an edge and the epipolar line, degrees", Between(0.01, 89.99));
  add("--color-tolerance", this->Options.matching.colorTolerance,
    "Maximum mean difference of the colours on the more similar side of an edge, grey levels",
    Positive());
  command
    .add_option("--min-run", this->Options.matching.minimumRun,
      "Minimum number of consecutive pixels of an edge that match")
    ->check(CLI::Range(1, 1000000))
    ->capture_default_str()
    ->group(group);
}

void EdgeThresholds::SetUp(vtkEdgeStereoReader* reader) const
{
  reader->SetSmoothing(this->Options.edges.smoothing);
  reader->SetLowContrast(this->Options.edges.lowContrast);
  reader->SetHighContrast(this->Options.edges.highContrast);
  reader->SetTolerance(this->Options.matching.tolerance);
  reader->SetMinimumAngle(this->Options.matching.minimumAngle);
  reader->SetColorTolerance(this->Options.matching.colorTolerance);
  reader->SetMinimumRun(this->Options.matching.minimumRun);
}

}
