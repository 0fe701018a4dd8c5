// SPDX-License-Identifier: BSD-3-Clause
#include "Report/Page/StageRecord.h"

#include "Files/AtomicOutput.h"
#include "Common/Error.h"
#include "Files/PathChecks.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace freespace
{

namespace fs = std::filesystem;

fs::file_time_type NewestTime(const std::string& path)
{
  std::error_code error;
  if (!fs::is_directory(path, error))
  {
    const fs::file_time_type time = fs::last_write_time(path, error);
    return error ? fs::file_time_type::min() : time;
  }
  fs::file_time_type newest = fs::file_time_type::min();
  for (const auto& entry : fs::recursive_directory_iterator(path, error))
  {
    if (entry.is_regular_file(error))
    {
      newest = std::max(newest, entry.last_write_time(error));
    }
  }
  return newest;
}

StageRecord::StageRecord(const std::string& file)
  : File(file)
{
  try
  {
    std::ifstream stream(file);
    const nlohmann::json record = nlohmann::json::parse(stream);
    for (const auto& [name, stage] : record.at("stages").items())
    {
      this->Stages[name] = { stage.at("options").get<std::vector<std::string>>(),
        stage.at("seconds").get<double>(), stage.value("mebibytes", 0.0),
        stage.value("choices", Choices()) };
    }
  }
  catch (const nlohmann::json::exception&)
  {
    this->Stages.clear();
  }
}

bool StageRecord::IsCurrent(const std::string& stage, const std::vector<std::string>& options,
  const std::string& output, const std::vector<std::string>& inputs) const
{
  const auto found = this->Stages.find(stage);
  if (found == this->Stages.end() || found->second.options != options || !IsThere(output))
  {
    return false;
  }
  const fs::file_time_type made = NewestTime(output);
  return std::all_of(inputs.begin(), inputs.end(),
    [made](const std::string& input) { return IsThere(input) && NewestTime(input) <= made; });
}

double StageRecord::Seconds(const std::string& stage) const
{
  const auto found = this->Stages.find(stage);
  return found == this->Stages.end() ? 0 : found->second.seconds;
}

double StageRecord::Mebibytes(const std::string& stage) const
{
  const auto found = this->Stages.find(stage);
  return found == this->Stages.end() ? 0 : found->second.mebibytes;
}

Choices StageRecord::ChoicesOf(const std::string& stage) const
{
  const auto found = this->Stages.find(stage);
  return found == this->Stages.end() ? Choices() : found->second.choices;
}

void StageRecord::Set(const std::string& stage, const std::vector<std::string>& options,
  double seconds, double mebibytes, const Choices& choices)
{
  this->Stages[stage] = { options, seconds, mebibytes, choices };
  this->Write();
}

void StageRecord::Write() const
{
  nlohmann::json record;
  for (const auto& [name, stage] : this->Stages)
  {
    record["stages"][name] = { { "options", stage.options }, { "seconds", stage.seconds } };
    if (stage.mebibytes > 0)
    {
      record["stages"][name]["mebibytes"] = stage.mebibytes;
    }
    if (!stage.choices.empty())
    {
      record["stages"][name]["choices"] = stage.choices;
    }
  }
  AtomicOutput target(this->File);
  std::ofstream file(target.Path());
  file << record.dump(1, ' ', true, nlohmann::json::error_handler_t::replace) << "\n";
  file.close();
  if (!file)
  {
    throw Error("Cannot write " + this->File + ": the disk is full or failed.");
  }
  target.Commit();
}

}
