// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ErrorObserver_h
#define freespace_ErrorObserver_h

#include <vtkAlgorithm.h>
#include <vtkCommand.h>
#include <vtkExecutive.h>
#include <vtkNew.h>

#include <string>

namespace freespace
{

/// Counts the errors of an object and keeps the last one's text, instead of printing them.
class ErrorObserver : public vtkCommand
{
public:
  static ErrorObserver* New() { return new ErrorObserver; }
  void Execute(vtkObject*, unsigned long, void* text) override
  {
    ++this->Count;
    this->Last = static_cast<const char*>(text);
    this->All += this->Last;
  }

  /// Whether one of the errors has this text.
  bool Has(const std::string& text) const { return this->All.find(text) != std::string::npos; }

  /// Observes an algorithm and its executive, which reports some of its errors.
  void Observe(vtkAlgorithm* algorithm)
  {
    algorithm->AddObserver(vtkCommand::ErrorEvent, this);
    algorithm->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this);
  }

  int Count = 0;
  std::string Last, All;
};

/// Turns the display of warnings and errors off in its scope; observers do not get them either.
class QuietWarnings
{
public:
  QuietWarnings() { vtkObject::GlobalWarningDisplayOff(); }
  ~QuietWarnings() { vtkObject::GlobalWarningDisplayOn(); }
  QuietWarnings(const QuietWarnings&) = delete;
  QuietWarnings& operator=(const QuietWarnings&) = delete;
};

/// Updates an algorithm and returns the text of its errors; empty when there is none.
inline std::string ErrorOfUpdate(vtkAlgorithm* algorithm)
{
  vtkNew<ErrorObserver> errors;
  const unsigned long tag = algorithm->AddObserver(vtkCommand::ErrorEvent, errors);
  algorithm->Update();
  algorithm->RemoveObserver(tag);
  return errors->All;
}

}

#endif
