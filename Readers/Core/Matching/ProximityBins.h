// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ProximityBins_h
#define freespace_ProximityBins_h

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace freespace
{

/// A fast filter for points on a line: which of them are within reach of a point of another image. Few
/// are, and only these need an exact test. Two points meet when either reaches the centre of the other.
/// Points are sorted into bins one unit wide; there are false positives, but no false negatives.
class ProximityBins
{
public:
  explicit ProximityBins(std::size_t images)
    : Own(images)
    , Others(images)
  {
  }

  void Clear() { std::fill(this->Own.begin(), this->Own.end(), Bins{}); }

  /// Adds a place of an image, in units; the reach is not negative.
  void Add(int image, float center, float reach)
  {
    Bins& bins = this->Own[image];
    const int middle = BinOf(center), first = BinOf(center - reach), last = BinOf(center + reach);
    bins.centers[WordOf(middle)] |= std::uint64_t(1) << (middle & 63);
    for (int bin = first; bin <= last; bin += 64)
    {
      const std::uint64_t some = Several(last - bin);
      bins.reached[WordOf(bin)] |= some << (bin & 63);
      bins.reached[WordOf(bin + 63)] |= some >> 1 >> (63 - (bin & 63));
    }
  }

  /// After the last place was added.
  void Finish()
  {
    for (std::size_t image = 0; image < this->Own.size(); ++image)
    {
      Bins& others = this->Others[image] = Bins{};
      for (std::size_t other = 0; other < this->Own.size(); ++other)
      {
        for (std::size_t word = 0; other != image && word < Words; ++word)
        {
          others.centers[word] |= this->Own[other].centers[word];
          others.reached[word] |= this->Own[other].reached[word];
        }
      }
    }
  }

  /// Whether a place of an image may meet one of another image.
  bool Meets(int image, float center, float reach) const
  {
    const Bins& bins = this->Others[image];
    const int middle = BinOf(center), first = BinOf(center - reach), last = BinOf(center + reach);
    std::uint64_t met = bins.reached[WordOf(middle)] >> (middle & 63) & 1;
    for (int bin = first; bin <= last; bin += 64)
    {
      const std::uint64_t some = Several(last - bin);
      met |= bins.centers[WordOf(bin)] & some << (bin & 63);
      met |= bins.centers[WordOf(bin + 63)] & some >> 1 >> (63 - (bin & 63));
    }
    return met != 0;
  }

private:
  // A long line goes around: what is far apart may share a bin.
  static constexpr std::size_t Words = 16;
  struct Bins
  {
    std::array<std::uint64_t, Words> centers{}, reached{};
  };

  static int BinOf(float place)
  {
    const int bin = static_cast<int>(place);
    return bin - (static_cast<float>(bin) > place);
  }
  static std::size_t WordOf(int bin) { return static_cast<unsigned>(bin) / 64 % Words; }
  // The lowest of 64 bits, one more than `more`.
  static std::uint64_t Several(int more)
  {
    return more >= 63 ? ~std::uint64_t(0) : (std::uint64_t(2) << more) - 1;
  }

  std::vector<Bins> Own;    // per image
  std::vector<Bins> Others; // of all images but that one
};

}

#endif
