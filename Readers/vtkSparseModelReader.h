// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSparseModelReader
 * @brief read a structure-from-motion model as views with their features
 *
 * A structure-from-motion model has cameras and points, and records which image sees which point. Each
 * image with its points is a view; the image file is not needed. Reads COLMAP's models (a
 * folder; binary files are preferred to text), Bundler's bundle.out, VisualSFM's .nvm, OpenMVG's
 * sfm_data.json and AliceVision's .sfm. Files that have cameras only give no features: nerfstudio's
 * and instant-ngp's transforms.json, Metashape's XML and Middlebury's _par.txt; vtkCameraReader and
 * vtkEdgeStereoReader read these, too.
 *
 * A point is a feature of the images that see it when its track is long enough, its rays meet at
 * a sufficient angle and its reprojection error is small. A point that is not in front of an
 * image's camera, such as one that coincides with its centre, is no feature of that image. Images
 * with fewer than MinimumFeatures features inside their frame are left out.
 *
 * Output: a vtkMultiBlockDataSet with one vtkPolyData for each image, named after its file, with
 * the arrays of a view (see the README). ImagePoint is where a camera without the lens's distortion
 * sees the feature. What the model knows more is in further arrays, from which vtkSparseModelWriter
 * makes the same model again; a model is written without loss when it was read with all limits off
 * (MinimumTrackLength 1, MaximumError infinite, MinimumAngle 0, MinimumFeatures 0), but for points
 * that no image sees in front of it and cameras that no image has.
 *
 * | where     | name                | type           | meaning                                  |
 * |-----------|---------------------|----------------|------------------------------------------|
 * | PointData | PointId             | 64 bit integer | number of the point in the model         |
 * | PointData | Observation         | int            | its place among those of the image       |
 * | PointData | ObservedPixel       | double x2      | where the image shows it, distorted    |
 * | PointData | RGB                 | uchar x3       | colour                                   |
 * | PointData | ReprojectionError   | double         | as the model says, pixels; -1: unknown   |
 * | FieldData | ImageId, CameraId   | 64 bit integer | numbers in the model                     |
 * | FieldData | Rotation            | double x4      | cam_from_world, quaternion w x y z       |
 * | FieldData | LensModel           | string         | COLMAP's name of the camera model        |
 * | FieldData | LensParameters      | double         | in COLMAP's order                        |
 * | FieldData | Keypoint            | double x2      | observations that are no features        |
 * | FieldData | KeypointObservation | int            | their places among those of the image    |
 *
 * Isolated points want a vtkOutlierFilter behind the reader that follows their density
 * (SupportRadius 2), and a vtkDelaunayDisparityFilter
 * without ContinueBackground: so it was measured on tracks made from a scene with known truth.
 *
 * A model that is missing, truncated or malformed, one with a camera model that is not supported,
 * and one without a single view is an error that names the file; the output is then empty. After an
 * abort it is empty, too.
 *
 * @sa vtkSparseModelWriter vtkDelaunayDisparityFilter vtkMergeViewsFilter
 */
#ifndef vtkSparseModelReader_h
#define vtkSparseModelReader_h

#include "vtkFreespaceReadersModule.h" // for the export macro
#include "vtkFreespaceSetGet.h"        // for file names
#include "vtkMultiBlockDataSetAlgorithm.h"

#include <string> // for FileName

class VTKFREESPACEREADERS_EXPORT vtkSparseModelReader : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkSparseModelReader* New();
  vtkTypeMacro(vtkSparseModelReader, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The folder of a COLMAP model, a file that ends in .out (Bundler) or in .nvm (VisualSFM).
   */
  vtkSetFilePathStringMacro(FileName);
  vtkGetFilePathStringMacro(FileName);
  ///@}

  ///@{
  /**
   * Minimum number of images that see a point. Default 2.
   */
  vtkSetMacro(MinimumTrackLength, int);
  vtkGetMacro(MinimumTrackLength, int);
  ///@}

  ///@{
  /**
   * Maximum distance of an observation from the projection of its point, in pixels. Default 4.
   */
  vtkSetMacro(MaximumError, double);
  vtkGetMacro(MaximumError, double);
  ///@}

  ///@{
  /**
   * Minimum triangulation angle of a point, the largest between two of its rays, in degrees. If the median
   * over all points is smaller, the median is used: where all baselines are short, half of the points are
   * kept. Default 5.
   */
  vtkSetMacro(MinimumAngle, double);
  vtkGetMacro(MinimumAngle, double);
  ///@}

  ///@{
  /**
   * Images with fewer features inside their frame are left out. Default 10.
   */
  vtkSetMacro(MinimumFeatures, int);
  vtkGetMacro(MinimumFeatures, int);
  ///@}

  /**
   * Whether a path looks like a model: a folder with COLMAP's files or a bundle.out, or a
   * file that ends in .out or .nvm.
   */
  static bool CanReadFile(VTK_FILEPATH const std::string& path);

  ///@{
  /**
   * Whether images are left out, with a warning that names them, whose observations are not the
   * projections of their points. Default true.
   */
  vtkSetMacro(CheckImages, vtkTypeBool);
  vtkGetMacro(CheckImages, vtkTypeBool);
  vtkBooleanMacro(CheckImages, vtkTypeBool);
  ///@}

protected:
  vtkSparseModelReader();
  ~vtkSparseModelReader() override = default;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  std::string FileName;
  // Defaults are those of freespace::SparseViewOptions.
  int MinimumTrackLength;
  double MaximumError;
  double MinimumAngle;
  int MinimumFeatures;
  vtkTypeBool CheckImages = true;

private:
  vtkSparseModelReader(const vtkSparseModelReader&) = delete;
  void operator=(const vtkSparseModelReader&) = delete;
};

#endif
