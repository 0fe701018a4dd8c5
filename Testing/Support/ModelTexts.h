// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ModelTexts_h
#define freespace_ModelTexts_h

#include "Support/SyntheticModel.h"

#include <array>
#include <sstream>

namespace freespace
{

// A model as other programs write it, after their documentation. All images have its only camera.

/// Takes away what OpenMVG, AliceVision and Metashape have no coefficients for.
inline void MakeExpressible(SparseModel& model)
{
  std::vector<double>& p = model.cameras[0].parameters;
  switch (model.cameras[0].model)
  {
    case LensModel::FullOpenCV: // no k4 k5 k6, one focal length
      p[1] = p[0];
      p[9] = p[10] = p[11] = 0;
      break;
    case LensModel::OpenCVFisheye:
    case LensModel::FieldOfView:
      p[1] = p[0];
      break;
    case LensModel::ThinPrismFisheye:
      p[10] = p[11] = 0;
      break;
    default:
      break;
  }
  const SparseTracks tracks(model);
  for (std::size_t i = 0; i < model.points.size(); ++i)
  {
    for (const SparseLink& link : tracks.ofPoint[i])
    {
      model.images[link.image].observations[link.observation].pixel =
        ShowPoint(model, static_cast<std::size_t>(link.image), model.points[i].position);
    }
  }
}

inline std::ostringstream TextStream()
{
  std::ostringstream text;
  text.precision(17);
  return text;
}

inline std::string WorldFromCameraRows(const Camera& camera, const Eigen::Vector3d& axes,
  const char* begin, const char* between, const char* end)
{
  std::ostringstream text = TextStream();
  const Eigen::Matrix3d R = camera.R.transpose() * axes.asDiagonal();
  for (int i = 0; i < 3; ++i)
  {
    text << begin << R(i, 0) << between << R(i, 1) << between << R(i, 2) << between
         << camera.Center()[i] << end;
  }
  return text.str();
}

/// nerfstudio's; the lens is in the file, or in each frame.
inline std::string TransformsText(const SparseModel& model, bool isCommon)
{
  const SparseCamera& camera = model.cameras[0];
  const CalibratedImage first = CalibratedImages(model)[0];
  const bool isFisheye = first.lens == LensKind::Fisheye;
  std::vector<double> d = first.distortion;
  d.resize(5, 0.0);
  std::ostringstream lens = TextStream();
  lens << "\"camera_model\": " << (isFisheye ? "\"OPENCV_FISHEYE\"" : "\"OPENCV\"")
       << ", \"w\": " << camera.width << ", \"h\": " << camera.height
       << ", \"fl_x\": " << first.camera.K(0, 0) << ", \"fl_y\": " << first.camera.K(1, 1)
       << ", \"cx\": " << first.camera.K(0, 2) << ", \"cy\": " << first.camera.K(1, 2)
       << ", \"k1\": " << d[0] << ", \"k2\": " << d[1] << ", \"" << (isFisheye ? "k3" : "p1")
       << "\": " << d[2] << ", \"" << (isFisheye ? "k4" : "p2") << "\": " << d[3];
  std::ostringstream text = TextStream();
  text << "{" << (isCommon ? lens.str() + ", " : "")
       << "\"ply_file_path\": \"a.ply\", \"frames\": [";
  const std::vector<CalibratedImage> images = CalibratedImages(model);
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    text << (i ? ",\n" : "\n") << "{\"file_path\": \"./" << images[i].file << "\", "
         << (isCommon ? "" : lens.str() + ", ") << "\"transform_matrix\": ["
         << WorldFromCameraRows(images[i].camera, { 1, -1, -1 }, "[", ",", "],") << "[0,0,0,1]]}";
  }
  return text.str() + "]}";
}

/// The name of a lens in OpenMVG's file, and its coefficients.
inline std::pair<std::string, std::string> OpenMvgLens(const SparseModel& model)
{
  const LensModel lens = model.cameras[0].model;
  std::vector<double> d = CalibratedImages(model)[0].distortion;
  const bool hasTangents = d.size() > 4;
  d.resize(8, 0.0);
  std::ostringstream text = TextStream();
  if (lens == LensModel::OpenCVFisheye)
  {
    text << ", \"fisheye\": [" << d[0] << "," << d[1] << "," << d[2] << "," << d[3] << "]";
    return { "fisheye", text.str() };
  }
  if (hasTangents)
  {
    text << ", \"disto_t2\": [" << d[0] << "," << d[1] << "," << d[4] << "," << d[2] << "," << d[3]
         << "]";
    return { "pinhole_brown_t2", text.str() };
  }
  if (lens == LensModel::SimpleRadial)
  {
    text << ", \"disto_k1\": [" << d[0] << "]";
    return { "pinhole_radial_k1", text.str() };
  }
  if (lens == LensModel::Radial)
  {
    text << ", \"disto_k3\": [" << d[0] << "," << d[1] << ",0]";
    return { "pinhole_radial_k3", text.str() };
  }
  return { "pinhole", "" };
}

inline std::string OpenMvgStructure(const SparseModel& model)
{
  const SparseTracks tracks(model);
  std::ostringstream text = TextStream();
  for (std::size_t i = 0; i < model.points.size(); ++i)
  {
    const Eigen::Vector3d& x = model.points[i].position;
    text << (i ? ",\n" : "\n") << "{\"key\": " << i << ", \"value\": {\"X\": [" << x[0] << ","
         << x[1] << "," << x[2] << "], \"observations\": [";
    const char* comma = "";
    for (const SparseLink& link : tracks.ofPoint[i])
    {
      const Eigen::Vector2d& p = model.images[link.image].observations[link.observation].pixel;
      text << comma << "{\"key\": " << 10 + link.image << ", \"value\": {\"id_feat\": 0, \"x\": ["
           << p.x() << "," << p.y() << "]}}";
      comma = ",";
    }
    text << "]}}";
  }
  return text.str();
}

/// OpenMVG's, through the cereal library. A view has no pose.
inline std::string OpenMvgText(const SparseModel& model)
{
  const std::vector<CalibratedImage> images = CalibratedImages(model);
  const Eigen::Matrix3d& K = images[0].camera.K;
  std::ostringstream text = TextStream();
  text << "{\"sfm_data_version\": \"0.3\", \"root_path\": \"\", \"views\": [";
  for (std::size_t i = 0; i <= images.size(); ++i)
  {
    const bool isLost = i == images.size();
    text << (i ? ",\n" : "\n") << "{\"key\": " << 10 + i << ", \"value\": {\"polymorphic_id\": "
         << "1073741824, \"ptr_wrapper\": {\"id\": " << 2147483649u + i
         << ", \"data\": {\"local_path\": \"/\", \"filename\": \""
         << (isLost ? "lost.jpg" : images[i].file)
         << "\", \"width\": 800, \"height\": 600, \"id_view\": " << 10 + i
         << ", \"id_intrinsic\": 3, \"id_pose\": " << (isLost ? 4294967295u : 20 + i) << "}}}}";
  }
  const auto [kind, lens] = OpenMvgLens(model);
  text << "], \"intrinsics\": [{\"key\": 3, \"value\": {\"polymorphic_id\": 2147483649, "
       << "\"polymorphic_name\": \"" << kind
       << "\", \"ptr_wrapper\": {\"id\": 2147483700, \"data\": "
       << "{\"width\": 800, \"height\": 600, \"focal_length\": " << K(0, 0)
       << ", \"principal_point\": [" << K(0, 2) << "," << K(1, 2) << "]" << lens
       << "}}}}], \"extrinsics\": [";
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    const Eigen::Matrix3d& R = images[i].camera.R;
    const Eigen::Vector3d c = images[i].camera.Center();
    text << (i ? ",\n" : "\n") << "{\"key\": " << 20 + i << ", \"value\": {\"rotation\": [["
         << R(0, 0) << "," << R(0, 1) << "," << R(0, 2) << "],[" << R(1, 0) << "," << R(1, 1) << ","
         << R(1, 2) << "],[" << R(2, 0) << "," << R(2, 1) << "," << R(2, 2) << "]], \"center\": ["
         << c[0] << "," << c[1] << "," << c[2] << "]}}";
  }
  return text.str() + "], \"structure\": [" + OpenMvgStructure(model) +
    "], \"control_points\": []}";
}

template <typename Matrix>
std::string QuotedNumbers(const Matrix& matrix)
{
  std::ostringstream text = TextStream();
  for (Eigen::Index i = 0; i < matrix.size(); ++i)
  {
    text << (i ? "," : "") << "\"" << matrix(i) << "\""; // column by column, as Eigen has them
  }
  return "[" + text.str() + "]";
}

/// The lens of AliceVision's file of a version.
inline std::string AliceVisionLens(const SparseModel& model, const std::array<int, 3>& version)
{
  const CalibratedImage first = CalibratedImages(model)[0];
  const Eigen::Matrix3d& K = first.camera.K;
  std::vector<double> d = first.distortion;
  const bool hasTangents = d.size() > 4;
  const bool isNone = d.empty();
  d.resize(8, 0.0);
  std::ostringstream text = TextStream();
  std::string kind = "radial3", name = "radialk3";
  Eigen::VectorXd parameters = Eigen::Vector3d(d[0], d[1], 0);
  if (first.lens == LensKind::Fisheye)
  {
    kind = "fisheye4";
    name = "fisheye";
    parameters = Eigen::Vector4d(d[0], d[1], d[2], d[3]);
  }
  else if (first.lens == LensKind::FieldOfView)
  {
    kind = name = "fisheye1";
    parameters = Eigen::VectorXd::Constant(1, d[0]);
  }
  else if (hasTangents)
  {
    kind = name = "brown";
    parameters.resize(5);
    parameters << d[0], d[1], d[4], d[2], d[3];
  }
  else if (isNone)
  {
    kind = "pinhole";
    name = "none";
    parameters.resize(0);
  }
  text << "{\"intrinsicId\": \"7\", \"width\": \"800\", \"height\": \"600\", ";
  if (version >= std::array<int, 3>{ 1, 2, 7 })
  {
    text << "\"type\": \"pinhole\", \"distortionType\": \"" << name << "\", ";
  }
  else
  {
    text << "\"type\": \"" << kind << "\", ";
  }
  if (version < std::array<int, 3>{ 1, 2, 0 })
  {
    text << "\"pxFocalLength\": \"" << K(0, 0) << "\", ";
  }
  else if (version < std::array<int, 3>{ 1, 2, 2 })
  {
    text << "\"pxFocalLength\": [\"" << K(0, 0) << "\",\"" << K(1, 1) << "\"], ";
  }
  else
  {
    const double ratio =
      version < std::array<int, 3>{ 1, 2, 5 } ? K(0, 0) / K(1, 1) : K(1, 1) / K(0, 0);
    text << "\"sensorWidth\": \"32\", \"focalLength\": \"" << K(0, 0) * 32 / 800
         << "\", \"pixelRatio\": \"" << ratio << "\", ";
  }
  const bool isOffset = version >= std::array<int, 3>{ 1, 2, 1 };
  text << "\"principalPoint\": [\"" << K(0, 2) - (isOffset ? 400 : 0) << "\",\""
       << K(1, 2) - (isOffset ? 300 : 0)
       << "\"], \"distortionParams\": " << (parameters.size() ? QuotedNumbers(parameters) : "\"\"")
       << "}";
  return text.str();
}

/// The images as those that one rig has taken at a time; one more camera of it is not placed.
inline std::string AliceVisionRig(const std::vector<CalibratedImage>& images,
  const Eigen::Matrix3d& R, const Eigen::Vector3d& center)
{
  std::ostringstream text = TextStream();
  text << "\"rigs\": [{\"rigId\": \"3\", \"subPoses\": [";
  for (const CalibratedImage& image : images)
  {
    text << "{\"status\": \"estimated\", \"pose\": {\"rotation\": "
         << QuotedNumbers(Eigen::Matrix3d(image.camera.R * R.transpose()))
         << ", \"center\": " << QuotedNumbers(Eigen::Vector3d(R * (image.camera.Center() - center)))
         << "}},\n";
  }
  return text.str() + "{\"status\": \"uninitialized\"}]}], ";
}

inline std::string AliceVisionText(
  const SparseModel& model, const std::array<int, 3>& version, bool isRig = false)
{
  const Eigen::Matrix3d rigR =
    Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, -2, 0.5).normalized()).matrix();
  const Eigen::Vector3d rigCenter(0.3, -1.2, 2.5);
  const std::vector<CalibratedImage> images = CalibratedImages(model);
  std::ostringstream text = TextStream();
  text << "{\"version\": [\"" << version[0] << "\",\"" << version[1] << "\",\"" << version[2]
       << "\"], \"featuresFolders\": [\"f\"], \"views\": [";
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    text << (i ? ",\n" : "\n") << "{\"viewId\": \"" << 4000000000u + i << "\", \"poseId\": \""
         << (isRig ? 50 : i) << "\", \"rigId\": \"3\", \"subPoseId\": \"" << i
         << (isRig ? "\", \"isPoseIndependant\": \"false" : "")
         << "\", \"intrinsicId\": \"7\", \"path\": \"/no/such/folder/" << images[i].file << "\"}";
  }
  if (isRig)
  {
    text << ",{\"viewId\": \"6\", \"poseId\": \"50\", \"intrinsicId\": \"7\", \"rigId\": \"3\", "
            "\"subPoseId\": \""
         << images.size()
         << "\", \"isPoseIndependant\": \"false\", \"path\": \"/no/such/folder/unplaced.jpg\"}";
  }
  text << ",{\"viewId\": \"5\", \"poseId\": \"99\", \"intrinsicId\": \"7\", \"path\": "
          "\"/no/such/folder/lost.jpg\"}], \"intrinsics\": ["
       << AliceVisionLens(model, version) << "], "
       << (isRig ? AliceVisionRig(images, rigR, rigCenter) : "") << "\"poses\": [";
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    text << (i ? ",\n" : "\n") << "{\"poseId\": \"" << i
         << "\", \"pose\": {\"transform\": {\"rotation\": " << QuotedNumbers(images[i].camera.R)
         << ", \"center\": " << QuotedNumbers(images[i].camera.Center())
         << "}, \"locked\": \"0\"}}";
  }
  text << ",{\"poseId\": \"50\", \"pose\": {\"transform\": {\"rotation\": " << QuotedNumbers(rigR)
       << ", \"center\": " << QuotedNumbers(rigCenter) << "}}}";
  text << "], \"structure\": [";
  const SparseTracks tracks(model);
  for (std::size_t i = 0; i < model.points.size(); ++i)
  {
    text << (i ? ",\n" : "\n") << "{\"landmarkId\": \"" << i
         << "\", \"descType\": \"sift\", \"color\": "
         << "[\"1\",\"2\",\"255\"], \"X\": " << QuotedNumbers(model.points[i].position)
         << ", \"observations\": [";
    const char* comma = "";
    for (const SparseLink& link : tracks.ofPoint[i])
    {
      text << comma << "{\"observationId\": \"" << 4000000000u + link.image
           << "\", \"featureId\": \"1\", "
           << "\"x\": "
           << QuotedNumbers(model.images[link.image].observations[link.observation].pixel) << "}";
      comma = ",";
    }
    text << "]}";
  }
  return text.str() + "]}";
}

/// Metashape's export of cameras.
inline std::string MetashapeText(const SparseModel& model)
{
  const SparseCamera& camera = model.cameras[0];
  const std::vector<CalibratedImage> images = CalibratedImages(model);
  const Eigen::Matrix3d& K = images[0].camera.K;
  const bool isFisheye = images[0].lens == LensKind::ThinPrismFisheye;
  std::vector<double> d = images[0].distortion;
  d.resize(8, 0.0);
  std::ostringstream text = TextStream();
  text << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<document version=\"1.5.0\">\n"
       << "<chunk label=\"Chunk 1\" enabled=\"true\"><sensors next_id=\"1\">\n"
       << "<sensor id=\"0\" label=\"unknown\" type=\"" << (isFisheye ? "fisheye" : "frame")
       << "\">\n"
       << "<resolution width=\"" << camera.width << "\" height=\"" << camera.height << "\"/>\n"
       << "<calibration type=\"frame\" class=\"initial\"><f>1</f></calibration>\n"
       << "<calibration type=\"frame\" class=\"adjusted\"><f>" << K(1, 1) << "</f><b1>"
       << K(0, 0) - K(1, 1) << "</b1><cx>" << K(0, 2) - static_cast<double>(camera.width) / 2
       << "</cx><cy>" << K(1, 2) - static_cast<double>(camera.height) / 2 << "</cy><k1>" << d[0]
       << "</k1><k2>" << d[1] << "</k2><k3>" << d[4] << "</k3>";
  if (isFisheye)
  {
    text << "<k4>" << d[5] << "</k4>";
  }
  text << "<p1>" << d[3] << "</p1><p2>" << d[2] << "</p2></calibration></sensor></sensors>\n"
       << "<components><component id=\"0\"/></components><cameras next_id=\"9\">\n";
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    text << "<camera id=\"" << i << "\" sensor_id=\"0\" component_id=\"0\" label=\""
         << images[i].file << "\"><transform>"
         << WorldFromCameraRows(images[i].camera, { 1, 1, 1 }, "", " ", " ")
         << "0 0 0 1</transform></camera>\n";
  }
  return text.str() +
    "<camera id=\"8\" sensor_id=\"0\" label=\"lost.jpg\"/>\n"
    "</cameras><transform><scale>3</scale></transform></chunk></document>\n";
}

inline std::string MiddleburyText(const SparseModel& model)
{
  std::ostringstream text = TextStream();
  text << model.images.size() << "\n";
  for (const CalibratedImage& image : CalibratedImages(model))
  {
    text << image.file;
    for (const Eigen::Matrix3d& matrix : { image.camera.K, image.camera.R })
    {
      for (int i = 0; i < 9; ++i)
      {
        text << " " << matrix(i / 3, i % 3);
      }
    }
    text << " " << image.camera.t.transpose() << "\n";
  }
  return text.str();
}

}

#endif
