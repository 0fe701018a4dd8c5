// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkDepthMapReader
 * @brief turn the pixels of depth maps and range images into features
 *
 * RGB-D cameras, laser scanners and the dense stereo of other programs give a depth per pixel. Each map belongs
 * to an image whose camera is in FileName, and becomes a view: pixels become features, with the standard
 * deviation of their depth. Where the depths lie on a plane, within Tolerance deviations, squares of up to
 * LargestBlock pixels are reduced to their corners.
 *
 * Maps are files (COLMAP's dense .bin, .pfm, .png of 16 bits), named after their image: a.jpg.geometric.bin,
 * a.jpg.pfm or a.png are of a.jpg. Or they are vtkImageData of one component in memory, the bottom row
 * first as in VTK. A map has the shape of its image and may be smaller or larger.
 *
 * Output: a vtkMultiBlockDataSet with one vtkPolyData for each map, named after its image, with the arrays
 * of a view (see the README), DisparityDeviation (of 1 / depth) with them.
 *
 * A map that is missing, damaged, of another shape, of no known image or of one that has a map already, and
 * one without any depth are errors that name it; the output is then empty. After an abort it is empty, too.
 *
 * @sa vtkCameraReader vtkDelaunayDisparityFilter vtkMergeViewsFilter
 */
#ifndef vtkDepthMapReader_h
#define vtkDepthMapReader_h

#include "vtkFreespaceReadersModule.h" // for the export macro
#include "vtkFreespaceSetGet.h"        // for file names
#include "vtkMultiBlockDataSetAlgorithm.h"
#include "vtkSmartPointer.h" // for DepthImages

#include <string>  // for FileName
#include <utility> // for DepthImages
#include <vector>  // for DepthFiles

class vtkImageData;

class VTKFREESPACEREADERS_EXPORT vtkDepthMapReader : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkDepthMapReader* New();
  vtkTypeMacro(vtkDepthMapReader, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The scene.json or structure-from-motion model with the cameras of the images.
   */
  vtkSetFilePathStringMacro(FileName);
  vtkGetFilePathStringMacro(FileName);
  ///@}

  /**
   * Adds a file with a depth map.
   */
  void AddDepthFile(VTK_FILEPATH const std::string& fileName);

  /**
   * Adds a depth map in memory, of the image of that name.
   */
  void AddDepthImage(const std::string& image, vtkImageData* depths);

  /**
   * Removes all maps.
   */
  void RemoveAllDepths();

  ///@{
  /**
   * Unit of the cameras for each unit of the maps, for instance 0.001 for millimetres. Default 1.
   */
  vtkSetMacro(Scale, double);
  vtkGetMacro(Scale, double);
  ///@}

  ///@{
  /**
   * Whether maps hold distances from the camera's centre, not depths along its axis. Default off.
   */
  vtkSetMacro(IsRange, vtkTypeBool);
  vtkGetMacro(IsRange, vtkTypeBool);
  vtkBooleanMacro(IsRange, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Depths outside are not used; a FarthestDepth of 0 is no limit. Defaults 0 and 0.
   */
  vtkSetMacro(NearestDepth, double);
  vtkGetMacro(NearestDepth, double);
  vtkSetMacro(FarthestDepth, double);
  vtkGetMacro(FarthestDepth, double);
  ///@}

  ///@{
  /**
   * The standard deviation of a depth z is Deviation + RelativeDeviation z. Defaults 0 and 0.005.
   */
  vtkSetMacro(Deviation, double);
  vtkGetMacro(Deviation, double);
  vtkSetMacro(RelativeDeviation, double);
  vtkGetMacro(RelativeDeviation, double);
  ///@}

  ///@{
  /**
   * How far, in deviations, a depth may be off the plane between the corners of its block. Default 1.
   */
  vtkSetMacro(Tolerance, double);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Side of the largest block, pixels; 1 makes each pixel a feature. Default 16.
   */
  vtkSetMacro(LargestBlock, int);
  vtkGetMacro(LargestBlock, int);
  ///@}

protected:
  vtkDepthMapReader();
  ~vtkDepthMapReader() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  std::string FileName;
  std::vector<std::string> DepthFiles;
  std::vector<std::pair<std::string, vtkSmartPointer<vtkImageData>>> DepthImages;
  double Scale;
  vtkTypeBool IsRange;
  double NearestDepth;
  double FarthestDepth;
  double Deviation;
  double RelativeDeviation;
  double Tolerance;
  int LargestBlock;

private:
  vtkDepthMapReader(const vtkDepthMapReader&) = delete;
  void operator=(const vtkDepthMapReader&) = delete;
};

#endif
