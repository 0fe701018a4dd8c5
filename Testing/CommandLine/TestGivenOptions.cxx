// SPDX-License-Identifier: BSD-3-Clause
#include "Session/GivenOptions.h"

#include <gtest/gtest.h>

using freespace::GivenOptions;

namespace
{

using Words = std::vector<std::string>;

/// A command with an option of each kind.
struct Command
{
  CLI::App app;
  std::string scene;
  int cells = 256;
  double margin = 0.01;
  bool observed = false;
  std::vector<int> many;

  explicit Command(std::string line)
  {
    app.add_option("scene", scene)->group("Surface");
    app.add_option("-c,--cells", cells)->group("Surface");
    app.add_option("--margin", margin)->group("Other");
    app.add_flag("--observed", observed)->group("Surface");
    app.add_option("--many", many)->group("Surface");
    app.parse(std::move(line));
  }
};

}

TEST(GivenOptions, AreThoseOfTheGroupThatWereGiven)
{
  const Command command("a.json -c 512 --margin 0.02 --observed --many 1 2");
  EXPECT_EQ(GivenOptions(command.app, "Surface"),
    (Words{ "--cells", "512", "--observed", "--many", "1", "2" }));
  EXPECT_EQ(GivenOptions(command.app, "Other"), (Words{ "--margin", "0.02" }));
  EXPECT_EQ(GivenOptions(command.app, "None"), Words{});
}

TEST(GivenOptions, LeaveOutDefaults)
{
  EXPECT_EQ(GivenOptions(Command("a.json").app, "Surface"), Words{});
}
