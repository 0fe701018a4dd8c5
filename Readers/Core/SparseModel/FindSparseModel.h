// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_FindSparseModel_h
#define freespace_FindSparseModel_h

#include <string>

namespace freespace
{

/// Whether a folder holds COLMAP's cameras and images itself.
bool HasColmapModel(const std::string& folder);

/// The folder of a model in or below a folder, down to two levels, as in colmap/sparse/0: of several the
/// one with the most images, judged by the size of its files; of equal ones the first by name. The
/// path itself where there is none, or when it is a file. A folder of a scene.json is none.
///
/// told: if given, set to a sentence if the model is not the path itself, else to an empty string.
std::string FindSparseModel(const std::string& path, std::string* told = nullptr);

}

#endif
