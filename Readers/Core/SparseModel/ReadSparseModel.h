// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ReadSparseModel_h
#define freespace_ReadSparseModel_h

#include "SparseModel/SparseModel.h"

namespace freespace
{

/// Reads a structure-from-motion model: a folder as COLMAP's (or the largest
/// below it, see FindSparseModel), a file that ends in .nvm as
/// VisualSFM's, one that ends in .out as Bundler's. Throws Error naming the file and the fault.
SparseModel ReadSparseModel(const std::string& path);

/// Whether a path looks like one that ReadSparseModel reads.
bool IsSparseModel(const std::string& path);

}

#endif
