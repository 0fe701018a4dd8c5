// SPDX-License-Identifier: BSD-3-Clause
#include "OSMesa/WindowChoice.h"

#include <vtkObjectFactory.h>
#include <vtkObjectFactoryCollection.h>

#include <dlfcn.h>

#include <cstdlib>
#include <string>

namespace freespace
{

namespace
{

// Asked at run time: the library has no other use for libX11.
bool XServerAnswers()
{
  const char* display = std::getenv("DISPLAY");
  if (!display || !*display)
  {
    return false;
  }
  void* library = dlopen("libX11.so.6", RTLD_LAZY | RTLD_LOCAL);
  if (!library)
  {
    return false;
  }
  using Open = void* (*)(const char*);
  using Close = int (*)(void*);
  const auto open = reinterpret_cast<Open>(dlsym(library, "XOpenDisplay"));
  const auto close = reinterpret_cast<Close>(dlsym(library, "XCloseDisplay"));
  void* connection = open && close ? open(nullptr) : nullptr;
  if (connection)
  {
    close(connection);
  }
  dlclose(library);
  return connection != nullptr;
}

}

WindowWish WantedWindow()
{
  const char* text = std::getenv("FREESPACE_WINDOW");
  const std::string wish = text ? text : "";
  return wish == "osmesa" ? WindowWish::OSMesa
    : wish == "display"   ? WindowWish::Display
                          : WindowWish::Automatic;
}

bool ChooseOSMesa()
{
  const WindowWish wish = WantedWindow();
  if (wish == WindowWish::Display || (wish == WindowWish::Automatic && XServerAnswers()))
  {
    return false;
  }
  vtkObjectFactoryCollection* factories = vtkObjectFactory::GetRegisteredFactories();
  vtkCollectionSimpleIterator at;
  factories->InitTraversal(at);
  while (vtkObjectFactory* factory = factories->GetNextObjectFactory(at))
  {
    factory->Disable("vtkRenderWindow");
    factory->Disable("vtkRenderWindowInteractor");
  }
  return true;
}

}
