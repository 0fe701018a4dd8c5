// SPDX-License-Identifier: BSD-3-Clause
#include "Calibration/BoardText.h"

#include "Common/Error.h"

#include <gtest/gtest.h>

using namespace freespace;

TEST(BoardFromText, Charuco)
{
  const Board board = BoardFromText("charuco:15x14:0.03:0.0225:DICT_5X5_250");
  EXPECT_EQ(board.kind, Board::Kind::Charuco);
  EXPECT_EQ(board.columns, 15);
  EXPECT_EQ(board.rows, 14);
  EXPECT_EQ(board.square, 0.03);
  EXPECT_EQ(board.marker, 0.0225);
  EXPECT_EQ(board.dictionary, "DICT_5X5_250");
}

TEST(BoardFromText, Chessboard)
{
  const Board board = BoardFromText("chessboard:9x6:25");
  EXPECT_EQ(board.kind, Board::Kind::Chessboard);
  EXPECT_EQ(board.columns, 9);
  EXPECT_EQ(board.rows, 6);
  EXPECT_EQ(board.square, 25);
}

TEST(BoardFromText, Malformed)
{
  for (const std::string text :
    { "", "charuco", "dots:9x6:1", "charuco:15x15:0.03:0.02", "chessboard:9:1", "chessboard:9x6",
      "chessboard:9x6:1:2", "chessboard:ax6:1", "chessboard:9x6:1m", "chessboard:9x6:0",
      "chessboard:9x-6:1", "charuco:15x15:0.02:0.03:DICT_5X5_250" })
  {
    EXPECT_THROW(BoardFromText(text), Error) << text;
  }
}
