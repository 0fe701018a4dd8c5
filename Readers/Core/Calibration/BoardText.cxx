// SPDX-License-Identifier: BSD-3-Clause
#include "Calibration/BoardText.h"

#include "Common/Error.h"
#include "Common/ParseNumber.h"

#include <optional>
#include <sstream>
#include <vector>

namespace freespace
{

namespace
{

template <typename Value>
Value NumberOf(const std::string& text, const std::string& whole)
{
  const std::optional<Value> value = ParseNumber<Value>(text);
  if (!value)
  {
    throw Error("'" + whole + "' describes no board: '" + text + "' is not a number.");
  }
  return *value;
}

}

Board BoardFromText(const std::string& text)
{
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ':');)
  {
    parts.push_back(part);
  }
  const bool charuco = !parts.empty() && parts[0] == "charuco" && parts.size() == 5;
  const bool chessboard = !parts.empty() && parts[0] == "chessboard" && parts.size() == 3;
  const std::size_t cross = charuco || chessboard ? parts[1].find('x') : std::string::npos;
  if (cross == std::string::npos)
  {
    throw Error("'" + text +
      "' describes no board; it should be as charuco:15x15:0.03:0.0225:"
      "DICT_5X5_250 or chessboard:9x6:0.025.");
  }
  Board board;
  board.kind = charuco ? Board::Kind::Charuco : Board::Kind::Chessboard;
  board.columns = NumberOf<int>(parts[1].substr(0, cross), text);
  board.rows = NumberOf<int>(parts[1].substr(cross + 1), text);
  board.square = NumberOf<double>(parts[2], text);
  if (charuco)
  {
    board.marker = NumberOf<double>(parts[3], text);
    board.dictionary = parts[4];
  }
  board.Check();
  return board;
}

}
