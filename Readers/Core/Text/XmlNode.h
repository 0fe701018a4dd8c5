// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_XmlNode_h
#define freespace_XmlNode_h

#include <map>
#include <string>
#include <vector>

namespace freespace
{

/// An element of an XML file with its content. Errors (Error) name the file and the element's line.
struct XmlNode
{
  std::string file;
  std::size_t line = 0;
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string text; ///< between the elements that are in it, too
  std::vector<XmlNode> children;

  [[noreturn]] void Fail(const std::string& fault) const;

  /// The first child of a name; nullptr where there is none.
  const XmlNode* Find(const std::string& child) const;
  const XmlNode& At(const std::string& child) const;

  /// An attribute, empty when it is not there.
  std::string Attribute(const std::string& key) const;

  /// The numbers of the text.
  std::vector<double> Numbers(std::size_t count) const;

  /// The number of a child, or another where there is no such child.
  double NumberOr(const std::string& child, double otherwise) const;
};

/// Reads an XML file without a document type. Throws Error naming the file and line where it is not valid
/// or elements are nested too deep.
XmlNode ReadXmlFile(const std::string& file);

}

#endif
