// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_PictureComparison_h
#define freespace_PictureComparison_h

#include <string>

namespace freespace
{

class Session;

/// Compares two PNG files by VTK's regression measure, which shifts each pixel by one at most, and writes the
/// difference unless that name is empty. Throws Error where they differ by more than `largest` or in size.
void ComparePictures(Session& session, const std::string& fileName, const std::string& reference,
  const std::string& difference, double largest);

}

#endif
