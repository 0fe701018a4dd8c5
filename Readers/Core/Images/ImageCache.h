// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ImageCache_h
#define freespace_ImageCache_h

#include "Images/CalibratedImage.h"

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace freespace
{

/// A cache of values computed from images, which keeps the most recently used ones as far as memory allows.
/// They depend on the intrinsics of the image, not on its pose. Thread-safe.
template <typename Value>
class ImageCache
{
public:
  /// Keeps values whose sizes, in any unit, make up to `mostSize` together.
  explicit ImageCache(std::size_t mostSize)
    : MostSize(mostSize)
  {
  }

  /// The value of an image. If it is not in the cache, make() computes it and size(value) returns its size. A
  /// value that is evicted stays valid for its users.
  template <typename Make, typename Size>
  std::shared_ptr<const Value> Find(
    const CalibratedImage& image, const Make& make, const Size& size)
  {
    const std::shared_ptr<Entry> entry = this->EntryOf(image.file);
    const std::lock_guard<std::mutex> busy(entry->mutex);
    std::shared_ptr<const Value> value;
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      value = HaveSameLens(entry->image, image) ? entry->value : nullptr;
    }
    if (!value)
    {
      value = std::make_shared<const Value>(make());
      entry->image = image;
    }
    this->Keep(*entry, value, size(*value));
    return value;
  }

private:
  struct Entry
  {
    std::mutex mutex; // who makes the value holds it
    std::shared_ptr<const Value> value;
    CalibratedImage image; // for which it was made
    std::size_t size = 0;
    std::size_t lastUse = 0;
  };

  static bool HaveSameLens(const CalibratedImage& a, const CalibratedImage& b)
  {
    return a.camera.K == b.camera.K && a.lens == b.lens && a.distortion == b.distortion;
  }

  std::shared_ptr<Entry> EntryOf(const std::string& file)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    std::shared_ptr<Entry>& known = this->Entries[file];
    if (!known)
    {
      known = std::make_shared<Entry>();
    }
    return known;
  }

  // Keeps the value and evicts the least recently used ones.
  void Keep(Entry& entry, const std::shared_ptr<const Value>& value, std::size_t size)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    if (entry.value)
    {
      this->LetGo(entry);
    }
    entry.value = value;
    entry.size = size;
    entry.lastUse = ++this->Uses;
    this->Kept[entry.lastUse] = &entry;
    this->Size += size;
    while (this->Size > this->MostSize && this->Kept.size() > 1)
    {
      this->LetGo(*this->Kept.begin()->second);
    }
  }

  void LetGo(Entry& entry)
  {
    this->Size -= entry.size;
    this->Kept.erase(entry.lastUse);
    entry.value.reset();
  }

  const std::size_t MostSize;
  std::mutex Mutex; // of what follows, and of the entries' values, sizes and lastUse
  std::map<std::string, std::shared_ptr<Entry>> Entries;
  std::map<std::size_t, Entry*> Kept; // those with a value, by their last use
  std::size_t Size = 0;               // of these
  std::size_t Uses = 0;
};

}

#endif
