// SPDX-License-Identifier: BSD-3-Clause
#include "Common/Error.h"
#include "Report/Page/DataUri.h"
#include "Report/Page/Html.h"
#include "Report/Page/ReportPage.h"
#include "Report/Page/ShellCommand.h"
#include "Support/TemporaryFolder.h"
#include "Support/Core/CountParts.h"

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <array>
#include <cstdio>
#include <fstream>
#include <limits>
#include <random>

using namespace freespace;

namespace
{

// What a POSIX shell makes of a command line's words.
std::vector<std::string> WordsInShell(const std::string& command)
{
  const std::string line = "for w in " + command + "; do printf '%s\\0' \"$w\"; done";
  std::string output;
  FILE* pipe = popen(("LC_ALL=C " + std::string("sh -c ") + QuoteForShell(line)).c_str(), "r");
  std::array<char, 256> buffer{};
  for (std::size_t n = 0; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
  {
    output.append(buffer.data(), n);
  }
  pclose(pipe);
  std::vector<std::string> words;
  for (std::size_t at = 0; at < output.size();)
  {
    const std::size_t end = output.find('\0', at);
    words.push_back(output.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

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

TEST(Html, EscapesWhatMarkupMeans)
{
  EXPECT_EQ(EscapeHtml("<a href=\"x\" title='y'>&</a>"),
    "&lt;a href=&quot;x&quot; title=&#39;y&#39;&gt;&amp;&lt;/a&gt;");
  EXPECT_EQ(EscapeHtml(""), "");
  EXPECT_EQ(EscapeHtml("Würfel – 木"), "Würfel – 木");
}

TEST(Html, ReplacesWhatIsNoText)
{
  const std::string replaced = "\xef\xbf\xbd";
  EXPECT_EQ(EscapeHtml("a\xff"
                       "b"),
    "a" + replaced + "b");
  EXPECT_EQ(EscapeHtml("\xc3"), replaced) << "cut off";
  EXPECT_EQ(EscapeHtml("\xc0\xaf"), replaced + replaced) << "longer than need be";
  EXPECT_EQ(EscapeHtml("\xed\xa0\x80"), replaced + replaced + replaced) << "a surrogate";
  EXPECT_EQ(EscapeHtml(std::string("a\0b\x1b", 4)), "a" + replaced + "b" + replaced);
  EXPECT_EQ(EscapeHtml("a\tb\n"), "a\tb\n");
}

TEST(Template, IsFilled)
{
  EXPECT_EQ(FillTemplate("a{{x}}b{{y}}{{x}}", { { "x", "{{y}}" }, { "y", "" } }), "a{{y}}b{{y}}");
  EXPECT_THROW(FillTemplate("{{x}}", {}), Error);
  EXPECT_THROW(FillTemplate("{{x", { { "x", "1" } }), Error);
  EXPECT_THROW(FillTemplate("a", { { "x", "1" } }), Error);
}

TEST(Shell, LeavesPlainWords)
{
  EXPECT_EQ(ShellCommand({ "freespace", "report", "a/b_c-1.json", "--cells", "256" }),
    "freespace report a/b_c-1.json --cells 256");
}

TEST(Shell, TakesEveryWordBackAsItWas)
{
  const std::vector<std::string> words = { "", " ", "a b", "it's", "'", "''", "$HOME", "`id`",
    "a\\b", "a\nb", "*", "~", "#x", "-o", "\"", "!", "Würfel", ";rm -rf x", "a'$(id)'b" };
  EXPECT_EQ(WordsInShell(ShellCommand(words)), words);
}

TEST(Shell, TakesRandomWordsBack)
{
  std::mt19937 random(7);
  std::vector<std::string> words;
  for (int i = 0; i < 50; ++i)
  {
    std::string word;
    for (int k = random() % 12; k > 0; --k)
    {
      word += static_cast<char>(1 + random() % 126);
    }
    words.push_back(word);
  }
  EXPECT_EQ(WordsInShell(ShellCommand(words)), words);
}

TEST(Base64, IsThatOfTheStandard)
{
  const std::string text = "foobar"; // RFC 4648, section 10
  const char* expected[] = { "", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy" };
  for (std::size_t n = 0; n <= text.size(); ++n)
  {
    EXPECT_EQ(Base64(text.data(), n), expected[n]);
  }
  const unsigned char bytes[] = { 0xfb, 0xff, 0xfe };
  EXPECT_EQ(Base64(bytes, 3), "+//+");
  EXPECT_EQ(Base64(std::vector<std::uint16_t>{ 1, 256 }), "AQAAAQ==") << "little-endian";
}

TEST(InlinePicture, IsNoWiderThanAsked)
{
  const TemporaryFolder folder;
  const std::string file = folder.Path("picture.png");
  cv::imwrite(file, cv::Mat(30, 100, CV_8UC3, cv::Scalar(10, 20, 30)));
  const InlinePicture small = InlinePictureFromFile(file, 50);
  EXPECT_EQ(small.width, 50);
  EXPECT_EQ(small.height, 15);
  EXPECT_EQ(small.uri.rfind("data:image/jpeg;base64,/9j/", 0), 0u);
  EXPECT_EQ(InlinePictureFromFile(file, 200).width, 100) << "never enlarged";
}

TEST(InlinePicture, NamesTheFileThatIsNone)
{
  const TemporaryFolder folder;
  const std::string file = folder.Path("picture.png");
  std::ofstream(file) << "no picture";
  for (const std::string& name : { file, folder.Path("none.png") })
  {
    try
    {
      InlinePictureFromFile(name, 50);
      FAIL() << name;
    }
    catch (const Error& error)
    {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
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
