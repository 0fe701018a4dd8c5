// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_WrongImagesOption_h
#define freespace_WrongImagesOption_h

#include <CLI/CLI.hpp>

namespace freespace
{

/// --wrong-images: whether images that contradict the others are left out. Stages of one command share it.
class WrongImagesOption
{
public:
  void AddTo(CLI::App& command, const std::string& group);
  bool AreDropped() const;

private:
  CLI::Option* Option = nullptr;
};

}

#endif
