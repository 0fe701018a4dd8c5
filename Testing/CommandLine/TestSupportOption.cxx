// SPDX-License-Identifier: BSD-3-Clause
#include "Options/SupportOption.h"

#include "Disparity/Outliers/OutlierOptions.h"

#include <gtest/gtest.h>

using namespace freespace;

TEST(SupportOption, IsThatOfTheCoreByDefault)
{
  CLI::App command;
  SupportOption option;
  EXPECT_EQ(option.Support(), OutlierOptions().support) << "of no command";
  option.AddTo(command, "Features");
  command.parse("", false);
  EXPECT_EQ(option.Support(), OutlierOptions().support);
  EXPECT_EQ(option.SharingViews(), OutlierOptions().sharingViews);
}

// `reconstruct` has one option for its features and its maps.
TEST(SupportOption, IsSharedByTheStagesOfACommand)
{
  CLI::App command;
  SupportOption first, second;
  first.AddTo(command, "Features");
  second.AddTo(command, "Disparity maps");
  command.parse("--support 4 --sharing-views 0", false);
  for (const SupportOption& option : { first, second })
  {
    EXPECT_EQ(option.Support(), 4);
    EXPECT_EQ(option.SharingViews(), 0);
  }
}

TEST(SupportOption, RefusesWhatIsNoCount)
{
  for (const char* words :
    { "--support -1", "--support x", "--support 1.5", "--sharing-views 9999999999" })
  {
    CLI::App command;
    SupportOption option;
    option.AddTo(command, "Features");
    EXPECT_THROW(command.parse(words, false), CLI::ValidationError) << words;
  }
}
