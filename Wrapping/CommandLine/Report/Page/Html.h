// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Html_h
#define freespace_Html_h

#include <map>
#include <string>

namespace freespace
{

/// Text for a page or an attribute's value: & < > " ' become entities, and bytes that are not UTF-8 and
/// control characters (other than tab and newline) the replacement character.
std::string EscapeHtml(const std::string& text);

/// The template with each {{name}} replaced by its part, which is markup and taken as it is. Throws Error
/// if the template names an unknown part, or a part has no placeholder.
std::string FillTemplate(const std::string& text, const std::map<std::string, std::string>& parts);

}

#endif
