// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_WholeFile_h
#define freespace_WholeFile_h

#include <string>

namespace freespace
{

/// Checks that a file is complete, i.e. not truncated. Throws Error naming the file when it is missing or
/// truncated.

/// A JPEG file is decoded, because decoders continue after damaged data and make up the following pixels. A
/// few bytes of padding are accepted. Other formats are not checked.
void CheckWholeJPEG(const std::string& fileName);

}

#endif
