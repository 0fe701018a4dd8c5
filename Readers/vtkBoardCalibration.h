// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkBoardCalibration
 * @brief calibrate a camera from images of a ChArUco board or a chessboard
 *
 * Section 3 of the paper takes its cameras from a calibration grid in the images. This class finds
 * the board in each image and calibrates: the intrinsics with the lens's distortion, and the pose
 * of every image. A ChArUco board may be partly hidden; of a chessboard all inner corners must be
 * seen. Images without the board are left out; corners that do not fit are dropped. All
 * images of one size are assumed to be of one camera, and at least three of them must show the board.
 *
 * The corners of the board are detected with OpenCV and, once the camera is approximately known, again by
 * following the four edges that meet in each. The number of distortion coefficients, MaximumCoefficients at
 * most, is chosen by the Bayesian information criterion.
 *
 * World coordinates are those of the board: the origin in its centre, x along its columns, y up along its
 * rows, z towards the cameras, lengths in the unit of its squares.
 *
 * Output: a vtkMultiBlockDataSet as vtkSparseModelReader's, one view for each image in which the
 * board was found; its features are the corners of the board. vtkSparseModelWriter writes it as a
 * COLMAP model. The names of the images are relative to GetImagesFolder(), the folder that holds them
 * all.
 *
 * An image that cannot be read, an invalid description of a board, and too few images
 * with the board are errors that name them; the output is then empty. After an abort it is empty, too.
 *
 * @sa vtkSparseModelWriter vtkEdgeStereoReader
 */
#ifndef vtkBoardCalibration_h
#define vtkBoardCalibration_h

#include "vtkFreespaceReadersModule.h" // for the export macro
#include "vtkMultiBlockDataSetAlgorithm.h"

#include <memory> // for the result
#include <string> // for file names
#include <vector> // for file names

class VTKFREESPACEREADERS_EXPORT vtkBoardCalibration : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkBoardCalibration* New();
  vtkTypeMacro(vtkBoardCalibration, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The images.
   */
  void AddFileName(VTK_FILEPATH const std::string& fileName);
  void ClearFileNames();
  int GetNumberOfFileNames();
  ///@}

  ///@{
  /**
   * The board: `charuco:15x15:0.03:0.0225:DICT_5X5_250` has 15 x 15 squares of 0.03 with markers of
   * 0.0225 of that dictionary, `chessboard:9x6:0.025` has 9 x 6 inner corners and squares of 0.025.
   */
  vtkSetMacro(Board, std::string);
  vtkGetMacro(Board, std::string);
  ///@}

  ///@{
  /**
   * Maximum number of distortion coefficients: 0, 1 (k1), 2 (k2), 4 (p1, p2) or 5 (k3). Default 5.
   */
  vtkSetMacro(MaximumCoefficients, int);
  vtkGetMacro(MaximumCoefficients, int);
  ///@}

  ///@{
  /**
   * Whether the pixels are square, so that there is one focal length. Default on.
   */
  vtkSetMacro(SquarePixels, vtkTypeBool);
  vtkGetMacro(SquarePixels, vtkTypeBool);
  vtkBooleanMacro(SquarePixels, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Minimum number of corners in an image that is used. Default 8.
   */
  vtkSetMacro(MinimumCorners, int);
  vtkGetMacro(MinimumCorners, int);
  ///@}

  /**
   * After an Update: the root mean square reprojection error of all corners, in pixels.
   */
  double GetReprojectionError();

  /**
   * After an Update: a line for each image with its number of corners and its reprojection error, or
   * why it is not used, and a line for each camera with its intrinsics.
   */
  std::string GetText();

  /**
   * After an Update: the folder that holds all images.
   */
  std::string GetImagesFolder();

  /**
   * After an Update: write each image with the corners that were found in it, as a .jpg into a folder
   * that is made when its last part is missing. Returns 1, or 0 after an error.
   */
  int WritePictures(VTK_FILEPATH const std::string& folder);

  /**
   * After an Update: write a scene.json of the images, with the board, for a camera model in the
   * folder `model`. Returns 1, or 0 after an error.
   */
  int WriteScene(VTK_FILEPATH const std::string& fileName, const std::string& model);

protected:
  vtkBoardCalibration();
  ~vtkBoardCalibration() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  std::vector<std::string> FileNames;
  std::string Board;
  // Defaults are those of freespace::BoardCalibrationOptions.
  int MaximumCoefficients;
  vtkTypeBool SquarePixels;
  int MinimumCorners;

private:
  vtkBoardCalibration(const vtkBoardCalibration&) = delete;
  void operator=(const vtkBoardCalibration&) = delete;

  struct Result;
  std::unique_ptr<Result> Calibrated;
};

#endif
