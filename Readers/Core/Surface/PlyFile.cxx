// SPDX-License-Identifier: BSD-3-Clause
#include "Surface/SurfaceFile.h"

#include "Common/Error.h"
#include "Surface/SurfaceWords.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

namespace freespace
{

namespace
{

enum class Scalar : unsigned char
{
  Int8,
  UInt8,
  Int16,
  UInt16,
  Int32,
  UInt32,
  Float,
  Double
};

struct Property
{
  std::string name;
  Scalar type = Scalar::Float;
  std::optional<Scalar> count; ///< of a list
};

struct Element
{
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

enum class Format
{
  Text,
  LittleEndian,
  BigEndian
};

std::size_t SizeOf(Scalar type)
{
  constexpr std::size_t sizes[] = { 1, 1, 2, 2, 4, 4, 4, 8 };
  return sizes[static_cast<std::size_t>(type)];
}

std::optional<Scalar> ScalarOf(std::string_view name)
{
  constexpr std::pair<std::string_view, Scalar> names[] = { { "char", Scalar::Int8 },
    { "uchar", Scalar::UInt8 }, { "short", Scalar::Int16 }, { "ushort", Scalar::UInt16 },
    { "int", Scalar::Int32 }, { "uint", Scalar::UInt32 }, { "float", Scalar::Float },
    { "double", Scalar::Double }, { "int8", Scalar::Int8 }, { "uint8", Scalar::UInt8 },
    { "int16", Scalar::Int16 }, { "uint16", Scalar::UInt16 }, { "int32", Scalar::Int32 },
    { "uint32", Scalar::UInt32 }, { "float32", Scalar::Float }, { "float64", Scalar::Double } };
  const auto found = std::find_if(
    std::begin(names), std::end(names), [&](const auto& n) { return n.first == name; });
  return found == std::end(names) ? std::nullopt : std::optional<Scalar>(found->second);
}

/// Reads a PLY file element by element.
class PlyParser
{
public:
  PlyParser(const std::string& content, const std::string& file)
    : Content(content)
    , File(file)
    , Words({}, file)
  {
  }

  SurfaceFile Parse()
  {
    this->ReadHeader();
    this->Words = SurfaceWords(std::string_view(this->Content).substr(this->At), this->File);
    for (const Element& element : this->Elements)
    {
      this->CheckLength(element);
      this->ReadElement(element);
    }
    return std::move(this->Surface);
  }

private:
  [[noreturn]] void Fail(const std::string& fault) const
  {
    throw Error("Cannot read " + this->File + ": " + fault + ".");
  }

  [[noreturn]] void FailTruncated() const { this->Fail("it is truncated or not a PLY file"); }

  std::string_view NextLine()
  {
    if (this->At >= this->Content.size())
    {
      this->FailTruncated();
    }
    const std::size_t end = std::min(this->Content.find('\n', this->At), this->Content.size());
    std::string_view line = std::string_view(this->Content).substr(this->At, end - this->At);
    this->At = std::min(end + 1, this->Content.size()); // the last line may lack its end
    if (!line.empty() && line.back() == '\r')
    {
      line.remove_suffix(1);
    }
    return line;
  }

  void ReadHeader()
  {
    if (this->NextLine() != "ply")
    {
      this->FailTruncated();
    }
    for (std::string_view line = this->NextLine(); line != "end_header"; line = this->NextLine())
    {
      SurfaceWords words(line, this->File);
      const std::string_view keyword = words.Next();
      if (keyword == "format")
      {
        const std::string_view format = words.Next();
        this->Encoding = format == "ascii"   ? Format::Text
          : format == "binary_little_endian" ? Format::LittleEndian
          : format == "binary_big_endian"    ? Format::BigEndian
                                             : throw Error("Cannot read " + this->File +
                                                 ": PLY has no format '" + std::string(format) + "'.");
      }
      else if (keyword == "comment")
      {
        this->Surface.comments.emplace_back(line.substr(std::min<std::size_t>(8, line.size())));
      }
      else if (keyword == "element")
      {
        Element element;
        element.name = words.Next();
        element.count = words.Number<std::uint64_t>();
        this->Elements.push_back(element);
      }
      else if (keyword == "property")
      {
        this->AddProperty(words);
      }
    }
  }

  void AddProperty(SurfaceWords& words)
  {
    Property property;
    std::string_view type = words.Next();
    if (type == "list")
    {
      property.count = ScalarOf(words.Next());
      if (!property.count || *property.count >= Scalar::Float)
      {
        this->Fail("a list of its header is counted by no whole number");
      }
      type = words.Next();
    }
    const std::optional<Scalar> scalar = ScalarOf(type);
    if (!scalar || this->Elements.empty())
    {
      this->Fail("its header has a property of no element or of no type of PLY");
    }
    property.type = *scalar;
    property.name = words.Next();
    this->Elements.back().properties.push_back(property);
  }

  // The rest of the file must be long enough for all elements before memory is allocated for them.
  void CheckLength(const Element& element) const
  {
    std::size_t least = 0;
    for (const Property& property : element.properties)
    {
      least += this->Encoding == Format::Text ? 2 : SizeOf(property.count.value_or(property.type));
    }
    const std::size_t left = this->Content.size() - std::min(this->At, this->Content.size()) + 1;
    if (least == 0 ? element.count > 0 : element.count > left / least)
    {
      this->FailTruncated();
    }
  }

  double Next(Scalar type)
  {
    return this->Encoding == Format::Text ? this->Words.Number<double>() : this->NextBinary(type);
  }

  double NextBinary(Scalar type)
  {
    const std::size_t size = SizeOf(type);
    if (this->Content.size() - std::min(this->At, this->Content.size()) < size)
    {
      this->FailTruncated();
    }
    unsigned char bytes[8];
    std::memcpy(bytes, this->Content.data() + this->At, size);
    this->At += size;
    if (this->Encoding == Format::BigEndian)
    {
      std::reverse(bytes, bytes + size);
    }
    const auto as = [&bytes](auto value)
    {
      std::memcpy(&value, bytes, sizeof value);
      return static_cast<double>(value);
    };
    switch (type)
    {
      case Scalar::Int8:
        return as(std::int8_t());
      case Scalar::UInt8:
        return as(std::uint8_t());
      case Scalar::Int16:
        return as(std::int16_t());
      case Scalar::UInt16:
        return as(std::uint16_t());
      case Scalar::Int32:
        return as(std::int32_t());
      case Scalar::UInt32:
        return as(std::uint32_t());
      case Scalar::Float:
        return as(float());
      default:
        return as(double());
    }
  }

  void ReadElement(const Element& element)
  {
    const bool isVertex = element.name == "vertex", isFace = element.name == "face";
    const std::array<int, 6> places = this->PlacesOf(element, isVertex);
    for (std::uint64_t i = 0; i < element.count; ++i)
    {
      std::array<double, 6> values = {};
      for (std::size_t p = 0; p < element.properties.size(); ++p)
      {
        const Property& property = element.properties[p];
        if (property.count)
        {
          const bool isPolygon =
            isFace && (property.name == "vertex_indices" || property.name == "vertex_index");
          this->ReadList(property, isPolygon);
          continue;
        }
        const double value = this->Next(property.type);
        for (std::size_t k = 0; k < places.size(); ++k)
        {
          values[k] = places[k] == static_cast<int>(p) ? value : values[k];
        }
      }
      if (isVertex)
      {
        this->AddVertex(values, places[3] >= 0 && places[4] >= 0 && places[5] >= 0);
      }
    }
  }

  // Where x, y, z, red, green and blue stand among a vertex's properties; -1: nowhere.
  std::array<int, 6> PlacesOf(const Element& element, bool isVertex)
  {
    constexpr std::string_view names[] = { "x", "y", "z", "red", "green", "blue" };
    std::array<int, 6> places;
    for (std::size_t k = 0; k < places.size(); ++k)
    {
      places[k] = -1;
      for (std::size_t p = 0; p < element.properties.size() && isVertex; ++p)
      {
        const Property& property = element.properties[p];
        const bool fits = !property.count && (k < 3 || property.type == Scalar::UInt8);
        places[k] = fits && property.name == names[k] ? static_cast<int>(p) : places[k];
      }
      if (k < 3 && isVertex)
      {
        if (places[k] < 0)
        {
          this->Fail("its vertices have no " + std::string(names[k]));
        }
        const Scalar type = element.properties[static_cast<std::size_t>(places[k])].type;
        this->Surface.isDouble = this->Surface.isDouble || type == Scalar::Double;
      }
    }
    return places;
  }

  void AddVertex(const std::array<double, 6>& values, bool isColored)
  {
    this->Surface.points.push_back({ values[0], values[1], values[2] });
    if (isColored)
    {
      const auto byte = [](double value)
      { return static_cast<std::uint8_t>(value >= 0 && value <= 255 ? value : 0); };
      this->Surface.colors.push_back({ byte(values[3]), byte(values[4]), byte(values[5]) });
    }
  }

  void ReadList(const Property& property, bool isPolygon)
  {
    const double count = this->Next(*property.count);
    if (!(count >= 0 && count <= static_cast<double>(this->Content.size())))
    {
      this->FailTruncated();
    }
    for (double i = 0; i < count; ++i)
    {
      const double value = this->Next(property.type);
      if (isPolygon)
      {
        const bool isIndex = value >= 0 && value < 9e15 && value == std::floor(value);
        this->Surface.corners.push_back(isIndex ? static_cast<std::int64_t>(value) : -1);
      }
    }
    if (isPolygon)
    {
      this->Surface.EndPolygon(this->File);
    }
  }

  const std::string& Content;
  const std::string& File;
  std::size_t At = 0;
  SurfaceWords Words;
  Format Encoding = Format::Text;
  std::vector<Element> Elements;
  SurfaceFile Surface;
};

}

SurfaceFile ParsePLY(const std::string& content, const std::string& file)
{
  return PlyParser(content, file).Parse();
}

}
