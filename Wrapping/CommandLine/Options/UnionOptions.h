// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_UnionOptions_h
#define freespace_UnionOptions_h

#include "Freespace/FreespaceUnion.h"
#include "Options/RegionOption.h"

#include <CLI/CLI.hpp>

#include <string>

namespace freespace
{

/// --region, --hull-margin and --min-views: the options of the union of the free spaces, for all commands
/// that use it.
class UnionOptions
{
public:
  void AddTo(CLI::App& command, const std::string& group = "Options");

  /// Sets them on a vtkFreespaceUnion, or a class with the same methods. The number of cells of the lattice
  /// fixes the automatic margin; 0 where the lattice is automatic, too.
  template <typename Target>
  void SetUp(Target* target, int cells = 0) const
  {
    this->Region.SetUp(target);
    target->SetHullMargin(this->MarginFor(cells));
    target->SetMinimumViews(this->Views());
    target->SetContradiction(this->Contradiction);
  }

private:
  double MarginFor(int cells) const;
  int Views() const;

  RegionOption Region;
  double HullMargin = -1; // below 0: automatic
  std::string MinimumViews = "auto";
  double Contradiction = FreespaceUnionOptions().contradiction;
};

}

#endif
