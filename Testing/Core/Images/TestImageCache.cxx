// SPDX-License-Identifier: BSD-3-Clause
#include "Images/ImageCache.h"

#include <gtest/gtest.h>

using namespace freespace;

namespace
{

// Counts what is made; a value is as large as it says.
class CountingCache
{
public:
  explicit CountingCache(std::size_t most)
    : Cache(most)
  {
  }

  std::shared_ptr<const std::size_t> Find(const CalibratedImage& image, std::size_t size = 1)
  {
    return this->Cache.Find(
      image,
      [&]
      {
        ++this->Made;
        return size;
      },
      [](std::size_t value) { return value; });
  }

  int Made = 0;

private:
  ImageCache<std::size_t> Cache;
};

CalibratedImage Image(const char* file)
{
  CalibratedImage image;
  image.file = file;
  return image;
}

}

TEST(ImageCache, MakesAValueOnce)
{
  CountingCache cache(10);
  EXPECT_EQ(cache.Find(Image("a")), cache.Find(Image("a")));
  EXPECT_EQ(cache.Made, 1);
}

TEST(ImageCache, DependsOnTheLensAndNotOnThePose)
{
  CountingCache cache(10);
  CalibratedImage image = Image("a");
  cache.Find(image);
  image.camera.t.x() = 1;
  cache.Find(image);
  EXPECT_EQ(cache.Made, 1);
  image.camera.K(0, 0) = 2;
  cache.Find(image);
  EXPECT_EQ(cache.Made, 2);
  image.distortion = { 0.1, 0, 0, 0 };
  cache.Find(image);
  EXPECT_EQ(cache.Made, 3);
}

TEST(ImageCache, LetsGoOfWhatWasAskedForLongestAgo)
{
  CountingCache cache(2);
  const auto held = cache.Find(Image("a"));
  cache.Find(Image("b"));
  cache.Find(Image("a")); // b is now the older one
  cache.Find(Image("c"));
  EXPECT_EQ(cache.Made, 3);
  EXPECT_EQ(cache.Find(Image("a")), held);
  EXPECT_EQ(cache.Made, 3);
  cache.Find(Image("b"));
  EXPECT_EQ(cache.Made, 4);
}

TEST(ImageCache, KeepsTheLastEvenIfItIsTooLarge)
{
  CountingCache cache(2);
  const auto small = cache.Find(Image("a"));
  cache.Find(Image("b"), 5);
  cache.Find(Image("b"), 5);
  EXPECT_EQ(cache.Made, 2);
  EXPECT_EQ(*small, 1u); // who holds it keeps it
  cache.Find(Image("a"));
  EXPECT_EQ(cache.Made, 3);
}

TEST(ImageCache, AFailureIsNotKept)
{
  ImageCache<int> cache(10);
  const auto size = [](int) { return std::size_t(1); };
  EXPECT_THROW(cache.Find(
                 Image("a"), []() -> int { throw 1; }, size),
    int);
  EXPECT_EQ(*cache.Find(
              Image("a"), [] { return 7; }, size),
    7);
}
