// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_MeshValues_h
#define freespace_MeshValues_h

#include <array>
#include <string>

namespace freespace
{

/// The 4 x 4 numbers of a file, row by row. Throws Error naming it if they are missing, not finite, not
/// affine or not invertible.
std::array<double, 16> ReadMatrix(const std::string& fileName);

///@{
/// The fault of an option's value; empty if it is valid.
std::string BoxFault(const std::string& text);
std::string VectorFault(const std::string& text);
std::string NumberFault(const std::string& text); ///< above 0
std::string CountFault(const std::string& text);  ///< 1 or more
std::string AnyFault(const std::string& text);
///@}

}

#endif
