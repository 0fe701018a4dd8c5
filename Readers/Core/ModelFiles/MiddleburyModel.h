// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_MiddleburyModel_h
#define freespace_MiddleburyModel_h

#include "SparseModel/SparseModel.h"

namespace freespace
{

/// Reads a NAME_par.txt of Middlebury's multi-view benchmark: cameras only, no points. After the number of
/// images each line has a name, K and R row by row and t, with x = K (R X + t). Images are beside the
/// file and have the size; else it is twice the principal point.
///
/// Throws Error naming the file, line and fault.
SparseModel ReadMiddleburyModel(const std::string& file);

}

#endif
