// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_BoardText_h
#define freespace_BoardText_h

#include "Scene/Scene.h"

#include <string>

namespace freespace
{

/// Parses a board from a text such as "charuco:15x15:0.03:0.0225:DICT_5X5_250" (squares, side of a
/// square, side of a marker, dictionary) or "chessboard:9x6:0.025" (inner corners, side of a square).
/// Throws Error.
Board BoardFromText(const std::string& text);

}

#endif
