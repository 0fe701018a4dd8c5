// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ErrorObserver_h
#define freespace_ErrorObserver_h

#include <vtkAlgorithm.h>
#include <vtkCommand.h>
#include <vtkExecutive.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include <gtest/gtest.h>

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

/// Keeps in its scope what VTK reports instead of printing it, and fails the test when nothing was reported: for
/// inputs that must be refused. Objects with an observer of their own report to that one.
class ExpectedErrors
{
public:
  ExpectedErrors()
  {
    vtkOutputWindow::SetInstance(this->Window);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  }
  ~ExpectedErrors()
  {
    EXPECT_FALSE(this->Window->Text.empty()) << "no error was reported";
    vtkLogger::SetStderrVerbosity(this->Verbosity);
    vtkOutputWindow::SetInstance(this->Previous);
  }
  ExpectedErrors(const ExpectedErrors&) = delete;
  ExpectedErrors& operator=(const ExpectedErrors&) = delete;

  /// Whether one of the errors since the last call has this text.
  testing::AssertionResult Has(const std::string& text)
  {
    const std::string since = this->Window->Text.substr(this->Read);
    this->Read = this->Window->Text.size();
    if (since.find(text) != std::string::npos)
    {
      return testing::AssertionSuccess();
    }
    return testing::AssertionFailure() << "no '" << text << "' in '" << since << "'";
  }

private:
  class TextWindow : public vtkOutputWindow
  {
  public:
    static TextWindow* New() { return new TextWindow; }
    void DisplayText(const char* text) override { this->Text += text; }
    std::string Text;
  };

  vtkSmartPointer<vtkOutputWindow> Previous = vtkOutputWindow::GetInstance();
  vtkLogger::Verbosity Verbosity = vtkLogger::GetCurrentVerbosityCutoff();
  vtkNew<TextWindow> Window;
  std::size_t Read = 0;
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
