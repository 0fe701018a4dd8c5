// SPDX-License-Identifier: BSD-3-Clause
#include "Help/Documentation.h"

#include "Files/AtomicOutput.h"
#include "Help/CommandText.h"
#include "Help/Completion.h"
#include "Help/ManPage.h"

#include <algorithm>
#include <filesystem>

namespace freespace
{

namespace
{

void WriteText(const std::filesystem::path& file, const std::string& text)
{
  std::filesystem::create_directories(file.parent_path());
  AtomicOutput target(file.string());
  target.Write(text.data(), text.size());
  target.Commit();
}

}

void WriteDocumentation(
  const CLI::App& program, const std::string& version, const std::string& folder)
{
  const std::filesystem::path root = folder;
  const std::vector<CommandText> texts = TextsOf(program);
  for (const CommandText& text : texts)
  {
    std::string name = text.name;
    std::replace(name.begin(), name.end(), ' ', '-');
    WriteText(root / "man" / "man1" / (name + ".1"), ManPage(text, version));
  }
  WriteText(root / "bash-completion" / "completions" / "freespace", BashCompletion(texts));
  WriteText(root / "zsh" / "vendor-completions" / "_freespace", ZshCompletion(texts));
}

}
