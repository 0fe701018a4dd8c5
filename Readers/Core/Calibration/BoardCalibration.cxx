// SPDX-License-Identifier: BSD-3-Clause
#include "Calibration/BoardCalibration.h"

#include "Common/AtomicOutput.h"
#include "Common/Error.h"
#include "Text/WholeFile.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <sstream>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>

namespace freespace
{

namespace fs = std::filesystem;

namespace
{

cv::Mat ReadGray(const std::string& file)
{
  cv::Mat gray;
  if (fs::is_regular_file(file))
  {
    CheckWholeJPEG(file);
    try
    {
      gray = cv::imread(file, cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION);
    }
    catch (const cv::Exception&)
    {
      gray.release(); // told below
    }
  }
  if (gray.empty())
  {
    throw Error("Cannot read the picture " + file + ": it is missing or not a picture.");
  }
  return gray;
}

// Runs a body that may throw over all indices and throws what the first of them threw.
void ForEach(
  std::size_t count, const ParallelFor& parallelFor, const std::function<void(std::size_t)>& body)
{
  std::vector<std::exception_ptr> errors(count);
  parallelFor(count,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        try
        {
          body(i);
        }
        catch (...)
        {
          errors[i] = std::current_exception();
        }
      }
    });
  for (const std::exception_ptr& error : errors)
  {
    if (error)
    {
      std::rethrow_exception(error);
    }
  }
}

// Without the zeros at the end.
std::size_t CountCoefficients(const std::vector<double>& distortion)
{
  std::size_t count = distortion.size();
  while (count > 0 && distortion[count - 1] == 0)
  {
    --count;
  }
  return count;
}

// The pictures of one camera, and what calibrates it. Pixels in here are OpenCV's.
class CameraCalibration
{
public:
  CameraCalibration(std::vector<BoardPicture*> pictures, const BoardCalibrationOptions& options,
    const ParallelFor& parallelFor)
    : Pictures(std::move(pictures))
    , Options(options)
    , Points(BoardPoints(options.board))
    , For(parallelFor)
    , Size(this->Pictures.front()->image.camera.width, this->Pictures.front()->image.camera.height)
  {
  }

  void Run()
  {
    // A first camera from what the detector found, then all corners that it leads to.
    this->DropOutliers(std::min(this->Options.maximumCoefficients, 2));
    for (int round = 0; round < 2; ++round)
    {
      this->FindCorners();
      this->DropOutliers(this->Options.maximumCoefficients);
    }
    this->Store(this->BestFit());
  }

private:
  struct Fit
  {
    cv::Matx33d matrix;
    std::vector<double> distortion;
    std::vector<cv::Mat> rotations, translations;
    std::vector<std::vector<double>> errors; // per picture and corner, pixels
    double squares = 0;                      // sum of the errors' squares
    std::size_t corners = 0;
    int parameters = 0;
  };

  // A start that needs no view of the board in particular: of a lens of 40 degrees.
  cv::Mat FirstGuess() const
  {
    const double focal = 1.4 * std::max(this->Size.width, this->Size.height);
    return (cv::Mat_<double>(3, 3) << focal, 0, (this->Size.width - 1) / 2.0, 0, focal,
      (this->Size.height - 1) / 2.0, 0, 0, 1);
  }

  static int Flags(int coefficients, bool squarePixels)
  {
    int flags = cv::CALIB_USE_INTRINSIC_GUESS;
    flags |= squarePixels ? cv::CALIB_FIX_ASPECT_RATIO : 0;
    flags |= coefficients < 1 ? cv::CALIB_FIX_K1 : 0;
    flags |= coefficients < 2 ? cv::CALIB_FIX_K2 : 0;
    flags |= coefficients < 4 ? cv::CALIB_ZERO_TANGENT_DIST : 0;
    flags |= coefficients < 5 ? cv::CALIB_FIX_K3 : 0;
    return flags;
  }

  Fit Calibrate(int coefficients) const
  {
    std::vector<std::vector<cv::Point3f>> world;
    std::vector<std::vector<cv::Point2f>> seen;
    for (const BoardPicture* picture : this->Pictures)
    {
      auto& worldPoints = world.emplace_back();
      auto& pixels = seen.emplace_back();
      for (std::size_t i = 0; i < picture->corners.ids.size(); ++i)
      {
        const Eigen::Vector3f point =
          this->Points[static_cast<std::size_t>(picture->corners.ids[i])].cast<float>();
        const Eigen::Vector2d& pixel = picture->corners.pixels[i];
        worldPoints.emplace_back(point.x(), point.y(), point.z());
        pixels.emplace_back(
          static_cast<float>(pixel.x() - 0.5), static_cast<float>(pixel.y() - 0.5));
      }
    }
    Fit fit;
    cv::Mat matrix = this->FirstGuess();
    cv::Mat distortion = cv::Mat::zeros(1, 5, CV_64F);
    try
    {
      cv::calibrateCamera(world, seen, this->Size, matrix, distortion, fit.rotations,
        fit.translations, Flags(coefficients, this->Options.squarePixels),
        cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 200, 1e-12));
    }
    catch (const cv::Exception& error)
    {
      throw Error(
        "Cannot calibrate: the pictures of the board are degenerate (" + error.err + ").");
    }
    fit.matrix = cv::Matx33d(matrix);
    if (!cv::checkRange(matrix) || !cv::checkRange(distortion) || !(fit.matrix(0, 0) > 0))
    {
      throw Error("Cannot calibrate: the pictures show the board from too few directions.");
    }
    fit.distortion.assign(distortion.ptr<double>(), distortion.ptr<double>() + 5);
    fit.parameters = (this->Options.squarePixels ? 3 : 4) + coefficients;
    Measure(world, seen, fit);
    return fit;
  }

  static void Measure(const std::vector<std::vector<cv::Point3f>>& world,
    const std::vector<std::vector<cv::Point2f>>& seen, Fit& fit)
  {
    for (std::size_t i = 0; i < world.size(); ++i)
    {
      std::vector<cv::Point2f> projected;
      cv::projectPoints(
        world[i], fit.rotations[i], fit.translations[i], fit.matrix, fit.distortion, projected);
      auto& errors = fit.errors.emplace_back();
      for (std::size_t k = 0; k < projected.size(); ++k)
      {
        errors.push_back(cv::norm(projected[k] - seen[i][k]));
        fit.squares += errors.back() * errors.back();
      }
      fit.corners += errors.size();
    }
  }

  // The median of a Rayleigh distribution is 1.177 standard deviations.
  static double Deviation(const Fit& fit)
  {
    std::vector<double> all;
    for (const auto& errors : fit.errors)
    {
      all.insert(all.end(), errors.begin(), errors.end());
    }
    std::nth_element(
      all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
    return all[all.size() / 2] / 1.177;
  }

  // Calibrates and drops what does not fit until all does.
  void DropOutliers(int coefficients)
  {
    for (int round = 0; round < 20; ++round)
    {
      this->DropPictures();
      const Fit fit = this->Calibrate(coefficients);
      // Below a hundredth of a pixel nothing is an outlier.
      const double limit = this->Options.outlierThreshold * std::max(Deviation(fit), 0.01);
      std::size_t dropped = 0;
      for (std::size_t i = 0; i < this->Pictures.size(); ++i)
      {
        dropped += Keep(this->Pictures[i]->corners, fit.errors[i], limit);
      }
      this->Store(fit);
      if (dropped == 0)
      {
        return;
      }
    }
  }

  static std::size_t Keep(BoardCorners& corners, const std::vector<double>& errors, double limit)
  {
    BoardCorners kept;
    for (std::size_t k = 0; k < errors.size(); ++k)
    {
      if (errors[k] <= limit)
      {
        kept.ids.push_back(corners.ids[k]);
        kept.pixels.push_back(corners.pixels[k]);
      }
    }
    const std::size_t dropped = errors.size() - kept.ids.size();
    corners = std::move(kept);
    return dropped;
  }

  // Those in which too few corners are left.
  void DropPictures()
  {
    const auto isPoor = [&](BoardPicture* picture)
    {
      if (static_cast<int>(picture->corners.ids.size()) >= this->Options.minimumCorners &&
        !this->AreCollinear(picture->corners))
      {
        return false;
      }
      picture->used = false;
      picture->reason = "only " + std::to_string(picture->corners.ids.size()) +
        " corners of the board were found, or all in one line";
      return true;
    };
    this->Pictures.erase(
      std::remove_if(this->Pictures.begin(), this->Pictures.end(), isPoor), this->Pictures.end());
    if (this->Pictures.size() < 3)
    {
      throw Error("Cannot calibrate: the board was found in fewer than three pictures of " +
        std::to_string(this->Size.width) + " x " + std::to_string(this->Size.height) + " pixels.");
    }
  }

  bool AreCollinear(const BoardCorners& corners) const
  {
    Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
    const Eigen::Vector3d& first = this->Points[static_cast<std::size_t>(corners.ids[0])];
    for (int id : corners.ids)
    {
      const Eigen::Vector2d d = (this->Points[static_cast<std::size_t>(id)] - first).head<2>();
      scatter += d * d.transpose();
    }
    return scatter.determinant() < 1e-9 * scatter.trace() * scatter.trace();
  }

  void FindCorners()
  {
    ForEach(this->Pictures.size(), this->For,
      [this](std::size_t i)
      {
        BoardPicture& picture = *this->Pictures[i];
        picture.corners =
          FindBoardCorners(ReadGray(picture.file), this->Options.board, picture.image);
      });
  }

  // As many coefficients as the corners call for.
  Fit BestFit() const
  {
    Fit best;
    double least = std::numeric_limits<double>::infinity();
    for (int coefficients : { 0, 1, 2, 4, 5 })
    {
      if (coefficients > this->Options.maximumCoefficients)
      {
        break;
      }
      Fit fit = this->Calibrate(coefficients);
      // What displaces a corner displaces its x and y: it counts as one observation, not as two.
      const double corners = static_cast<double>(fit.corners);
      const double criterion = corners * std::log(std::max(fit.squares, 1e-20) / corners) +
        fit.parameters * std::log(corners);
      if (criterion < least)
      {
        least = criterion;
        best = std::move(fit);
      }
    }
    return best;
  }

  // The fit into the pictures' cameras.
  void Store(const Fit& fit)
  {
    for (std::size_t i = 0; i < this->Pictures.size(); ++i)
    {
      BoardPicture& picture = *this->Pictures[i];
      Camera& camera = picture.image.camera;
      cv::Matx33d rotation;
      cv::Rodrigues(fit.rotations[i], rotation);
      for (int k = 0; k < 9; ++k)
      {
        camera.R(k / 3, k % 3) = rotation(k / 3, k % 3);
        camera.K(k / 3, k % 3) = fit.matrix(k / 3, k % 3);
      }
      camera.K(0, 2) += 0.5;
      camera.K(1, 2) += 0.5;
      for (int k = 0; k < 3; ++k)
      {
        camera.t[k] = fit.translations[i].at<double>(k);
      }
      picture.image.distortion = fit.distortion;
      if (CountCoefficients(fit.distortion) == 0)
      {
        picture.image.distortion.clear();
      }
      double squares = 0;
      for (double error : fit.errors[i])
      {
        squares += error * error;
      }
      picture.error = std::sqrt(squares / std::max<std::size_t>(fit.errors[i].size(), 1));
    }
  }

  std::vector<BoardPicture*> Pictures;
  const BoardCalibrationOptions& Options;
  std::vector<Eigen::Vector3d> Points;
  const ParallelFor& For;
  cv::Size Size;
};

// The simplest model that holds the coefficients.
SparseCamera LensOf(const CalibratedImage& image, std::uint32_t id)
{
  const Eigen::Matrix3d& K = image.camera.K;
  std::vector<double> d = image.distortion;
  const std::size_t coefficients = CountCoefficients(d);
  d.resize(8, 0.0);
  SparseCamera camera;
  camera.id = id;
  camera.width = static_cast<std::uint64_t>(image.camera.width);
  camera.height = static_cast<std::uint64_t>(image.camera.height);
  const bool square = K(0, 0) == K(1, 1);
  if (square && coefficients <= 2)
  {
    constexpr LensModel models[] = { LensModel::SimplePinhole, LensModel::SimpleRadial,
      LensModel::Radial };
    camera.model = models[coefficients];
    camera.parameters = { K(0, 0), K(0, 2), K(1, 2), d[0], d[1] };
  }
  else
  {
    camera.model = coefficients == 0 ? LensModel::Pinhole
      : coefficients <= 4            ? LensModel::OpenCV
                                     : LensModel::FullOpenCV;
    camera.parameters = { K(0, 0), K(1, 1), K(0, 2), K(1, 2) };
    camera.parameters.insert(camera.parameters.end(), d.begin(), d.end());
  }
  camera.parameters.resize(LensModelParameters(camera.model));
  return camera;
}

SparseImage PoseOf(const Camera& camera)
{
  SparseImage image;
  const Eigen::Quaterniond q(camera.R);
  image.rotation = { q.w(), q.x(), q.y(), q.z() };
  image.translation = camera.t;
  return image;
}

template <typename Value>
Value ParseNumber(const std::string& text, const std::string& whole)
{
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  Value value{};
  if (!(stream >> value) || stream.peek() != std::istringstream::traits_type::eof())
  {
    throw Error("'" + whole + "' describes no board: '" + text + "' is not a number.");
  }
  return value;
}

}

void BoardCalibrationOptions::Check() const
{
  this->board.Check();
  if (this->maximumCoefficients < 0 || this->maximumCoefficients > 5 ||
    this->maximumCoefficients == 3)
  {
    throw Error("The number of coefficients of distortion must be 0, 1, 2, 4 or 5.");
  }
  if (this->minimumCorners < 4 || !(this->outlierThreshold > 2))
  {
    throw Error(
      "A picture needs at least 4 corners, and the threshold of outliers must be above 2.");
  }
}

SparseModel BoardCalibration::Model(const Board& board, const std::string& folder) const
{
  SparseModel model;
  std::vector<SparsePoint> points(BoardPoints(board).size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i].id = i + 1;
    points[i].position = BoardPoints(board)[i];
  }
  std::map<std::pair<int, int>, std::uint32_t> cameras;
  for (const BoardPicture& picture : this->pictures)
  {
    if (!picture.used)
    {
      continue;
    }
    const auto next = static_cast<std::uint32_t>(cameras.size() + 1);
    const auto [camera, isNew] = cameras.emplace(
      std::make_pair(picture.image.camera.width, picture.image.camera.height), next);
    if (isNew)
    {
      model.cameras.push_back(LensOf(picture.image, next));
    }
    SparseImage image = PoseOf(picture.image.camera);
    image.id = static_cast<std::uint32_t>(model.images.size() + 1);
    image.camera = camera->second;
    image.name = fs::proximate(fs::absolute(picture.file), fs::absolute(folder)).string();
    for (std::size_t k = 0; k < picture.corners.ids.size(); ++k)
    {
      SparsePoint& point = points[static_cast<std::size_t>(picture.corners.ids[k])];
      point.track.push_back({ image.id, static_cast<std::uint32_t>(k) });
      image.observations.push_back({ picture.corners.pixels[k], point.id });
    }
    model.images.push_back(std::move(image));
  }
  for (SparsePoint& point : points)
  {
    if (!point.track.empty())
    {
      model.points.push_back(std::move(point));
    }
  }
  return model;
}

BoardCalibration CalibrateFromBoard(const std::vector<std::string>& files,
  const BoardCalibrationOptions& options, const ParallelFor& parallelFor, const Progress& progress)
{
  options.Check();
  BoardCalibration calibration;
  calibration.pictures.resize(files.size());
  ForEach(files.size(), parallelFor,
    [&](std::size_t i)
    {
      BoardPicture& picture = calibration.pictures[i];
      const cv::Mat gray = ReadGray(files[i]);
      picture.file = files[i];
      picture.image.camera.width = gray.cols;
      picture.image.camera.height = gray.rows;
      picture.corners = DetectBoard(gray, options.board);
      picture.used = !picture.corners.ids.empty();
      picture.reason = picture.used ? "" : "the board was not found";
    });
  progress(0.5);
  std::map<std::pair<int, int>, std::vector<BoardPicture*>> cameras;
  for (BoardPicture& picture : calibration.pictures)
  {
    if (picture.used)
    {
      cameras[{ picture.image.camera.width, picture.image.camera.height }].push_back(&picture);
    }
  }
  if (cameras.empty())
  {
    throw Error("Cannot calibrate: the board was found in none of " + std::to_string(files.size()) +
      " pictures.");
  }
  // Where one camera cannot be calibrated, its pictures are left out; it is an error where none can.
  std::string fault;
  std::size_t calibrated = 0;
  for (const auto& camera : cameras)
  {
    try
    {
      CameraCalibration(camera.second, options, parallelFor).Run();
      ++calibrated;
    }
    catch (const Error& error)
    {
      fault = error.what();
      for (BoardPicture* picture : camera.second)
      {
        picture->used = false;
        picture->reason =
          picture->reason.empty() ? "its camera could not be calibrated" : picture->reason;
      }
    }
  }
  if (calibrated == 0)
  {
    throw Error(fault);
  }
  double squares = 0;
  std::size_t corners = 0;
  for (const BoardPicture& picture : calibration.pictures)
  {
    const std::size_t own = picture.used ? picture.corners.ids.size() : 0;
    squares += picture.error * picture.error * static_cast<double>(own);
    corners += own;
  }
  calibration.error = std::sqrt(squares / static_cast<double>(std::max<std::size_t>(corners, 1)));
  progress(1.0);
  return calibration;
}

void WriteBoardPictures(const BoardCalibration& calibration, const std::string& folder)
{
  std::error_code ignored;
  fs::create_directory(folder, ignored);
  for (const BoardPicture& picture : calibration.pictures)
  {
    if (!picture.used)
    {
      continue;
    }
    const fs::path target = fs::path(folder) / (fs::path(picture.file).stem().string() + ".jpg");
    const cv::Mat pixels =
      cv::imread(picture.file, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
    if (pixels.empty())
    {
      throw Error("Cannot read the picture " + picture.file + " again.");
    }
    AtomicOutput output(target.string());
    std::vector<std::uint8_t> jpeg;
    cv::imencode(".jpg", DrawBoardCorners(pixels, picture.corners), jpeg);
    output.Write(jpeg.data(), jpeg.size());
    output.Commit();
  }
}

Board BoardFromText(const std::string& text)
{
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ':');)
  {
    parts.push_back(part);
  }
  const bool charuco = !parts.empty() && parts[0] == "charuco" && parts.size() == 5;
  const bool chessboard = !parts.empty() && parts[0] == "chessboard" && parts.size() == 3;
  const std::size_t cross = charuco || chessboard ? parts[1].find('x') : std::string::npos;
  if (cross == std::string::npos)
  {
    throw Error("'" + text +
      "' describes no board; it should be as charuco:15x15:0.03:0.0225:"
      "DICT_5X5_250 or chessboard:9x6:0.025.");
  }
  Board board;
  board.kind = charuco ? Board::Kind::Charuco : Board::Kind::Chessboard;
  board.columns = ParseNumber<int>(parts[1].substr(0, cross), text);
  board.rows = ParseNumber<int>(parts[1].substr(cross + 1), text);
  board.square = ParseNumber<double>(parts[2], text);
  if (charuco)
  {
    board.marker = ParseNumber<double>(parts[3], text);
    board.dictionary = parts[4];
  }
  board.Check();
  return board;
}

}
