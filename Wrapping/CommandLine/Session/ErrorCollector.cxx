// SPDX-License-Identifier: BSD-3-Clause
#include "Session/ErrorCollector.h"

#include <vtkObjectFactory.h>

#include <utility>

namespace freespace
{

vtkStandardNewMacro(ErrorCollector);

namespace
{

// VTK's text is "ERROR: In FILE, line N\nvtkClass (0xADDRESS): what is wrong\n\n".
std::string Sentence(const std::string& text)
{
  const std::size_t address = text.find("(0x");
  const std::size_t colon = address == std::string::npos ? address : text.find("): ", address);
  std::string sentence = colon == std::string::npos ? text : text.substr(colon + 3);
  const std::size_t end = sentence.find_last_not_of(" \n\r\t");
  sentence.erase(end == std::string::npos ? 0 : end + 1);
  return sentence;
}

// Messages of VTK about a failure that our own classes report better, with the name of the file.
bool IsOfLittleUse(const std::string& text)
{
  return text.find("returned failure for request") != std::string::npos ||
    text.find("Ran out of disk space") != std::string::npos;
}

}

void ErrorCollector::DisplayErrorText(const char* text)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  std::string& kept = IsOfLittleUse(text) ? this->Poor : this->First;
  if (kept.empty())
  {
    kept = Sentence(text);
  }
}

void ErrorCollector::DisplayWarningText(const char* text)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->Warnings.push_back(Sentence(text));
}

void ErrorCollector::DisplayGenericWarningText(const char* text)
{
  this->DisplayWarningText(text);
}

std::string ErrorCollector::FirstError()
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  return this->First.empty() ? this->Poor : this->First;
}

std::vector<std::string> ErrorCollector::TakeWarnings()
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  return std::exchange(this->Warnings, {});
}

void ErrorCollector::Clear()
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->First.clear();
  this->Poor.clear();
}

}
