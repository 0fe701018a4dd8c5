// SPDX-License-Identifier: BSD-3-Clause
#include "Matching/RunFilter.h"

#include <algorithm>

namespace freespace
{

namespace
{

constexpr double Radius = 24;       // of a token's surroundings, pixels
constexpr std::size_t LongRun = 20; // tokens

// The tokens of accepted runs, by square cells as wide as the radius.
class AcceptedTokens
{
public:
  AcceptedTokens(
    const LargeVector<EdgeMatch>& matches, double baseline, const MatcherOptions& options)
    : Matches(matches)
    , Baseline(baseline)
    , Options(options)
  {
  }

  void Add(int token)
  {
    const auto [column, row] = this->CellOf(token);
    this->Rows = std::max(this->Rows, row + 1);
    this->Columns.resize(std::max<std::size_t>(this->Columns.size(), row + 1));
    auto& cells = this->Columns[row];
    cells.resize(std::max<std::size_t>(cells.size(), column + 1));
    cells[column].push_back(token);
  }

  bool Support(int token) const
  {
    const auto [column, row] = this->CellOf(token);
    for (int r = std::max(0, row - 1); r <= std::min(this->Rows - 1, row + 1); ++r)
    {
      const auto& cells = this->Columns[r];
      const int last = std::min(static_cast<int>(cells.size()) - 1, column + 1);
      for (int c = std::max(0, column - 1); c <= last; ++c)
      {
        if (std::any_of(cells[c].begin(), cells[c].end(),
              [&](int other) { return this->Agree(token, other); }))
        {
          return true;
        }
      }
    }
    return false;
  }

private:
  std::pair<int, int> CellOf(int token) const
  {
    const Eigen::Vector2d& pixel = this->Matches[token].imagePoint;
    return { static_cast<int>(std::max(0.0, pixel.x() / Radius)),
      static_cast<int>(std::max(0.0, pixel.y() / Radius)) };
  }

  bool Agree(int token, int other) const
  {
    const double slack = 1.5 * this->Options.tolerance; // pixels of the longest baseline
    const EdgeMatch &a = this->Matches[token], &b = this->Matches[other];
    const double distance = (a.imagePoint - b.imagePoint).norm();
    return distance <= Radius &&
      std::abs(a.disparity - b.disparity) * this->Baseline <=
      slack + this->Options.gradientLimit * distance;
  }

  const LargeVector<EdgeMatch>& Matches;
  double Baseline;
  const MatcherOptions& Options;
  int Rows = 0;
  std::vector<std::vector<std::vector<int>>> Columns; // per row, per column
};

}

void DropLonelyRuns(const EdgeChains& edges, double baseline, const MatcherOptions& options,
  LargeVector<EdgeMatch>& matches)
{
  std::vector<std::vector<int>> runs;
  for (int i = 0; i < static_cast<int>(edges.tokens.size()); ++i)
  {
    if (matches[i].images > 0)
    {
      runs.resize(std::max<std::size_t>(runs.size(), matches[i].run + 1));
      runs[matches[i].run].push_back(i);
    }
  }
  AcceptedTokens accepted(matches, baseline, options);
  const auto accept = [&](std::vector<int>& run)
  {
    std::for_each(run.begin(), run.end(), [&](int token) { accepted.Add(token); });
    run.clear();
  };
  for (std::vector<int>& run : runs)
  {
    if (run.size() >= LongRun)
    {
      accept(run);
    }
  }
  for (bool changed = true; changed;)
  {
    changed = false;
    for (std::vector<int>& run : runs)
    {
      const auto supported =
        std::count_if(run.begin(), run.end(), [&](int token) { return accepted.Support(token); });
      if (!run.empty() && 2 * static_cast<std::size_t>(supported) >= run.size())
      {
        accept(run);
        changed = true;
      }
    }
  }
  for (const std::vector<int>& run : runs)
  {
    std::for_each(run.begin(), run.end(), [&](int token) { matches[token] = EdgeMatch(); });
  }
}

}
