// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SupportOption_h
#define freespace_SupportOption_h

#include <CLI/CLI.hpp>

#include <string>

namespace freespace
{

/// --support and --sharing-views: which features are outliers for lack of support (OutlierOptions). Stages of one
/// command share them.
class SupportOption
{
public:
  void AddTo(CLI::App& command, const std::string& group);
  int Support() const;
  int SharingViews() const;

private:
  CLI::Option* Least = nullptr;
  CLI::Option* Sharing = nullptr;
};

}

#endif
