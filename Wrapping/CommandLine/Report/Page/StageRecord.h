// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_StageRecord_h
#define freespace_StageRecord_h

#include "Session/Choices.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace freespace
{

/// A record of how the files of a folder were made, so that a later run can reuse them: for each stage its
/// options, its time and what it chose by itself. It is a JSON file in the folder.
class StageRecord
{
public:
  /// Reads the record. A missing or invalid file is an empty record: everything is then recomputed.
  explicit StageRecord(const std::string& file);

  /// Whether a stage's output was made with these options and is as new as all of its inputs. An input
  /// that is a folder counts as its newest file.
  bool IsCurrent(const std::string& stage, const std::vector<std::string>& options,
    const std::string& output, const std::vector<std::string>& inputs) const;

  /// How long the stage took when it was made, seconds.
  double Seconds(const std::string& stage) const;

  /// The most memory that it had then, MiB; 0 where that is not known.
  double Mebibytes(const std::string& stage) const;

  /// What the stage chose when it was made.
  Choices ChoicesOf(const std::string& stage) const;

  /// Notes that a stage was made, and writes the record. Throws Error when that fails.
  void Set(const std::string& stage, const std::vector<std::string>& options, double seconds,
    double mebibytes = 0, const Choices& choices = {});

private:
  struct Stage
  {
    std::vector<std::string> options;
    double seconds = 0;
    double mebibytes = 0;
    Choices choices;
  };

  void Write() const;

  std::string File;
  std::map<std::string, Stage> Stages;
};

/// When a file was written; of a folder, the newest file in it. The epoch's begin when there is none.
std::filesystem::file_time_type NewestTime(const std::string& path);

}

#endif
