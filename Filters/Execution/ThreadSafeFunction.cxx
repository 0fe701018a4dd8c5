// SPDX-License-Identifier: BSD-3-Clause
#include "Execution/ThreadSafeFunction.h"

#include <vtkBox.h>
#include <vtkCone.h>
#include <vtkCylinder.h>
#include <vtkImplicitBoolean.h>
#include <vtkImplicitFunctionCollection.h>
#include <vtkPlane.h>
#include <vtkQuadric.h>
#include <vtkSphere.h>

#include <typeinfo>

namespace freespace
{

namespace
{

// Of a class itself: a subclass may keep something between two evaluations.
template <typename... Classes>
bool IsOneOf(vtkImplicitFunction& function)
{
  return ((typeid(function) == typeid(Classes)) || ...);
}

bool AreThreadSafe(vtkImplicitFunctionCollection* functions)
{
  vtkCollectionSimpleIterator place;
  functions->InitTraversal(place);
  while (vtkImplicitFunction* function = functions->GetNextImplicitFunction(place))
  {
    if (!IsThreadSafeFunction(function))
    {
      return false;
    }
  }
  return true;
}

}

bool IsThreadSafeFunction(vtkImplicitFunction* function)
{
  if (function->GetTransform())
  {
    return false; // it brings itself up to date at each evaluation
  }
  if (IsOneOf<vtkImplicitBoolean>(*function))
  {
    return AreThreadSafe(vtkImplicitBoolean::SafeDownCast(function)->GetFunction());
  }
  return IsOneOf<vtkBox, vtkCone, vtkCylinder, vtkPlane, vtkQuadric, vtkSphere>(*function);
}

}
