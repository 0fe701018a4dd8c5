// SPDX-License-Identifier: BSD-3-Clause
#include "Help/CommandText.h"

#include <algorithm>
#include <sstream>

namespace freespace
{

namespace
{

// "not with --scene, --model", in the order of their names: CLI11 keeps them by address.
std::string ExclusionText(const CLI::Option& option)
{
  std::vector<std::string> names;
  for (const CLI::Option* other : option.get_excludes())
  {
    names.push_back(other->get_name());
  }
  std::sort(names.begin(), names.end());
  std::string text;
  for (const std::string& name : names)
  {
    text += (text.empty() ? "not with " : ", ") + name;
  }
  return text;
}

// "0 to 1024" where a type is INT:INT in [0 - 1024].
std::string LimitsOf(const std::string& type)
{
  const std::size_t begin = type.find("in ["), dash = type.find(" - ", begin);
  const std::size_t end = type.find(']', dash);
  if (begin == std::string::npos || dash == std::string::npos || end == std::string::npos)
  {
    return "";
  }
  return type.substr(begin + 4, dash - begin - 4) + " to " + type.substr(dash + 3, end - dash - 3);
}

OptionText TextOf(const CLI::Option& option)
{
  OptionText text;
  for (const std::string& name : option.get_snames())
  {
    text.names.push_back("-" + name);
  }
  for (const std::string& name : option.get_lnames())
  {
    text.names.push_back("--" + name);
  }
  if (option.get_positional())
  {
    text.names = { option.get_name(true) };
  }
  text.isRequired = option.get_required();
  text.isRepeated = option.get_expected_max() > 1;
  text.description = option.get_description();
  std::vector<std::string> remarks;
  if (option.get_type_size() != 0)
  {
    // CLI11 puts the names of the checks behind the type's: INT:INT in [0 - 1024].
    const std::string type = option.get_type_name();
    const std::size_t colon = type.find(':');
    text.value = type.substr(0, colon);
    const std::string limits = LimitsOf(type);
    if (!limits.empty())
    {
      remarks.push_back(limits);
    }
    if (!option.get_default_str().empty() && option.get_default_str() != "[]")
    {
      remarks.push_back("default " + option.get_default_str());
    }
  }
  if (text.isRequired && !option.get_positional())
  {
    remarks.push_back("required");
  }
  const std::string exclusion = ExclusionText(option);
  if (!exclusion.empty())
  {
    remarks.push_back(exclusion);
  }
  std::string remark;
  for (const std::string& part : remarks)
  {
    remark += (remark.empty() ? "" : "; ") + part;
  }
  if (!remark.empty())
  {
    text.description += " (" + remark + ")";
  }
  return text;
}

bool IsShown(const CLI::Option* option)
{
  return !option->get_group().empty();
}

std::vector<OptionText> TextsOf(const std::vector<const CLI::Option*>& options)
{
  std::vector<OptionText> texts;
  for (const CLI::Option* option : options)
  {
    texts.push_back(TextOf(*option));
  }
  return texts;
}

std::vector<OptionGroupText> GroupsOf(const CLI::App& app)
{
  std::vector<OptionGroupText> groups;
  for (const std::string& title : app.get_groups())
  {
    const auto options = app.get_options([&title](const CLI::Option* option)
      { return IsShown(option) && option->get_group() == title && option->nonpositional(); });
    if (!options.empty())
    {
      groups.push_back({ title, TextsOf(options) });
    }
  }
  // CLI11 has groups of alternatives as nameless commands.
  for (const CLI::App* group :
    app.get_subcommands([](const CLI::App* sub) { return sub->get_name().empty(); }))
  {
    groups.push_back({ group->get_description(), TextsOf(group->get_options(IsShown)) });
  }
  return groups;
}

bool IsHelp(const OptionText& option)
{
  return std::find(option.names.begin(), option.names.end(), "--help") != option.names.end();
}

}

std::vector<OptionText> CommandText::AllOptions() const
{
  std::vector<OptionText> all;
  for (const OptionGroupText& group : this->groups)
  {
    all.insert(all.end(), group.options.begin(), group.options.end());
  }
  all.insert(all.end(), this->shared.begin(), this->shared.end());
  return all;
}

std::string CommandText::Usage() const
{
  std::string usage = this->name + (this->commands.empty() ? "" : " COMMAND") + " [OPTIONS]";
  for (const OptionText& positional : this->positionals)
  {
    const std::string shown = positional.names.front() + (positional.isRepeated ? "..." : "");
    usage += positional.isRequired ? " " + shown : " [" + shown + "]";
  }
  return usage;
}

CommandText TextOf(const CLI::App& app)
{
  const CLI::App* program = app.get_parent();
  CommandText text;
  text.name = (program ? program->get_name() + " " : "") + app.get_name();
  text.description = app.get_description();
  text.positionals = TextsOf(app.get_options(
    [](const CLI::Option* option) { return IsShown(option) && option->get_positional(); }));
  text.groups = GroupsOf(app);
  if (program)
  {
    for (const OptionGroupText& group : GroupsOf(*program))
    {
      std::copy_if(group.options.begin(), group.options.end(), std::back_inserter(text.shared),
        [](const OptionText& option) { return !IsHelp(option); });
    }
  }
  for (const CLI::App* command :
    app.get_subcommands([](const CLI::App* sub) { return !sub->get_name().empty(); }))
  {
    text.commands.emplace_back(command->get_name(), command->get_description());
  }
  text.footer = app.get_footer();
  return text;
}

std::vector<CommandText> TextsOf(const CLI::App& program)
{
  std::vector<CommandText> texts = { TextOf(program) };
  for (const CLI::App* command :
    program.get_subcommands([](const CLI::App* sub) { return !sub->get_name().empty(); }))
  {
    texts.push_back(TextOf(*command));
  }
  return texts;
}

std::string Wrapped(
  const std::string& text, std::size_t indent, std::size_t begun, std::size_t columns)
{
  std::istringstream words(text);
  std::string wrapped;
  std::size_t column = begun;
  bool first = true;
  for (std::string word; words >> word; first = false)
  {
    if (!first && column + 1 + word.size() > columns)
    {
      wrapped += "\n" + std::string(indent, ' ') + word;
      column = indent + word.size();
    }
    else
    {
      wrapped += (first ? "" : " ") + word;
      column += (first ? 0 : 1) + word.size();
    }
  }
  return wrapped;
}

}
