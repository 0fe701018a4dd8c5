// SPDX-License-Identifier: BSD-3-Clause
#include "Help/Completion.h"

#include <algorithm>

namespace freespace
{

namespace
{

std::string CommandOf(const CommandText& text)
{
  return text.name.substr(text.name.find(' ') + 1);
}

// Between single quotes, for both shells.
std::string Quoted(const std::string& text)
{
  std::string quoted;
  for (const char c : text)
  {
    quoted += c == '\'' ? "'\\''" : std::string(1, c);
  }
  return quoted;
}

std::string Joined(const std::vector<std::string>& words)
{
  std::string joined;
  for (const std::string& word : words)
  {
    joined += (joined.empty() ? "" : " ") + word;
  }
  return joined;
}

std::vector<std::string> NamesOf(const CommandText& text)
{
  std::vector<std::string> names;
  for (const OptionText& option : text.AllOptions())
  {
    names.insert(names.end(), option.names.begin(), option.names.end());
  }
  return names;
}

std::string CommandNames(const CommandText& program)
{
  std::vector<std::string> names;
  for (const auto& command : program.commands)
  {
    names.push_back(command.first);
  }
  return Joined(names);
}

// Brackets and colons are _arguments' own.
std::string ZshDescription(const std::string& text)
{
  std::string plain = text;
  std::replace(plain.begin(), plain.end(), '[', '(');
  std::replace(plain.begin(), plain.end(), ']', ')');
  std::string escaped;
  for (const char c : Quoted(plain))
  {
    escaped += (c == ':' ? "\\" : "") + std::string(1, c);
  }
  return escaped;
}

std::string ZshOptions(const CommandText& text)
{
  std::string lines;
  for (const OptionText& option : text.AllOptions())
  {
    for (const std::string& name : option.names)
    {
      lines += " \\\n        '" + name + "[" + ZshDescription(option.description) + "]" +
        (option.value.empty() ? "" : ":" + ZshDescription(option.value) + ":_files") + "'";
    }
  }
  return lines + " \\\n        '*:file:_files'\n";
}

}

std::string BashCompletion(const std::vector<CommandText>& texts)
{
  std::string script = "# bash completion of freespace\n"
                       "_freespace()\n{\n"
                       "  local word=${COMP_WORDS[COMP_CWORD]} command= options= i\n"
                       "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
                       "    case ${COMP_WORDS[i]} in\n"
                       "      -*) ;;\n"
                       "      *) command=${COMP_WORDS[i]}; break ;;\n"
                       "    esac\n"
                       "  done\n"
                       "  case $command in\n";
  for (std::size_t i = 1; i < texts.size(); ++i)
  {
    script +=
      "    " + CommandOf(texts[i]) + ") options='" + Quoted(Joined(NamesOf(texts[i]))) + "' ;;\n";
  }
  script += "    *) options='" + Quoted(Joined(NamesOf(texts[0])) + " " + CommandNames(texts[0])) +
    "' ;;\n  esac\n"
    "  COMPREPLY=()\n"
    "  if [[ $word == -* || -z $command ]]; then\n"
    "    COMPREPLY=($(compgen -W \"$options\" -- \"$word\"))\n"
    "  fi\n"
    "}\n"
    "complete -o default -F _freespace freespace\n";
  return script;
}

std::string ZshCompletion(const std::vector<CommandText>& texts)
{
  std::string script = "#compdef freespace\n"
                       "# zsh completion of freespace\n"
                       "_freespace()\n{\n"
                       "  local command=${words[(r)(";
  for (const auto& entry : texts[0].commands)
  {
    script += (entry == texts[0].commands.front() ? "" : "|") + entry.first;
  }
  script += ")]}\n"
            "  case $command in\n";
  for (std::size_t i = 1; i < texts.size(); ++i)
  {
    script +=
      "    " + CommandOf(texts[i]) + ")\n      _arguments" + ZshOptions(texts[i]) + "      ;;\n";
  }
  script += "    *)\n      local -a commands=(\n";
  for (const auto& [name, description] : texts[0].commands)
  {
    script += "        '" + name + ":" + ZshDescription(description) + "'\n";
  }
  script += "      )\n      _describe command commands\n      ;;\n  esac\n}\n_freespace \"$@\"\n";
  return script;
}

}
