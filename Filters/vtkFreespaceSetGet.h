// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkFreespaceSetGet.h
 * @brief macros for file names, beside those of vtkSetGet.h
 */
#ifndef vtkFreespaceSetGet_h
#define vtkFreespaceSetGet_h

#include "vtkSetGet.h"

#include <string> // for file names

/**
 * What vtkSetFilePathMacro and vtkGetFilePathMacro declare, over a member that is a std::string. Null and the empty
 * string are no name. C++ may pass either kind of string, Python a path.
 */
#define vtkSetFilePathStringMacro(name)                                                            \
  virtual void Set##name(VTK_FILEPATH const std::string& _arg)                                     \
  {                                                                                                \
    vtkDebugMacro(<< "setting " #name " to " << _arg);                                             \
    if (this->name != _arg)                                                                        \
    {                                                                                              \
      this->name = _arg;                                                                           \
      this->Modified();                                                                            \
    }                                                                                              \
  }                                                                                                \
  void Set##name(VTK_FILEPATH const char* _arg)                                                    \
  {                                                                                                \
    this->Set##name(std::string(_arg ? _arg : ""));                                                \
  }

#define vtkGetFilePathStringMacro(name)                                                            \
  virtual VTK_FILEPATH std::string Get##name()                                                     \
  {                                                                                                \
    return this->name;                                                                             \
  }

#endif
