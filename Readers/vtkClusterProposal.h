// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkClusterProposal
 * @brief choose the clusters of images for edge stereo
 *
 * Section 3 of the paper takes clusters of five images, "in a cross", whose middle one is the
 * reference; a row of three or five will do too, and at its end a reference beside its neighbours. For
 * each image of a scene this class looks for the neighbours that make the best cross, or else the best
 * row, by baseline, overlap and viewing angle: of those that stand about it, since one set's spacing is
 * not another's. Of all these clusters it keeps those that are worth their time: references keep a
 * separation, and in larger sets an image is left out that several references cover. Clusters that the
 * scene.json has are left out of account.
 *
 * The depth of the scene and what images have in common come from the points of the camera model;
 * for an image without points from where the optical axes of its neighbours pass its own. Angles
 * are those at the scene between the rays to two images' centres: nothing here has the unit of the
 * model. Images whose photograph is missing from the folder of the images are not proposed, as long
 * as that folder exists at all.
 *
 * Propose() reads the scene and chooses; the result can be printed (GetText, GetSummary), asked for, and
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
   * the folder of its photographs. FileName must then be empty.
   */
  vtkSetFilePathStringMacro(Model);
  vtkGetFilePathStringMacro(Model);
  vtkSetFilePathStringMacro(Images);
  vtkGetFilePathStringMacro(Images);
  ///@}

  ///@{
  /**
   * The best angle between the reference and a neighbour, in degrees. Default 5.
   */
  vtkSetMacro(PreferredAngle, double);
  vtkGetMacro(PreferredAngle, double);
  ///@}

  ///@{
  /**
   * Neighbours at less than this angle are not taken, in degrees. Default 1.
   */
  vtkSetMacro(MinimumAngle, double);
  vtkGetMacro(MinimumAngle, double);
  ///@}

  ///@{
  /**
   * Neighbours at more than this angle are not taken, in degrees. Default 30.
   */
  vtkSetMacro(MaximumAngle, double);
  vtkGetMacro(MaximumAngle, double);
  ///@}

  ///@{
  /**
   * The least fraction of the reference's picture that a neighbour must see. Default 0.4.
   */
  vtkSetMacro(MinimumOverlap, double);
  vtkGetMacro(MinimumOverlap, double);
  ///@}

  ///@{
  /**
   * With how many neighbours a reference is matched at most: 2 or 4, of which the second two stand across
   * the first two or farther out. Default 4.
   */
  vtkSetMacro(Neighbors, int);
  vtkGetMacro(Neighbors, int);
  ///@}

  ///@{
  /**
   * References nearer to each other than this, seen from the scene in degrees, have the same free
   * space: only the better is kept. 0 makes every image that can be one a reference. Default 5.
   */
  vtkSetMacro(Separation, double);
  vtkGetMacro(Separation, double);
  ///@}

  ///@{
  /**
   * In sets of more than two dozen images one is not needed as a reference when so many others, none
   * farther than 20 degrees from it, see most of what it sees. 0: no limit. Default 3.
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
   * What Propose() chose.
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
   * In one line, how many of the images are references, how many see what others see, and which have no
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
