// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Bytes_h
#define freespace_Bytes_h

#include "Common/Error.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace freespace
{

/// What is sent as it lies in memory.
template <typename Value>
struct IsPlain : std::is_trivially_copyable<Value>
{
};
template <typename Scalar, int Rows, int Columns>
struct IsPlain<Eigen::Matrix<Scalar, Rows, Columns>> : std::bool_constant<(Rows > 0 && Columns > 0)>
{
};

/// Turns values into bytes, for another process of the same program. Values are plain, strings, vectors and pairs, or
/// of a type that has a function
///
///     template <typename Bytes> void Exchange(Bytes& bytes, Type& value) { bytes(value.one, value.other); }
///
/// in its namespace, which writes and reads it, so that both sides know the same members.
class ByteWriter
{
public:
  template <typename... Values>
  void operator()(Values&... values)
  {
    (this->Put(values), ...);
  }

  std::string Take() { return std::move(this->Bytes); }

private:
  template <typename Value>
  void Put(Value& value)
  {
    if constexpr (IsPlain<Value>::value)
    {
      this->Append(&value, 1);
    }
    else
    {
      Exchange(*this, value);
    }
  }

  void Put(std::string& text) { this->PutPlain(text); }

  template <typename First, typename Second>
  void Put(std::pair<First, Second>& pair)
  {
    (*this)(pair.first, pair.second);
  }

  template <typename Element>
  void Put(std::vector<Element>& elements)
  {
    if constexpr (IsPlain<Element>::value)
    {
      this->PutPlain(elements);
    }
    else
    {
      std::size_t size = elements.size();
      this->Append(&size, 1);
      for (Element& element : elements)
      {
        this->Put(element);
      }
    }
  }

  template <typename Sequence>
  void PutPlain(Sequence& sequence)
  {
    std::size_t size = sequence.size();
    this->Append(&size, 1);
    this->Append(sequence.data(), size);
  }

  template <typename Value>
  void Append(const Value* values, std::size_t count)
  {
    this->Bytes.append(reinterpret_cast<const char*>(values), count * sizeof(Value));
  }

  std::string Bytes;
};

/// The other way round. Throws Error where bytes are missing.
class ByteReader
{
public:
  /// The bytes must outlive it.
  explicit ByteReader(const std::string& bytes)
    : Bytes(bytes)
  {
  }

  template <typename... Values>
  void operator()(Values&... values)
  {
    (this->Get(values), ...);
  }

private:
  template <typename Value>
  void Get(Value& value)
  {
    if constexpr (IsPlain<Value>::value)
    {
      this->Copy(&value, 1);
    }
    else
    {
      Exchange(*this, value);
    }
  }

  void Get(std::string& text) { this->GetPlain(text); }

  template <typename First, typename Second>
  void Get(std::pair<First, Second>& pair)
  {
    (*this)(pair.first, pair.second);
  }

  template <typename Element>
  void Get(std::vector<Element>& elements)
  {
    if constexpr (IsPlain<Element>::value)
    {
      this->GetPlain(elements);
    }
    else
    {
      elements.resize(this->Size(1));
      for (Element& element : elements)
      {
        this->Get(element);
      }
    }
  }

  template <typename Sequence>
  void GetPlain(Sequence& sequence)
  {
    sequence.resize(this->Size(sizeof(typename Sequence::value_type)));
    this->Copy(sequence.data(), sequence.size());
  }

  // Of a sequence, whose elements take at least this number of bytes each.
  std::size_t Size(std::size_t least)
  {
    std::size_t size = 0;
    this->Copy(&size, 1);
    this->Need(size, least);
    return size;
  }

  template <typename Value>
  void Copy(Value* values, std::size_t count)
  {
    this->Need(count, sizeof(Value));
    if (count > 0)
    {
      std::memcpy(
        static_cast<void*>(values), this->Bytes.data() + this->Next, count * sizeof(Value));
    }
    this->Next += count * sizeof(Value);
  }

  void Need(std::size_t count, std::size_t each) const
  {
    if (count > (this->Bytes.size() - this->Next) / each)
    {
      throw Error("A message of another process is incomplete.");
    }
  }

  const std::string& Bytes;
  std::size_t Next = 0;
};

/// The bytes of a value, and the value of bytes.
template <typename Value>
std::string BytesOf(Value& value)
{
  ByteWriter bytes;
  bytes(value);
  return bytes.Take();
}
template <typename Value>
Value FromBytes(const std::string& bytes)
{
  Value value;
  ByteReader reader(bytes);
  reader(value);
  return value;
}

}

#endif
