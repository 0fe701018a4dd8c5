// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_MeshOperations_h
#define freespace_MeshOperations_h

#include <vtkSmartPointer.h>

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

class vtkPolyData;

namespace freespace
{

class Session;

/// An operation on a surface: the name of an option, without dashes, and its value.
struct MeshOperation
{
  std::string name;
  std::string value;

  /// As on the command line.
  std::string Text() const { return "--" + this->name + (value.empty() ? "" : " " + value); }
};

/// The operations as options of a command, each of which may be repeated.
void AddMeshOperations(CLI::App& command);

/// Those that were given, in their order.
std::vector<MeshOperation> OperationsInOrder(const CLI::App& command);

/// The surface after an operation. Throws Error when it fails.
vtkSmartPointer<vtkPolyData> Operate(
  Session& session, const MeshOperation& operation, vtkPolyData* surface);

/// Throws Error naming the file of a --transform that is no matrix: before the work.
void CheckOperation(const MeshOperation& operation);

}

#endif
