// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_WholeFile_h
#define freespace_WholeFile_h

#include <string>

namespace freespace
{

/// Checks that a file is complete, i.e. not truncated. Throws Error naming the file when it is missing or
/// truncated.

/// A JPEG file is decoded: decoders go on where its data are damaged, and invent the pixels after. A few
/// bytes of padding are no damage. Other formats pass.
void CheckWholeJPEG(const std::string& fileName);

}

#endif
