// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_FileInfo_h
#define freespace_FileInfo_h

#include <nlohmann/json_fwd.hpp>

#include <string>

class vtkMultiBlockDataSet;
class vtkPolyData;

namespace freespace
{

class Session;

/// The content of a file that the program can read: a surface, features or disparity maps, a scene, a camera model, an
/// image. Each value is a number, a word, a list of these, or such an object. Throws Error naming the file when
/// it cannot be read.
nlohmann::ordered_json InfoOf(Session& session, const std::string& fileName);

///@{
/// The same of what was read.
nlohmann::ordered_json SurfaceInfo(vtkPolyData* surface);
nlohmann::ordered_json ViewsInfo(vtkMultiBlockDataSet* views);
nlohmann::ordered_json ModelInfo(const std::string& path);
nlohmann::ordered_json SceneInfo(const std::string& path);
///@}

/// The same as readable lines: long lists are truncated, lists of objects become tables.
std::string InfoText(const nlohmann::ordered_json& info);

}

#endif
