// SPDX-License-Identifier: BSD-3-Clause
#include "Options/RegionOption.h"

#include <vtkFreespaceUnion.h>
#include <vtkSmartPointer.h>

#include <gtest/gtest.h>

using freespace::RegionOption;

namespace
{

// What a command line sets.
vtkSmartPointer<vtkFreespaceUnion> Given(const std::string& line)
{
  CLI::App app;
  RegionOption option;
  option.AddTo(app);
  app.parse(line);
  auto phi = vtkSmartPointer<vtkFreespaceUnion>::New();
  option.SetUp(phi.Get());
  return phi;
}

}

TEST(RegionOption, IsAutomaticUnlessItIsGiven)
{
  EXPECT_EQ(Given("")->GetRegionMode(), vtkFreespaceUnion::AUTOMATIC_REGION);
  EXPECT_EQ(Given("--region auto")->GetRegionMode(), vtkFreespaceUnion::AUTOMATIC_REGION);
  EXPECT_EQ(Given("--region all")->GetRegionMode(), vtkFreespaceUnion::WHOLE_REGION);
}

TEST(RegionOption, TakesABoxAlsoOfNegativeNumbers)
{
  const auto phi = Given("--region -1.5,2,-3,-2,0,1e3");
  EXPECT_EQ(phi->GetRegionMode(), vtkFreespaceUnion::BOX_REGION);
  const double expected[6] = { -1.5, 2, -3, -2, 0, 1000 };
  EXPECT_TRUE(std::equal(expected, expected + 6, phi->GetRegion()));
}

TEST(RegionOption, TellsWhatIsNoRegion)
{
  for (const char* text : { "most", "1,2,3,4,5", "1,2,3,4,5,6,7", "2,1,0,1,0,1", "0,1,0,1,0,nan",
         "0,1,0,1,0,1x", "0,0,0,1,0,1", ",,,,,", "0,1,0,1,0,1,", "0,1,,1,0,1" })
  {
    EXPECT_THROW(Given(std::string("--region ") + text), CLI::ValidationError) << text;
  }
}
