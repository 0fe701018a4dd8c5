// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_BatchFile_h
#define freespace_BatchFile_h

#include <string>
#include <utility>
#include <vector>

namespace freespace
{

/// The steps for each scene of a batch:
///
///     { "steps": [ "reconstruct {scene} -o mesh.ply",
///                  ["compare", "mesh.ply", "{folder}/truth.ply", "--json", "errors.json"] ],
///       "table": { "F": "errors.json:/f/1" } }
///
/// A step is a command of the program with its options, as a string of words separated by blanks or as a
/// list of words. In each word {scene} stands for the scene's path, {folder} for the folder that it is in and
/// {name} for its name; other paths are relative to the folder of the scene's results. `table`, which may be
/// left out, names columns of the table at the end: a file of the results and a JSON pointer into it.
struct BatchFile
{
  struct Column
  {
    std::string name;
    std::string file;
    std::string pointer;
  };

  std::vector<std::vector<std::string>> steps;
  std::vector<Column> table;
};

/// Reads one. Throws Error naming the file and the fault: broken JSON, an unknown or ill-typed key, no steps, a step
/// whose first word is none of the commands.
BatchFile ReadBatch(const std::string& file, const std::vector<std::string>& commands);

struct BatchScene
{
  std::string path; ///< absolute
  std::string
    name; ///< that of the folder of a scene.json, otherwise of the file without its ending
};

/// Throws Error when one is not there, or two have the same name.
std::vector<BatchScene> FindScenes(const std::vector<std::string>& paths);

/// The words of a step for a scene.
std::vector<std::string> WordsFor(const std::vector<std::string>& step, const BatchScene& scene);

}

#endif
