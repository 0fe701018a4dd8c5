// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_FileNames_h
#define freespace_FileNames_h

#include <string>
#include <vector>

namespace freespace
{

/// The name of a view, cluster or image as the name of a file, without its ending: it stays in its folder,
/// and neither is hidden nor has control characters or more than 200 bytes. Names that are such already are
/// left as they are.
std::string FileNameOf(const std::string& name);

/// File names for the paths of images, without ending, all different: the names of the images where that is
/// so, with the folders in which they differ where it is not, and with a number where they still are the
/// same.
std::vector<std::string> DistinctFileNames(const std::vector<std::string>& paths);

/// FileNameOf for each, with a number where two would be the same.
std::vector<std::string> FileNamesOf(const std::vector<std::string>& names);

}

#endif
