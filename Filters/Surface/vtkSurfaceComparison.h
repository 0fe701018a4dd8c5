// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSurfaceComparison
 * @brief how close a surface is to a reference, and the reference to it
 *
 * Inputs: the surface (port 0) and the reference (port 1), each a vtkPolyData whose polygons and strips count;
 * no lines or vertices. Outputs: both with the point data array Distance (double), from each point to the
 * nearest point of the other surface; infinite for a point that is not finite.
 *
 * Distances are exact, found by a tree of boxes on all threads, and the same for any number of threads. The
 * figures are of Samples random points of each surface, evenly by area and the same in each run, so that they do
 * not depend on how a surface is cut into triangles. `from` is SurfaceToReference or ReferenceToSurface:
 * accuracy is the share of the surface that is near to the reference, completeness that of the reference
 * that is near to the surface, and F their harmonic mean.
 *
 * A surface without area, and points of triangles that are not finite, are errors; the outputs are empty then, as
 * after an abort.
 *
 * @sa vtkDistancePolyDataFilter vtkSurfaceReader
 */
#ifndef vtkSurfaceComparison_h
#define vtkSurfaceComparison_h

#include "vtkFreespaceSurfaceModule.h" // for the export macro
#include "vtkPolyDataAlgorithm.h"

#include <memory> // for the figures
#include <vector> // for the limits

namespace freespace
{
struct SurfaceComparison;
}

class VTKFREESPACESURFACE_EXPORT vtkSurfaceComparison : public vtkPolyDataAlgorithm
{
public:
  static vtkSurfaceComparison* New();
  vtkTypeMacro(vtkSurfaceComparison, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Direction
  {
    SurfaceToReference = 0,
    ReferenceToSurface = 1
  };

  ///@{
  /**
   * Distances at which accuracy, completeness and F are told, in the surfaces' unit. Default: none, which
   * takes 0.1, 0.2 and 0.5 % of the diagonal of the reference. After an update GetUsedLimits has them, ascending.
   */
  void SetLimits(const std::vector<double>& limits);
  const std::vector<double>& GetLimits() const { return this->Limits; }
  std::vector<double> GetUsedLimits();
  ///@}

  ///@{
  /**
   * Random points of each surface; 0: its points alone. Default 500000.
   */
  vtkSetMacro(Samples, int);
  vtkGetMacro(Samples, int);
  ///@}

  ///@{
  /**
   * Bins of the histogram, from 0 to the greatest limit. Default 50.
   */
  vtkSetMacro(Bins, int);
  vtkGetMacro(Bins, int);
  ///@}

  ///@{
  /**
   * After an update: at each limit, in [0, 1]. Empty before.
   */
  std::vector<double> GetAccuracy();
  std::vector<double> GetCompleteness();
  std::vector<double> GetF();
  ///@}

  ///@{
  /**
   * After an update: distances in the unit of the surfaces, angles between the normals in degrees. 0 before.
   */
  double GetMeanDistance(int from);
  double GetRootMeanSquareDistance(int from);
  double GetMedianDistance(int from);
  double GetGreatestDistance(int from);
  double GetMeanAngle(int from);
  double GetMedianAngle(int from);
  ///@}

  /**
   * After an update: the share of the samples in each bin, and in one more beyond the greatest limit.
   */
  std::vector<double> GetHistogram(int from);

protected:
  vtkSurfaceComparison();
  ~vtkSurfaceComparison() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  std::vector<double> Limits;
  int Samples;
  int Bins;

private:
  vtkSurfaceComparison(const vtkSurfaceComparison&) = delete;
  void operator=(const vtkSurfaceComparison&) = delete;

  std::unique_ptr<freespace::SurfaceComparison> Figures; ///< never null
};

#endif
