// SPDX-License-Identifier: BSD-3-Clause
#ifndef WatchedSphere_h
#define WatchedSphere_h

#include <vtkSphere.h>

#include <functional>

/// A sphere that tells when it is evaluated, on the thread that evaluates it.
class WatchedSphere : public vtkSphere
{
public:
  static WatchedSphere* New() { return new WatchedSphere; }
  using vtkSphere::EvaluateFunction;
  double EvaluateFunction(double x[3]) override
  {
    this->OnEvaluation();
    return this->vtkSphere::EvaluateFunction(x);
  }
  std::function<void()> OnEvaluation = [] {};
};

#endif
