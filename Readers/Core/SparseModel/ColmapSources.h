// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ColmapSources_h
#define freespace_ColmapSources_h

#include "Common/Error.h"
#include "SparseModel/SparseModel.h"
#include "Text/TextSource.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <string>

namespace freespace
{

// The archives of ColmapRecords.h that read. In addition they have Records(list, bytes, each)
// for all records of a file, EndRecord() where one ends, and Fail(fault).

/// Reads little-endian values off a whole file and never past its end.
class ColmapBinarySource
{
public:
  explicit ColmapBinarySource(const std::filesystem::path& file)
    : File(file)
    , Content(ReadWholeFile(file))
  {
  }

  [[noreturn]] void Fail(const std::string& fault) const;

  template <typename Number>
  void Value(Number& number, const char*)
  {
    number = this->Get<Number>();
  }

  template <typename Numbers>
  void Fixed(Numbers& numbers, const char*)
  {
    for (auto& number : numbers)
    {
      number = this->Get<std::decay_t<decltype(number)>>();
    }
  }

  void Model(SparseCamera& camera);
  void Name(std::string& name);
  void Observed(std::uint64_t& id) { id = this->Get<std::uint64_t>(); }
  void NextLine() {}
  void EndRecord() {}

  template <typename Record, typename Visit>
  void List(std::vector<Record>& list, std::size_t bytes, const Visit& each)
  {
    const auto count = this->Get<std::uint64_t>();
    this->Need(count, bytes); // what cannot be there is not allocated
    list.resize(static_cast<std::size_t>(count));
    std::for_each(list.begin(), list.end(), each);
  }

  template <typename Record, typename Visit>
  void Records(std::vector<Record>& list, std::size_t bytes, const Visit& each)
  {
    this->List(list, bytes, each);
    if (this->Position != this->Content.size())
    {
      this->Fail("it holds more than its counts say");
    }
  }

private:
  template <typename Number>
  Number Get()
  {
    this->Need(1, sizeof(Number));
    Number number;
    std::memcpy(&number, this->Content.data() + this->Position, sizeof(Number));
    this->Position += sizeof(Number);
    return number;
  }

  void Need(std::uint64_t count, std::size_t bytes) const;

  std::filesystem::path File;
  std::string Content;
  std::size_t Position = 0;
};

/// Reads text by lines. The line of an image is followed by one with its observations, which is missing in some
/// hand-written models if it is empty.
class ColmapTextSource
{
public:
  explicit ColmapTextSource(const std::filesystem::path& file)
    : Source(file.string())
  {
  }

  [[noreturn]] void Fail(const std::string& fault) const { this->Source.Fail(fault); }

  template <typename Number>
  void Value(Number& number, const char* what)
  {
    number = this->Source.Number<Number>(what);
  }

  template <typename Numbers>
  void Fixed(Numbers& numbers, const char* what)
  {
    for (auto& number : numbers)
    {
      this->Value(number, what);
    }
  }

  void Model(SparseCamera& camera);
  void Name(std::string& name) { name = this->Source.Remainder("the image's name"); }
  void Observed(std::uint64_t& id);
  void NextLine();
  void EndRecord();

  template <typename Record, typename Visit>
  void List(std::vector<Record>& list, std::size_t, const Visit& each)
  {
    while (!this->IsAhead && !this->Source.AtLineEnd())
    {
      each(list.emplace_back());
    }
  }

  template <typename Record, typename Visit>
  void Records(std::vector<Record>& list, std::size_t, const Visit& each)
  {
    while (this->IsAhead || this->Source.NextEntry())
    {
      this->IsAhead = false;
      each(list.emplace_back());
    }
  }

private:
  TextSource Source;
  bool IsAhead = false; // the line that was read belongs to the next record
};

}

#endif
