// SPDX-License-Identifier: BSD-3-Clause
#include "Text/XmlNode.h"

#include "Common/Error.h"
#include "Support/TemporaryFolder.h"
#include "Support/Core/ErrorOf.h"

#include <gtest/gtest.h>

using namespace freespace;

namespace
{

XmlNode Parse(const std::string& text)
{
  const TemporaryFolder folder;
  return ReadXmlFile(folder.Write("a.xml", text));
}

// The message of the Error that the text gives.
std::string XmlErrorOf(const std::string& text)
{
  return ErrorOf([&text] { (void)Parse(text); });
}

void ExpectFault(const std::string& text, const std::string& fault)
{
  const std::string message = XmlErrorOf(text);
  EXPECT_NE(message.find(fault), std::string::npos) << message;
  EXPECT_NE(message.find("a.xml, line "), std::string::npos) << message;
}

}

TEST(XmlNode, KeepsElementsAttributesAndText)
{
  const XmlNode root = Parse("<?xml version=\"1.0\"?>\n<a k=\"v &amp; w\">\n  <b>1 2.5\n-3e1</b>\n"
                             "  <c/><b>second</b>\n</a>\n");
  EXPECT_EQ(root.name, "a");
  EXPECT_EQ(root.line, 2u);
  EXPECT_EQ(root.Attribute("k"), "v & w");
  EXPECT_EQ(root.Attribute("absent"), "");
  ASSERT_EQ(root.children.size(), 3u);
  EXPECT_EQ(root.At("b").line, 3u);
  EXPECT_EQ(root.At("b").Numbers(3), (std::vector<double>{ 1, 2.5, -30 }))
    << "the first of the name";
  EXPECT_EQ(root.children[2].text, "second");
  EXPECT_EQ(root.Find("d"), nullptr);
  EXPECT_EQ(root.NumberOr("d", 7), 7);
  EXPECT_TRUE(root.At("c").Numbers(0).empty());
}

TEST(XmlNode, ErrorsNameTheElementAndItsLine)
{
  const XmlNode root = Parse("<a>\n\n<b>1 x</b><c>1 2</c></a>");
  const auto message = [](const auto& action)
  {
    try
    {
      action();
    }
    catch (const Error& error)
    {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_NE(
    message([&] { (void)root.At("d"); }).find("the element 'a' has no 'd'"), std::string::npos);
  EXPECT_NE(message([&] { (void)root.At("b").Numbers(2); }).find("line 3: 'x' is not a number"),
    std::string::npos);
  EXPECT_NE(
    message([&] { (void)root.At("c").Numbers(3); }).find("'c' should have 3 numbers, not 2"),
    std::string::npos);
  EXPECT_NE(
    message([&] { (void)root.NumberOr("c", 0); }).find("1 numbers, not 2"), std::string::npos);
}

TEST(XmlNode, RefusesWhatIsNotXml)
{
  ExpectFault("", "it is not a valid .xml");
  ExpectFault("<a><b></a>", "it is not a valid .xml");
  ExpectFault("<a/><b/>", "it is not a valid .xml");
  ExpectFault("<!DOCTYPE a [<!ENTITY x \"xxxxxxxx\">]><a>&x;</a>", "a document type");
  std::string deep;
  for (int i = 0; i < 100000; ++i)
  {
    deep += "<a>";
  }
  ExpectFault(deep, "its elements are nested too deep");
  EXPECT_THROW((void)ReadXmlFile("/no/such/file.xml"), Error);
}

// The file is parsed in pieces of a megabyte.
TEST(XmlNode, TextOfSeveralMegabytesIsWhole)
{
  std::string text = "<a>", expected;
  for (int i = 0; expected.size() < 3000000; ++i)
  {
    expected += std::to_string(i) + " ";
  }
  text += expected + "</a>";
  EXPECT_EQ(Parse(text).text, expected);
}
