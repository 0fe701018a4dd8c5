// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_PictureOptions_h
#define freespace_PictureOptions_h

#include "Output/Picture.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace freespace
{

/// Options of how a picture looks.
class PictureOptions
{
public:
  /// --size
  void AddSize(CLI::App& command);

  /// --up, --zoom, --background, --edges, --color-by
  void AddLook(CLI::App& command);

  /// --ref, --diff, --max-error
  void AddComparison(CLI::App& command);

  /// The look that the options tell, as far as they are given.
  void Apply(PictureLook& look) const;

  std::optional<std::array<int, 2>> Size() const;

  /// Compares a picture with the reference, where there is one. Throws Error where they differ.
  void Compare(Session& session, const std::string& fileName) const;

private:
  std::string SizeText;
  std::string Up = "+z";
  std::string Background = "1,1,1";
  double Zoom = 1;
  bool Edges = false;
  std::string ColorArray;
  std::string Reference;
  std::string Difference;
  double LargestError = 10;
};

}

#endif
