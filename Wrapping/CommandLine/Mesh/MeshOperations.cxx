// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/MeshOperations.h"

#include "Mesh/MeshFilters.h"
#include "Mesh/MeshValues.h"
#include "Session/NumberValidators.h"
#include "Session/Session.h"

#include <vtkPolyData.h>

#include <map>

namespace freespace
{

namespace
{

using Function = vtkSmartPointer<vtkPolyData> (*)(Session&, const std::string&, vtkPolyData*);

struct OperationKind
{
  const char* name;
  const char* type; ///< of the value; empty: none
  const char* help;
  std::string (*fault)(const std::string& value);
  Function function;
};

// The numbers' ranges are those of VTK's filters.
const std::vector<OperationKind>& Kinds()
{
  static const std::vector<OperationKind> kinds = { { "crop", "x0,x1,y0,y1,z0,z1", "Crop to a box",
                                                      BoxFault, Crop },
    { "largest", "N", "Keep the N connected components with the most triangles", CountFault,
      KeepLargest },
    { "crumbs", "AREA", "Drop connected components of less area", NumberFault, DropCrumbs },
    { "smooth", "LENGTH",
      "Smooth: no vertex moves farther than a length, edges of 45 degrees and borders stay",
      NumberFault, Smooth },
    { "simplify", "LENGTH",
      "Decimate: no point of one surface is farther from the other than a length", NumberFault,
      Simplify },
    { "triangles", "N", "Decimate to about N triangles, by quadrics", CountFault, Decimate },
    { "fill", "SIZE", "Fill holes whose circumscribed sphere has at most this radius", NumberFault,
      Fill },
    { "transform", "FILE", "Transform by the 4 x 4 matrix in a text file, row by row", AnyFault,
      Transform },
    { "scale", "FACTOR", "Multiply the coordinates by a factor", NumberFault, Scale },
    { "shift", "x,y,z", "Add a vector to the coordinates", VectorFault, Shift },
    { "normals", "", "Orient the triangles alike and add the points' normals (to .ply .obj .vtp)",
      AnyFault, AddNormals },
    { "colour-from", "SCENE.json", "Colour the points from a scene's images (to .ply .vtp)",
      AnyFault, ColorFromScene } };
  return kinds;
}

const OperationKind& OperationKindOf(const MeshOperation& operation)
{
  for (const OperationKind& kind : Kinds())
  {
    if (kind.name == operation.name)
    {
      return kind;
    }
  }
  throw std::logic_error("no operation " + operation.name);
}

}

void AddMeshOperations(CLI::App& command)
{
  for (const OperationKind& kind : Kinds())
  {
    const std::string names = std::string("--") + kind.name +
      (kind.name == std::string("colour-from") ? ",--color-from" : "");
    CLI::Option* option = nullptr;
    if (*kind.type)
    {
      // Read in OperationsInOrder, from what CLI11 keeps of each.
      option = command.add_option_function<std::vector<std::string>>(
        names, [](const std::vector<std::string>&) {}, kind.help);
      option->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->check(CLI::Validator(
          [fault = kind.fault](const std::string& value) { return fault(value); }, ""))
        ->type_name(kind.type);
    }
    else
    {
      option = command.add_flag(names, kind.help);
    }
    // A file of options would not keep the order.
    option->group("Operations, in the order of the command line")->configurable(false);
  }
}

std::vector<MeshOperation> OperationsInOrder(const CLI::App& command)
{
  std::vector<MeshOperation> operations;
  std::map<const CLI::Option*, std::size_t> seen;
  for (const CLI::Option* option : command.parse_order())
  {
    for (const OperationKind& kind : Kinds())
    {
      if (option->check_lname(kind.name))
      {
        const std::size_t place = seen[option]++;
        operations.push_back({ kind.name, *kind.type ? option->results().at(place) : "" });
      }
    }
  }
  return operations;
}

void CheckOperation(const MeshOperation& operation)
{
  if (operation.name == "transform")
  {
    ReadMatrix(operation.value);
  }
}

vtkSmartPointer<vtkPolyData> Operate(
  Session& session, const MeshOperation& operation, vtkPolyData* surface)
{
  return OperationKindOf(operation).function(session, operation.value, surface);
}

}
