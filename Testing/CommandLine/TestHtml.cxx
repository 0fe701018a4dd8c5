// SPDX-License-Identifier: BSD-3-Clause
#include "Report/Page/Html.h"

#include "Common/Error.h"

#include <gtest/gtest.h>

using namespace freespace;

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
