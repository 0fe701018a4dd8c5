// SPDX-License-Identifier: BSD-3-Clause
#include "Data/SurfaceViewpoint.h"

#include "Common/Error.h"
#include "Common/ParseNumber.h"
#include "Data/ViewBlocks.h"

#include <vtkFieldData.h>
#include <vtkPolyData.h>

#include <iomanip>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <type_traits>

namespace freespace
{

namespace
{

const char* const keyword = "freespace-viewpoint"; // then K and [R t] row by row, width and height

bool IsCamera(const Camera& camera)
{
  return camera.K.allFinite() && camera.K(0, 0) > 0 && camera.K(1, 1) > 0 && camera.t.allFinite() &&
    camera.R.isUnitary(1e-6) && camera.width > 0 && camera.height > 0;
}

}

std::optional<Camera> ViewpointOf(vtkPolyData* surface)
{
  if (!surface->GetFieldData()->HasArray("CameraFromWorld"))
  {
    return {};
  }
  try
  {
    const Camera camera = CameraFromBlock(surface, "of the surface");
    return IsCamera(camera) ? std::optional<Camera>(camera) : std::nullopt;
  }
  catch (const Error&)
  {
    return {};
  }
}

std::string ViewpointComment(vtkPolyData* surface)
{
  const std::optional<Camera> camera = ViewpointOf(surface);
  if (!camera)
  {
    return "";
  }
  const Eigen::IOFormat oneLine(Eigen::FullPrecision, Eigen::DontAlignCols, " ", " ");
  std::ostringstream comment;
  comment << std::setprecision(std::numeric_limits<double>::max_digits10) << keyword << " "
          << camera->K.format(oneLine) << " "
          << (Eigen::Matrix<double, 3, 4>() << camera->R, camera->t).finished().format(oneLine)
          << " " << camera->width << " " << camera->height;
  return comment.str();
}

std::optional<Camera> ViewpointFromComment(const std::string& comment)
{
  std::istringstream words(comment);
  std::string word;
  bool valid = words >> word && word == keyword;
  const auto read = [&](auto& value)
  {
    const auto number =
      words >> word ? ParseNumber<std::remove_reference_t<decltype(value)>>(word) : std::nullopt;
    valid = valid && number;
    value = number.value_or(0);
  };
  Camera camera;
  for (int i = 0; i < 9; ++i)
  {
    read(camera.K(i / 3, i % 3));
  }
  for (int i = 0; i < 12; ++i)
  {
    read(i % 4 < 3 ? camera.R(i / 4, i % 4) : camera.t(i / 4));
  }
  read(camera.width);
  read(camera.height);
  return valid && IsCamera(camera) ? std::optional<Camera>(camera) : std::nullopt;
}

}
