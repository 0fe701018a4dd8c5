// SPDX-License-Identifier: BSD-3-Clause
#include "SparseModel/ColmapSources.h"

namespace freespace
{

namespace
{

// Whether a line is that of an image: nine numbers and a name. Observations are numbers only.
bool IsImage(std::string_view line)
{
  constexpr std::string_view blanks = " \t";
  const std::string_view last = line.substr(line.find_last_of(blanks) + 1);
  for (int field = 0; field < 9; ++field)
  {
    const std::string_view word = line.substr(0, line.find_first_of(blanks));
    line.remove_prefix(std::min(line.find_first_not_of(blanks, word.size()), line.size()));
    if (!ParseNumber<double>(word))
    {
      return false;
    }
  }
  return !line.empty() && !ParseNumber<double>(last);
}

}

void ColmapBinarySource::Fail(const std::string& fault) const
{
  throw Error("Cannot read " + this->File.string() + ": " + fault + " (before byte " +
    std::to_string(this->Position) + ").");
}

void ColmapBinarySource::Need(std::uint64_t count, std::size_t bytes) const
{
  if (count > (this->Content.size() - this->Position) / bytes)
  {
    this->Fail("it is truncated");
  }
}

void ColmapBinarySource::Model(SparseCamera& camera)
{
  const auto number = this->Get<std::int32_t>();
  const std::optional<LensModel> model = LensModelOf(number);
  if (!model)
  {
    this->Fail(UnsupportedLens("number " + std::to_string(number)));
  }
  camera.model = *model;
  camera.parameters.resize(LensModelParameters(camera.model));
}

void ColmapBinarySource::Name(std::string& name)
{
  const std::size_t end = this->Content.find('\0', this->Position);
  if (end == std::string::npos)
  {
    this->Fail("it is truncated");
  }
  name = this->Content.substr(this->Position, end - this->Position);
  this->Position = end + 1;
}

void ColmapTextSource::Model(SparseCamera& camera)
{
  const std::string_view name = this->Source.Field("a camera model");
  const std::optional<LensModel> model = LensModelOf(name);
  if (!model)
  {
    this->Fail(UnsupportedLens(name));
  }
  camera.model = *model;
  camera.parameters.resize(LensModelParameters(camera.model));
}

void ColmapTextSource::Observed(std::uint64_t& id)
{
  const auto number = this->Source.Number<std::int64_t>("the id of an observed point");
  id = number < 0 ? SparseObservation::noPoint : static_cast<std::uint64_t>(number);
}

void ColmapTextSource::NextLine()
{
  this->Source.NextLine(); // often empty
  const std::string_view line = this->Source.Ahead();
  if (!line.empty() && line.front() == '#')
  {
    this->IsAhead = this->Source.NextEntry();
    return;
  }
  this->IsAhead = IsImage(line);
}

void ColmapTextSource::EndRecord()
{
  if (!this->IsAhead && !this->Source.AtLineEnd())
  {
    this->Fail("unexpected text after the last field: '" +
      std::string(this->Source.Ahead().substr(0, 40)) + "'");
  }
}

}
