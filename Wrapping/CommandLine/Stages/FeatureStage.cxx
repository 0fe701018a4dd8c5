// SPDX-License-Identifier: BSD-3-Clause
#include "Stages/FeatureStage.h"

#include "Common/Error.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkSparseModelReader.h>

namespace freespace
{

void FeatureStage::AddOptions(CLI::App& command)
{
  this->Stereo.AddOptions(command);
  this->Sparse.AddOptions(command);
  this->Densify.AddOptions(command);
}

bool FeatureStage::IsModel(const std::string& source)
{
  return vtkSparseModelReader::CanReadFile(source);
}

vtkSmartPointer<vtkMultiBlockDataSet> FeatureStage::Run(
  Session& session, const std::string& source) const
{
  if (!IsModel(source))
  {
    if (this->Densify.IsWanted())
    {
      throw Error("--densify is for a structure-from-motion model, and " + source +
        " is none: the features of a scene.json come from its images anyway.");
    }
    return this->Stereo.Run(session, source);
  }
  if (this->Stereo.NeedsMasks())
  {
    throw Error("--mask-is-free is for a scene.json that names masks, and " + source +
      " is a structure-from-motion model.");
  }
  const auto points = this->Sparse.Run(session, source);
  return this->Densify.IsWanted() ? this->Densify.Run(session, source, points, this->Stereo)
                                  : points;
}

}
