// SPDX-License-Identifier: BSD-3-Clause
// The module freespace._unlocked: calls that take long, without Python's lock. VTK's wrapper keeps the lock
// during every call, so that no other Python thread runs and no signal is heard until it returns.
#include <vtkPythonUtil.h>

#include <vtkAlgorithm.h>
#include <vtkDoubleArray.h>
#include <vtkFreespaceUnion.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWriter.h>

#include <exception>
#include <string>

namespace
{

/// The VTK object of a Python object; null, with a TypeError set, where it is of another class.
template <typename Class>
Class* Wrapped(PyObject* object, const char* name)
{
  return static_cast<Class*>(vtkPythonUtil::GetPointerFromObject(object, name));
}

/// Calls without Python's lock. False, with an exception set, where the call throws.
template <typename Call>
bool CallUnlocked(const Call& call)
{
  std::string fault;
  PyThreadState* state = PyEval_SaveThread();
  try
  {
    call();
  }
  catch (const std::exception& error)
  {
    fault = error.what();
  }
  PyEval_RestoreThread(state);
  if (!fault.empty())
  {
    PyErr_SetString(PyExc_RuntimeError, fault.c_str());
  }
  return fault.empty();
}

PyObject* Update(PyObject*, PyObject* arguments)
{
  PyObject* object = nullptr;
  int port = 0;
  if (!PyArg_ParseTuple(arguments, "Oi", &object, &port))
  {
    return nullptr;
  }
  vtkObjectBase* updated = Wrapped<vtkObjectBase>(object, "vtkObjectBase");
  if (!updated)
  {
    return nullptr;
  }
  auto* algorithm = vtkAlgorithm::SafeDownCast(updated);
  auto* phi = vtkFreespaceUnion::SafeDownCast(updated);
  if (!algorithm && !phi)
  {
    PyErr_SetString(PyExc_TypeError, "Only algorithms and unions are updated.");
    return nullptr;
  }
  const bool isDone = CallUnlocked(
    [&] { phi           ? phi->Update()
            : port == 0 ? algorithm->Update()
                        : algorithm->Update(port); });
  return isDone ? Py_NewRef(Py_None) : nullptr;
}

PyObject* Write(PyObject*, PyObject* object)
{
  auto* writer = Wrapped<vtkWriter>(object, "vtkWriter");
  int result = 0;
  if (!writer || !CallUnlocked([&] { result = writer->Write(); }))
  {
    return nullptr;
  }
  return PyLong_FromLong(result);
}

/// A batch of the union over points: ask(phi, points, results).
template <typename Results, typename Ask>
PyObject* AskPoints(PyObject* arguments, const char* resultsName, const Ask& ask)
{
  PyObject *phi = nullptr, *points = nullptr, *results = nullptr;
  if (!PyArg_ParseTuple(arguments, "OOO", &phi, &points, &results))
  {
    return nullptr;
  }
  auto* asked = Wrapped<vtkFreespaceUnion>(phi, "vtkFreespaceUnion");
  auto* at = asked ? Wrapped<vtkPoints>(points, "vtkPoints") : nullptr;
  auto* answers = at ? Wrapped<Results>(results, resultsName) : nullptr;
  if (!answers || !CallUnlocked([&] { ask(asked, at, answers); }))
  {
    return nullptr;
  }
  return Py_NewRef(Py_None);
}

PyObject* PointsFree(PyObject*, PyObject* arguments)
{
  return AskPoints<vtkUnsignedCharArray>(arguments, "vtkUnsignedCharArray",
    [](vtkFreespaceUnion* phi, vtkPoints* points, vtkUnsignedCharArray* free)
    { phi->ArePointsFree(points, free); });
}

PyObject* PointStates(PyObject*, PyObject* arguments)
{
  return AskPoints<vtkUnsignedCharArray>(arguments, "vtkUnsignedCharArray",
    [](vtkFreespaceUnion* phi, vtkPoints* points, vtkUnsignedCharArray* states)
    { phi->GetPointStates(points, states); });
}

/// A batch of the union over points and something for each: ask(phi, points, others, results).
template <typename Others, typename Results, typename Ask>
PyObject* AskPairs(
  PyObject* arguments, const char* othersName, const char* resultsName, const Ask& ask)
{
  PyObject *phi = nullptr, *points = nullptr, *others = nullptr, *results = nullptr;
  if (!PyArg_ParseTuple(arguments, "OOOO", &phi, &points, &others, &results))
  {
    return nullptr;
  }
  auto* asked = Wrapped<vtkFreespaceUnion>(phi, "vtkFreespaceUnion");
  auto* at = asked ? Wrapped<vtkPoints>(points, "vtkPoints") : nullptr;
  auto* with = at ? Wrapped<Others>(others, othersName) : nullptr;
  auto* answers = with ? Wrapped<Results>(results, resultsName) : nullptr;
  if (!answers || !CallUnlocked([&] { ask(asked, at, with, answers); }))
  {
    return nullptr;
  }
  return Py_NewRef(Py_None);
}

PyObject* FirstBlocked(PyObject*, PyObject* arguments)
{
  return AskPairs<vtkPoints, vtkDoubleArray>(arguments, "vtkPoints", "vtkDoubleArray",
    [](vtkFreespaceUnion* phi, vtkPoints* first, vtkPoints* last, vtkDoubleArray* fractions)
    { phi->FirstBlocked(first, last, fractions); });
}

PyObject* SpheresFree(PyObject*, PyObject* arguments)
{
  return AskPairs<vtkDoubleArray, vtkUnsignedCharArray>(arguments, "vtkDoubleArray",
    "vtkUnsignedCharArray",
    [](vtkFreespaceUnion* phi, vtkPoints* centers, vtkDoubleArray* radii,
      vtkUnsignedCharArray* free) { phi->AreSpheresFree(centers, radii, free); });
}

PyMethodDef Methods[] = { { "update", Update, METH_VARARGS, "update(algorithm_or_union, port)" },
  { "write", Write, METH_O, "write(writer) -> int" },
  { "points_free", PointsFree, METH_VARARGS, "points_free(phi, points, results)" },
  { "point_states", PointStates, METH_VARARGS, "point_states(phi, points, results)" },
  { "first_blocked", FirstBlocked, METH_VARARGS, "first_blocked(phi, first, last, results)" },
  { "spheres_free", SpheresFree, METH_VARARGS, "spheres_free(phi, centers, radii, results)" },
  { nullptr, nullptr, 0, nullptr } };

PyModuleDef Module = { PyModuleDef_HEAD_INIT, "_unlocked",
  "Calls that take long, without Python's lock.", -1, Methods, nullptr, nullptr, nullptr, nullptr };

}

PyMODINIT_FUNC PyInit__unlocked()
{
  return PyModule_Create(&Module);
}
