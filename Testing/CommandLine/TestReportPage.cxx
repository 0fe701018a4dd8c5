// SPDX-License-Identifier: BSD-3-Clause
#include "Report/Page/ReportPage.h"

#include "Report/Page/Html.h"
#include "Support/Core/CountParts.h"

#include <gtest/gtest.h>

#include <limits>

using namespace freespace;

namespace
{

Report SmallReport(const std::string& name)
{
  const InlinePicture picture{ "data:image/jpeg;base64,AAAA", 4, 3 };
  Report report;
  report.title = name;
  report.summary = name;
  report.facts = { { name, name } };
  report.model = "{}";
  report.modelCaption = name;
  report.views = { { name, name, { picture, name }, { picture, name } } };
  report.viewsCaption = name;
  report.cameras = "<svg></svg>";
  report.camerasCaption = name;
  report.features = report.surface = report.textured = { { picture, name } };
  report.numbers = { { name, { name, name }, { { name, name } }, true, { name } } };
  report.truth = report.numbers[0];
  report.commands = { { name, name } };
  report.footer = name;
  return report;
}

}

TEST(ReportPage, EscapesEveryName)
{
  const std::string evil = "<script>alert('1')</script>\" onload=x";
  const std::string harmless = WriteReportPage(SmallReport("name"));
  const std::string page = WriteReportPage(SmallReport(evil));
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  EXPECT_EQ(page.find("\" onload"), std::string::npos);
  EXPECT_EQ(CountParts(page, "<"), CountParts(harmless, "<"));
  const std::string marked = WriteReportPage(SmallReport("@@"));
  EXPECT_EQ(CountParts(page, EscapeHtml(evil)), CountParts(marked, "@@"));
  EXPECT_GT(CountParts(marked, "@@"), 20u);
}

TEST(ReportPage, KeepsTheModelWithinItsElement)
{
  Report report = SmallReport("a");
  report.model = "{\"x\":\"</script><b>\"}";
  const std::string page = WriteReportPage(report);
  EXPECT_EQ(page.find("</script><b>"), std::string::npos);
  EXPECT_NE(page.find("{\"x\":\"\\u003c/script>\\u003cb>\"}"), std::string::npos);
}

TEST(ReportPage, LeavesOutTheTruthThatThereIsNot)
{
  Report report = SmallReport("a");
  EXPECT_NE(WriteReportPage(report).find("id=\"truth\""), std::string::npos);
  report.truth.reset();
  const std::string page = WriteReportPage(report);
  EXPECT_EQ(page.find("id=\"truth\""), std::string::npos);
  EXPECT_EQ(page.find("#truth"), std::string::npos);
}

TEST(ReportPage, NeedsNoNetwork)
{
  const std::string page = WriteReportPage(SmallReport("a"));
  EXPECT_EQ(page.find("http"), std::string::npos);
  EXPECT_EQ(page.find("src=\"/"), std::string::npos);
  EXPECT_EQ(page.find("@import"), std::string::npos);
  EXPECT_EQ(page.find("{{"), std::string::npos) << "an unfilled part";
}

TEST(Format, Counts)
{
  EXPECT_EQ(FormatCount(0), "0");
  EXPECT_EQ(FormatCount(999), "999");
  EXPECT_EQ(FormatCount(1000), "1,000");
  EXPECT_EQ(FormatCount(-123456), "-123,456");
  EXPECT_EQ(FormatCount(1234567890123LL), "1,234,567,890,123");
}

TEST(Format, NumbersToThreeDigits)
{
  EXPECT_EQ(FormatNumber(0), "0");
  EXPECT_EQ(FormatNumber(0.00012345), "0.000123");
  EXPECT_EQ(FormatNumber(1.0), "1.00");
  EXPECT_EQ(FormatNumber(-12.345), "-12.3");
  EXPECT_EQ(FormatNumber(12345.6), "12346");
  EXPECT_EQ(FormatNumber(std::numeric_limits<double>::quiet_NaN()), "–");
}

TEST(Format, SharesAndSeconds)
{
  EXPECT_EQ(FormatShare(0.97249), "97.2 %");
  EXPECT_EQ(FormatShare(std::numeric_limits<double>::quiet_NaN()), "–");
  EXPECT_EQ(FormatSeconds(0.4249), "0.42 s");
  EXPECT_EQ(FormatSeconds(12.34), "12.3 s");
  EXPECT_EQ(FormatSeconds(119.7), "2 min 0 s");
}
