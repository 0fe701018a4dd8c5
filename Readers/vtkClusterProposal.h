// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkClusterProposal
 * @brief choose the clusters of images for edge stereo
 *
 * Section 3 of the paper takes clusters of five images, "in a cross", whose middle one is the
 * reference; a row of three or five is accepted too, also with the reference at its end. For
 * each image of a scene this class looks for the neighbours that make the best cross, or else the best
 * row, by baseline, overlap and viewing angle, among the nearest ones, because the spacing differs between
 * sets of images. Of all these clusters it keeps a subset: references keep a minimum
 * separation, and in larger sets an image that several references cover is omitted. Clusters that the
 * scene.json names are ignored.
 *
 * The depth of the scene and what images have in common come from the points of the camera model;
 * for an image without points, from the points where the optical axes of its neighbours pass its own
 * most closely. Angles are between the rays from the scene to two camera centres, so that no parameter
 * depends on the unit of the model. Images whose file is missing are not proposed, unless the folder of the
 * images is missing altogether.
 *
 * Propose() reads the scene and chooses; the result can be printed (GetText, GetSummary), queried, and
 * saved as a scene.json (WriteScene). What cannot be read or written, and a scene in which no image has
 * two suitable neighbours, is an error that names the file; the functions then return 0.
 *
 * vtkEdgeStereoReader chooses by itself where a scene names no clusters; one of these, with other
 * parameters, tells it how (vtkEdgeStereoReader::SetClusterProposal).
 *
 * @sa vtkEdgeStereoReader
 */
#ifndef vtkClusterProposal_h
#define vtkClusterProposal_h

#include "vtkFreespaceReadersModule.h" // for the export macro
#include "vtkFreespaceSetGet.h"        // for file names
#include "vtkObject.h"

#include <memory> // for the result
#include <string> // for FileName

class VTKFREESPACEREADERS_EXPORT vtkClusterProposal : public vtkObject
{
public:
  static vtkClusterProposal* New();
  vtkTypeMacro(vtkClusterProposal, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The scene.json whose images and camera model are used.
   */
  vtkSetFilePathStringMacro(FileName);
  vtkGetFilePathStringMacro(FileName);
  ///@}

  ///@{
  /**
   * Instead of a scene.json: the folder or file of a camera model, as vtkSparseModelReader reads it, and
   * the folder of its images. FileName must then be empty.
   */
  vtkSetFilePathStringMacro(Model);
  vtkGetFilePathStringMacro(Model);
  vtkSetFilePathStringMacro(Images);
  vtkGetFilePathStringMacro(Images);
  ///@}

  ///@{
  /**
   * Preferred angle between the reference and a neighbour, in degrees. Default 5.
   */
  vtkSetMacro(PreferredAngle, double);
  vtkGetMacro(PreferredAngle, double);
  ///@}

  ///@{
  /**
   * Minimum angle between the reference and a neighbour, in degrees. Default 1.
   */
  vtkSetMacro(MinimumAngle, double);
  vtkGetMacro(MinimumAngle, double);
  ///@}

  ///@{
  /**
   * Maximum angle between the reference and a neighbour, in degrees. Default 30.
   */
  vtkSetMacro(MaximumAngle, double);
  vtkGetMacro(MaximumAngle, double);
  ///@}

  ///@{
  /**
   * Minimum fraction of the reference's image that a neighbour sees. Default 0.4.
   */
  vtkSetMacro(MinimumOverlap, double);
  vtkGetMacro(MinimumOverlap, double);
  ///@}

  ///@{
  /**
   * Maximum number of neighbours with which a reference is matched: 2 or 4. The second two lie across the
   * first two, or farther out on the same row. Default 4.
   */
  vtkSetMacro(Neighbors, int);
  vtkGetMacro(Neighbors, int);
  ///@}

  ///@{
  /**
   * Minimum angle between two references, seen from the scene, in degrees; of closer ones, which have much the
   * same free space, only the better is kept. 0 makes every possible image a reference. Default 5.
   */
  vtkSetMacro(Separation, double);
  vtkGetMacro(Separation, double);
  ///@}

  ///@{
  /**
   * In sets of more than 24 images: number of references within 20 degrees of an image that see most of what
   * it sees and so make it unnecessary as a reference. 0: no limit. Default 3.
   */
  vtkSetMacro(Coverage, int);
  vtkGetMacro(Coverage, int);
  ///@}

  /**
   * Read the scene and choose. Returns 1, or 0 after an error.
   */
  int Propose();

  ///@{
  /**
   * The clusters that Propose() chose.
   */
  int GetNumberOfClusters();
  std::string GetReference(int cluster);
  int GetNumberOfTriplets(int cluster);
  ///@}

  /**
   * A line for each triplet that Propose() chose, with its images, angles and overlaps.
   */
  std::string GetText();

  /**
   * One line: how many of the images are references, how many are covered by references, and which have no
   * neighbours.
   */
  std::string GetSummary();

  /**
   * Write a scene.json with the clusters that Propose() chose. Returns 1, or 0 after an error.
   */
  int WriteScene(VTK_FILEPATH const std::string& fileName);

protected:
  vtkClusterProposal();
  ~vtkClusterProposal() override;

  std::string FileName;
  std::string Model;
  std::string Images;
  double PreferredAngle;
  double MinimumAngle;
  double MaximumAngle;
  double MinimumOverlap;
  int Neighbors;
  double Separation;
  int Coverage;

private:
  vtkClusterProposal(const vtkClusterProposal&) = delete;
  void operator=(const vtkClusterProposal&) = delete;

  struct Result;
  std::unique_ptr<Result> Chosen;
};

#endif
