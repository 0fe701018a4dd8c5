// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Doors_h
#define freespace_Doors_h

#include <string>
#include <string_view>
#include <vector>

namespace freespace
{

/// A door by which something from outside comes in: takes any bytes, and may throw Error. Anything else that
/// leaves a door (another exception, a signal, a report of a sanitizer), more than 5 s and more than 1 GB is a
/// fault.
struct Door
{
  const char* name;
  void (*enter)(std::string_view bytes);
};

/// Those of this program: CoreDoors.cxx, BlockDoors.cxx or ConfigDoor.cxx.
std::vector<Door> Doors();

/// A folder of this process, where doors that want files have them.
std::string FuzzFolder();
void PutFile(const std::string& name, std::string_view content);
void RemoveFile(const std::string& name);

/// The parts of an input of several files, which are parted by the line "%%%%".
std::vector<std::string_view> Parts(std::string_view bytes);

}

#endif
