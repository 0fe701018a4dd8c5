// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ForeignModel_h
#define freespace_ForeignModel_h

#include <string>

namespace freespace
{

/// What a file or folder of another program is, and how it becomes a model that can be read, as a clause
/// without a period: "it is a Metashape project: export ...". Empty where the kind is not known.
std::string DescribeForeignModel(const std::string& path);

}

#endif
