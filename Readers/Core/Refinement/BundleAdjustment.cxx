// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/BundleAdjustment.h"

#include "Common/Error.h"
#include "Common/Median.h"
#include "Refinement/EdgeDistance.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

namespace freespace
{

namespace
{

// The motion of a camera, in deviations.
struct MotionSize
{
  template <typename T>
  bool operator()(const T* motion, T* residual) const
  {
    for (int k = 0; k < 6; ++k)
    {
      residual[k] = motion[k] * this->weight;
    }
    return true;
  }

  double weight;
};

struct FocalLengthChange
{
  template <typename T>
  bool operator()(const T* logFocal, T* residual) const
  {
    residual[0] = *logFocal * this->weight;
    return true;
  }

  double weight;
};

bool IsConfirmed(const EdgeTrack& track)
{
  return track.observations.size() >= 3;
}

class Adjustment : ceres::EvaluationCallback
{
public:
  Adjustment(const std::vector<Camera>& given, std::vector<Camera>& cameras,
    const std::vector<int>& lensOf, std::vector<EdgeTrack>& tracks,
    const BundleAdjustmentOptions& options)
    : Given(given)
    , Cameras(cameras)
    , LensOf(lensOf)
    , Tracks(tracks)
    , Options(options)
    , Motions(cameras.size(), CameraMotion{})
    , IsObserved(cameras.size(), 0)
    , LogFocals(lensOf.empty() ? 0 : *std::max_element(lensOf.begin(), lensOf.end()) + 1, 0.0)
  {
    this->FindDepths();
    this->FindMotions();
    for (std::size_t i = 0; i < given.size(); ++i)
    {
      this->Moving.emplace_back(given[i], this->Depths[i]);
    }
  }

  BundleAdjustmentSummary Run()
  {
    constexpr double coarse = 0.2, finest = 0.02; // pixels
    constexpr double perMedian = 1.4826;          // deviations of a normal distribution
    constexpr int pointIterations = 5;            // two unknowns each
    BundleAdjustmentSummary summary;
    this->Solve(coarse, false, pointIterations);
    summary.residualBefore = MedianOr(this->Distances(), 0.0);
    this->Solve(coarse, true, this->Options.iterations / 2);
    this->Solve(std::max(finest, perMedian * MedianOr(this->Distances(), 0.0)), true,
      this->Options.iterations);
    summary.residualAfter = MedianOr(this->Distances(), 0.0);
    this->MoveCameras();
    summary.motion = this->ImageMotion();
    return summary;
  }

private:
  // The depth of the scene before each camera.
  void FindDepths()
  {
    std::vector<std::vector<double>> depths(this->Given.size());
    for (const EdgeTrack& track : this->Tracks)
    {
      for (const EdgeObservation& observation : track.observations)
      {
        if (IsConfirmed(track))
        {
          depths[observation.image].push_back(this->Given[observation.image].Depth(track.point));
        }
      }
    }
    for (std::size_t camera = 0; camera < this->Given.size(); ++camera)
    {
      const double depth = MedianOr(std::move(depths[camera]), 0.0);
      this->Depths.push_back(depth > 0 ? depth : 1);
    }
  }

  // The motion from the given cameras to the current ones.
  void FindMotions()
  {
    for (std::size_t i = 0; i < this->Given.size(); ++i)
    {
      const Eigen::Matrix3d R = this->Cameras[i].R * this->Given[i].R.transpose();
      const Eigen::AngleAxisd turn(R);
      Eigen::Map<Eigen::Vector3d>(this->Motions[i].data()) = turn.angle() * turn.axis();
      Eigen::Map<Eigen::Vector3d>(this->Motions[i].data() + 3) =
        (this->Cameras[i].t - R * this->Given[i].t) / this->Depths[i];
      this->LogFocals[this->LensOf[i]] =
        std::log(this->Cameras[i].K(0, 0) / this->Given[i].K(0, 0));
    }
  }

  void PrepareForEvaluation(bool, bool) override
  {
    for (std::size_t i = 0; i < this->Moving.size(); ++i)
    {
      this->Moving[i].Move(this->Motions[i], this->LogFocals[this->LensOf[i]]);
    }
  }

  // Least squares over the points, and the cameras where these move. `deviation`: of the position of
  // a strong edge, pixels.
  void Solve(double deviation, bool moveCameras, int iterations)
  {
    ceres::Problem::Options ownership;
    ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ownership.evaluation_callback = this;
    ceres::CauchyLoss loss(2.0); // deviations
    ceres::Problem problem(ownership);
    auto* ordering = new ceres::ParameterBlockOrdering;
    this->AddTracks(problem, loss, deviation, *ordering);
    this->AddPriors(problem, *ordering);
    for (std::size_t camera = 0; camera < this->Given.size(); ++camera)
    {
      if (!moveCameras && problem.HasParameterBlock(this->Motions[camera].data()))
      {
        problem.SetParameterBlockConstant(this->Motions[camera].data());
      }
    }
    for (double& logFocal : this->LogFocals)
    {
      if (!(moveCameras && this->Options.refineFocalLengths) &&
        problem.HasParameterBlock(&logFocal))
      {
        problem.SetParameterBlockConstant(&logFocal);
      }
    }
    constexpr std::size_t few = 200; // cameras whose normal matrix may be dense
    ceres::Solver::Options options;
    options.linear_solver_ordering.reset(ordering);
    options.linear_solver_type =
      this->Given.size() <= few ? ceres::DENSE_SCHUR : ceres::SPARSE_SCHUR;
    options.max_num_iterations = iterations;
    options.function_tolerance = 1e-5;
    options.num_threads = 1; // sums in another order would round in another way
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
  }

  void AddTracks(ceres::Problem& problem, ceres::LossFunction& loss, double deviation,
    ceres::ParameterBlockOrdering& ordering)
  {
    for (EdgeTrack& track : this->Tracks)
    {
      if (!IsConfirmed(track))
      {
        continue;
      }
      ordering.AddElementToGroup(track.point.data(), 0);
      for (const EdgeObservation& observation : track.observations)
      {
        const bool isReference = &observation == &track.observations.front();
        const std::size_t camera = observation.image;
        this->IsObserved[camera] = 1;
        problem.AddResidualBlock(
          new EdgeDistance(this->Moving[camera], observation,
            1 / (deviation * observation.uncertainty), isReference ? 1.0 : 0.0),
          &loss, this->Motions[camera].data(), &this->LogFocals[this->LensOf[camera]],
          track.point.data());
      }
    }
  }

  void AddPriors(ceres::Problem& problem, ceres::ParameterBlockOrdering& ordering)
  {
    using Cost = ceres::AutoDiffCostFunction<MotionSize, 6, 6>;
    using FocalCost = ceres::AutoDiffCostFunction<FocalLengthChange, 1, 1>;
    for (std::size_t camera = 0; camera < this->Given.size(); ++camera)
    {
      double* motion = this->Motions[camera].data();
      if (problem.HasParameterBlock(motion))
      {
        const double focal = this->Given[camera].K(0, 0);
        problem.AddResidualBlock(
          new Cost(new MotionSize{ focal / this->Options.poseDeviation }), nullptr, motion);
        ordering.AddElementToGroup(motion, 1);
        ordering.AddElementToGroup(&this->LogFocals[this->LensOf[camera]], 1);
      }
    }
    for (double& logFocal : this->LogFocals)
    {
      if (problem.HasParameterBlock(&logFocal))
      {
        problem.AddResidualBlock(
          new FocalCost(new FocalLengthChange{ 1 / this->Options.focalLengthDeviation }), nullptr,
          &logFocal);
      }
    }
  }

  // Of the points' images from the edges, pixels.
  std::vector<double> Distances()
  {
    this->PrepareForEvaluation(false, true);
    std::vector<double> distances;
    for (const EdgeTrack& track : this->Tracks)
    {
      for (const EdgeObservation& observation : track.observations)
      {
        if (IsConfirmed(track))
        {
          const MovingCamera& camera = this->Moving[observation.image];
          const Eigen::Vector3d inCamera = camera.Current().FromWorld(track.point);
          distances.push_back(inCamera.z() > 0
              ? std::abs(observation.normal.dot(camera.Pixel(inCamera) - observation.position))
              : 0.0);
        }
      }
    }
    return distances;
  }

  void MoveCameras()
  {
    this->PrepareForEvaluation(false, true);
    for (std::size_t i = 0; i < this->Moving.size(); ++i)
    {
      if (this->IsObserved[i])
      {
        this->Cameras[i] = this->Moving[i].Current();
      }
    }
  }

  // See the summary.
  double ImageMotion() const
  {
    std::vector<std::vector<double>> motions(this->Given.size());
    for (const EdgeTrack& track : this->Tracks)
    {
      for (const EdgeObservation& observation : track.observations)
      {
        const std::size_t i = observation.image;
        if (IsConfirmed(track) && this->Given[i].Depth(track.point) > 0)
        {
          motions[i].push_back(
            (this->Cameras[i].Project(track.point) - this->Given[i].Project(track.point)).norm());
        }
      }
    }
    std::vector<double> medians;
    for (std::vector<double>& motion : motions)
    {
      if (!motion.empty())
      {
        medians.push_back(MedianOr(std::move(motion), 0.0));
      }
    }
    return MedianOr(std::move(medians), 0.0);
  }

  const std::vector<Camera>& Given;
  std::vector<Camera>& Cameras;
  const std::vector<int>& LensOf;
  std::vector<EdgeTrack>& Tracks;
  const BundleAdjustmentOptions& Options;
  std::vector<CameraMotion> Motions; // per camera, from the given one
  std::vector<MovingCamera> Moving;  // where the motions bring the cameras
  std::vector<char> IsObserved;      // per camera
  std::vector<double> Depths;        // of the scene, per camera
  std::vector<double> LogFocals;     // per lens
};

}

void BundleAdjustmentOptions::Check() const
{
  if (!(this->poseDeviation > 0) || !(this->focalLengthDeviation > 0) || this->iterations < 2)
  {
    throw Error("The deviations of given cameras and the number of iterations must be positive.");
  }
}

BundleAdjustmentSummary AdjustCameras(const std::vector<Camera>& given,
  std::vector<Camera>& cameras, const std::vector<int>& lensOf, std::vector<EdgeTrack>& tracks,
  const BundleAdjustmentOptions& options)
{
  options.Check();
  return Adjustment(given, cameras, lensOf, tracks, options).Run();
}

}
