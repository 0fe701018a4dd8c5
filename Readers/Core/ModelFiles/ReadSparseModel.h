// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ReadSparseModel_h
#define freespace_ReadSparseModel_h

#include "SparseModel/SparseModel.h"

namespace freespace
{

enum class ModelKind
{
  None,
  Colmap,
  Bundler,
  Nvm,
  Transforms,
  OpenMvg,
  AliceVision,
  Metashape,
  Middlebury
};

/// Where a path leads to.
struct ModelSource
{
  ModelKind kind = ModelKind::None;
  std::string path; ///< COLMAP's folder, or the file
  std::string told; ///< a sentence where that is not the path that was given, or empty
};

/// Finds the structure-from-motion model that a path means, by names and the beginning of files:
///
/// - a file of COLMAP's cameras, images or points: its folder;
/// - a .nvm (VisualSFM), .out (Bundler), .sfm (AliceVision), _par.txt (Middlebury), a .json of nerfstudio,
///   instant-ngp or OpenMVG, a .xml of Metashape;
/// - a folder with COLMAP's files, or with one of these files: bundle.out, transforms.json, sfm_data.json
///   and cameras.xml, else the only one;
/// - the largest COLMAP model below a folder (FindSparseModel), unless it has a scene.json.
ModelSource FindModel(const std::string& path);

/// Whether there is such a model.
bool IsSparseModel(const std::string& path);

/// Reads the model that a path means. Throws Error naming the file and the fault; where it is of a kind that
/// is known but not read, the kind and what to convert it with.
SparseModel ReadSparseModel(const std::string& path);

}

#endif
