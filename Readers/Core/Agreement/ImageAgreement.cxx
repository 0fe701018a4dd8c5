// SPDX-License-Identifier: BSD-3-Clause
#include "Agreement/ImageAgreement.h"

#include "Common/Median.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace freespace
{

namespace
{

// What a wrong image shows by chance of the confirmed tokens of another, and the other way round, on the
// mean: up to 0.45 of what a right one does; right ones from 0.5.
constexpr double LeastShown = 0.47;

// A wrong image has less than 0.1 of its neighbours' share of confirmed tokens, or less than 0.5 where a
// pattern repeats.
constexpr double LeastConfirmed = 0.2;

class Consensus
{
public:
  Consensus(std::size_t images, const std::vector<ImageAgreement>& agreements)
    : Agreements(images)
    , Relative(images, 0)
    , Group(images)
  {
    for (const ImageAgreement& agreement : agreements)
    {
      this->Agreements[static_cast<std::size_t>(agreement.image)] = &agreement;
    }
    std::iota(this->Group.begin(), this->Group.end(), 0);
    this->ComparePairs();
    this->JoinGroups();
  }

  Agreement Result() const
  {
    std::vector<int> sizes(this->Group.size(), 0);
    for (std::size_t i = 0; i < this->Group.size(); ++i)
    {
      ++sizes[this->GroupOf(i)];
    }
    std::vector<char> isWrong(this->Group.size(), 0); // per group
    for (const auto& [pair, shown] : this->Shown)
    {
      const std::size_t a = this->GroupOf(pair.first), b = this->GroupOf(pair.second);
      if (a != b && sizes[a] != sizes[b] && shown.Mean() < LeastShown)
      {
        isWrong[sizes[a] < sizes[b] ? a : b] = 1;
      }
    }
    Agreement result;
    for (std::size_t i = 0; i < this->Group.size(); ++i)
    {
      const std::size_t group = this->GroupOf(i);
      (isWrong[group]        ? result.contradicted
          : sizes[group] > 1 ? result.confirmed
                             : result.unknown)
        .push_back(static_cast<int>(i));
    }
    return result;
  }

private:
  // What two images show of each other's confirmed tokens.
  struct Pair
  {
    double sum = 0; // of the fractions
    int ways = 0;   // one or two
    double Mean() const { return this->ways > 0 ? this->sum / this->ways : 0; }
  };

  double Share(std::size_t image) const
  {
    const ImageAgreement* agreement = this->Agreements[image];
    return agreement && agreement->tokens > 0 ? agreement->confirmed / agreement->tokens : 0;
  }

  // Its share of confirmed tokens in that of its neighbours: of an image that stands elsewhere some tokens
  // may be confirmed, by a pattern that repeats, but fewer.
  double RelativeShare(std::size_t image) const
  {
    std::vector<double> shares;
    for (const auto& other : this->Agreements[image]->others)
    {
      shares.push_back(this->Share(static_cast<std::size_t>(other.first)));
    }
    const double usual = Median(std::move(shares));
    return usual > 0 ? this->Share(image) / usual : this->Share(image) > 0;
  }

  bool IsConfirmed(std::size_t image) const { return this->Relative[image] >= LeastConfirmed; }

  void ComparePairs()
  {
    for (std::size_t i = 0; i < this->Agreements.size(); ++i)
    {
      this->Relative[i] = this->Agreements[i] ? std::min(1.0, this->RelativeShare(i)) : 1;
    }
    for (std::size_t i = 0; i < this->Agreements.size(); ++i)
    {
      if (!this->Agreements[i])
      {
        continue;
      }
      if (this->IsConfirmed(i))
      {
        this->CompareWithOthers(*this->Agreements[i]);
      }
    }
    std::vector<std::size_t> contradicted;
    for (std::size_t i = 0; i < this->Agreements.size(); ++i)
    {
      if (this->Agreements[i] && !this->IsConfirmed(i) && this->HasAgreeingOthers(i))
      {
        contradicted.push_back(i);
      }
    }
    for (const std::size_t i : contradicted)
    {
      for (const auto& other : this->Agreements[i]->others)
      {
        ++this->Shown[std::minmax(i, static_cast<std::size_t>(other.first))].ways;
      }
    }
    for (auto& [pair, shown] : this->Shown)
    {
      if (shown.ways == 1 && this->IsConfirmed(pair.first) && this->IsConfirmed(pair.second))
      {
        // The way that was not tried, as if one showed all that the other has confirmed.
        shown.sum += std::min(this->Relative[pair.first], this->Relative[pair.second]);
        ++shown.ways;
      }
    }
  }

  void CompareWithOthers(const ImageAgreement& agreement)
  {
    double most = 0; // tokens that one of the others shows
    for (const auto& other : agreement.others)
    {
      most = std::max(most, other.second);
    }
    const std::size_t i = static_cast<std::size_t>(agreement.image);
    for (const auto& [other, count] : agreement.others)
    {
      Pair& pair = this->Shown[std::minmax(i, static_cast<std::size_t>(other))];
      pair.sum += this->Relative[i] * count / most;
      ++pair.ways;
    }
  }

  // Whether two of those that it was matched with agree, so that its own edges should have been found.
  bool HasAgreeingOthers(std::size_t i) const
  {
    const auto& others = this->Agreements[i]->others;
    for (const auto& first : others)
    {
      for (const auto& second : others)
      {
        const auto known = this->Shown.find(std::minmax(
          static_cast<std::size_t>(first.first), static_cast<std::size_t>(second.first)));
        if (first.first < second.first && known != this->Shown.end() &&
          known->second.Mean() >= LeastShown)
        {
          return true;
        }
      }
    }
    return false;
  }

  void JoinGroups()
  {
    for (const auto& [pair, shown] : this->Shown)
    {
      if (shown.Mean() >= LeastShown)
      {
        const std::size_t a = this->GroupOf(pair.first), b = this->GroupOf(pair.second);
        this->Group[std::max(a, b)] = std::min(a, b);
      }
    }
  }

  std::size_t GroupOf(std::size_t image) const
  {
    while (this->Group[image] != image)
    {
      image = this->Group[image];
    }
    return image;
  }

  std::vector<const ImageAgreement*> Agreements; // per image; null: not known
  std::vector<double> Relative;                  // per image: see RelativeShare; at most 1
  std::vector<std::size_t> Group;                // per image, one of the same group
  std::map<std::pair<std::size_t, std::size_t>, Pair> Shown; // lower index first
};

}

Agreement FindAgreement(std::size_t images, const std::vector<ImageAgreement>& agreements)
{
  return Consensus(images, agreements).Result();
}

}
