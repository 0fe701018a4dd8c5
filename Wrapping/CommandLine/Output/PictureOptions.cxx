// SPDX-License-Identifier: BSD-3-Clause
#include "Output/PictureOptions.h"

#include "Common/Error.h"
#include "Common/ParseNumber.h"
#include "Output/PictureComparison.h"
#include "Session/NumberValidators.h"
#include "Session/Session.h"

#include <algorithm>
#include <cctype>
#include <functional>
#include <string_view>

namespace freespace
{

namespace
{

// "1920x1080" -> width and height.
std::array<int, 2> SizeFrom(const std::string& text)
{
  const std::size_t cross = std::min(text.find('x'), text.size());
  const std::string_view all(text);
  const std::array<int, 2> size = { ParseNumber<int>(all.substr(0, cross)).value_or(0),
    ParseNumber<int>(all.substr(std::min(cross + 1, all.size()))).value_or(0) };
  if (std::min(size[0], size[1]) < 1 || std::max(size[0], size[1]) > 8192)
  {
    throw Error(
      "'" + text + "' is no size of a picture: it is WIDTHxHEIGHT, 1 to 8192 pixels each.");
  }
  return size;
}

// "0,0.5,1" -> three numbers; nothing for any other text.
std::optional<std::array<double, 3>> NumbersFrom(const std::string& text)
{
  std::array<double, 3> numbers = {};
  std::size_t begin = 0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const std::size_t end = i < 2 ? text.find(',', begin) : text.size();
    if (end == std::string::npos || end < begin)
    {
      return std::nullopt;
    }
    const auto number = ParseNumber<double>(std::string_view(text).substr(begin, end - begin));
    if (!number)
    {
      return std::nullopt;
    }
    numbers[i] = *number;
    begin = end + 1;
  }
  return numbers;
}

// "z", "+Z", "-y" or three numbers.
std::array<double, 3> DirectionFrom(const std::string& text)
{
  const bool hasSign = !text.empty() && (text[0] == '+' || text[0] == '-');
  const std::string axis = text.substr(hasSign ? 1 : 0);
  const std::size_t index =
    axis.size() == 1 ? std::string("xyz").find(static_cast<char>(std::tolower(axis[0]))) : 3;
  std::array<double, 3> direction = {};
  if (index < 3)
  {
    direction[index] = text[0] == '-' ? -1 : 1;
    return direction;
  }
  const auto numbers = NumbersFrom(text);
  if (!numbers || std::all_of(numbers->begin(), numbers->end(), [](double x) { return x == 0; }))
  {
    throw Error("'" + text + "' is no direction: it is +x, -y or three numbers such as 0,1,0.");
  }
  return *numbers;
}

std::array<double, 3> ColorFrom(const std::string& text)
{
  const auto numbers = NumbersFrom(text);
  if (!numbers ||
    std::any_of(numbers->begin(), numbers->end(), [](double x) { return !(x >= 0 && x <= 1); }))
  {
    throw Error("'" + text + "' is no colour: it is red,green,blue, 0 to 1 each.");
  }
  return *numbers;
}

// What is wrong with a text, for CLI11.
CLI::Validator Parses(const std::function<void(const std::string&)>& parse)
{
  return CLI::Validator(
    [parse](std::string& text)
    {
      try
      {
        parse(text);
        return std::string();
      }
      catch (const Error& error)
      {
        return std::string(error.what());
      }
    },
    "");
}

}

void PictureOptions::AddSize(CLI::App& command)
{
  command
    .add_option("--size", this->SizeText,
      "Size of the picture, pixels; otherwise that of the camera, or 1280x960")
    ->check(Parses([](const std::string& text) { SizeFrom(text); }))
    ->type_name("WIDTHxHEIGHT");
}

void PictureOptions::AddLook(CLI::App& command)
{
  command
    .add_option(
      "--up", this->Up, "What is up, with --azimuth and --elevation: +x, -y, ... or x,y,z")
    ->check(Parses([](const std::string& text) { DirectionFrom(text); }))
    ->type_name("DIRECTION")
    ->group("Look")
    ->capture_default_str();
  command.add_option("--zoom", this->Zoom, "How many times larger")
    ->check(Positive())
    ->group("Look")
    ->capture_default_str();
  command.add_option("--background", this->Background, "Colour of the background, 0 to 1 each")
    ->check(Parses([](const std::string& text) { ColorFrom(text); }))
    ->type_name("R,G,B")
    ->group("Look")
    ->capture_default_str();
  command.add_flag("--edges", this->Edges, "Draw the edges of the triangles")->group("Look");
  command
    .add_option("--color-by", this->ColorArray,
      "Colour the surface by this array of its points or triangles, with a bar")
    ->type_name("ARRAY")
    ->group("Look");
}

void PictureOptions::AddComparison(CLI::App& command)
{
  auto* reference =
    command
      .add_option("--ref", this->Reference,
        "Compare the picture with this one by VTK's measure; an error where they differ")
      ->type_name("REF.png")
      ->group("Comparison");
  command.add_option("--diff", this->Difference, "Write the difference")
    ->type_name("DIFF.png")
    ->needs(reference)
    ->group("Comparison");
  command.add_option("--max-error", this->LargestError, "Difference that is allowed")
    ->check(NonNegative())
    ->needs(reference)
    ->group("Comparison")
    ->capture_default_str();
}

void PictureOptions::Apply(PictureLook& look) const
{
  look.size = this->Size().value_or(look.size);
  look.up = DirectionFrom(this->Up);
  look.zoom = this->Zoom;
  look.background = ColorFrom(this->Background);
  look.edges = this->Edges;
  look.colorArray = this->ColorArray;
}

std::optional<std::array<int, 2>> PictureOptions::Size() const
{
  return this->SizeText.empty() ? std::nullopt : std::optional(SizeFrom(this->SizeText));
}

void PictureOptions::Compare(Session& session, const std::string& fileName) const
{
  if (!this->Reference.empty())
  {
    ComparePictures(session, fileName, this->Reference, this->Difference, this->LargestError);
  }
}

}
