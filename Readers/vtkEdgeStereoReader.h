// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkEdgeStereoReader
 * @brief features of calibrated images by trinocular edge stereo
 *
 * Reads a scene.json, finds the edges of its images with sub-pixel precision, matches them over
 * each cluster of images and gives the features that the cluster's reference image shows: section 3
 * of the paper. Each feature is an edge token that was seen in three images at least (a few, in two,
 * where they close a gap of an edge that was seen in three); its depth is
 * from all of them together, its position in the reference image (ImagePoint) and its world
 * position lie on one ray. An edge nearly parallel to a baseline cannot be matched along it,
 * therefore a cluster should have one horizontal and one vertical triplet. A silhouette is matched by
 * the colours of the object in front, whatever lies behind it. Where edges have no match and between them,
 * small patches of the images are aligned, and those that agree become features, too (see Patches).
 *
 * The search covers the depths between MinimumDepth and MaximumDepth that all cameras of the triplets
 * see. Lens distortion is removed from the edges' positions.
 *
 * Instead of a scene.json, images in memory may be connected: a vtkMultiBlockDataSet (or
 * vtkPartitionedDataSetCollection) of vtkImageData as vtkPhotographReader generates it, each block named after its
 * image and with the field data CameraIntrinsics, CameraFromWorld and ImageSize. They are free of lens distortion,
 * grey or colour, the bottom row first as in VTK; more than 8 bits are brought to 8 by the range of their numbers.
 * AddTriplet makes their clusters; without any these are proposed from the cameras. The features are those of the
 * same scene on disk.
 *
 * Output: a vtkMultiBlockDataSet, one vtkPolyData for each cluster and named after it. Points are
 * the features in world coordinates; each is a vertex cell, each chain of features along an edge is
 * a polyline.
 *
 * | where     | name             | type             | meaning                                        |
 * |-----------|------------------|------------------|------------------------------------------------|
 * | PointData | ImagePoint       | double x2        | where the reference sees it, pixels            |
 * | PointData | RGB              | unsigned char x3 | its colour in the reference image              |
 * | PointData | EdgeDirection    | double x3        | of the edge in the world, unit length; 0: patch|
 * | PointData | DisparityDeviation | double         | standard deviation of its 1 / depth            |
 * | PointData | MatchingCost     | double           | 0 (perfect) to 1                               |
 * | PointData | ChainId          | int              | number of its polyline; -1: a patch            |
 * | FieldData | CameraIntrinsics | double x9        | K of the reference, row-major                  |
 * | FieldData | CameraFromWorld  | double x12       | [R t], row-major                               |
 * | FieldData | ImageSize        | int x2           | width, height                                  |
 * | FieldData | ImageFile        | string           | the reference image, relative to the images    |
 *
 * With EveryImage on, every image of a cluster is the reference of a view of its own, over the same
 * images: a cross gives five views instead of one. This goes beyond the paper, and takes up to three times
 * as long here and in the following stages. The other images see parts of the scene that are occluded in
 * the reference image, so that less matter remains between objects that stand close together. These
 * views come after those of the references, named after cluster and image; one without three features
 * is left out.
 *
 * Clusters run in parallel through vtkSMPTools, with the same result for any number of threads;
 * only the images of the clusters being processed are in memory.
 *
 * Images that contradict the others (see CheckImages) and clusters with very few features for their edges
 * are left out; a warning names them. A file that is missing, broken or does not fit, a triplet without
 * overlap and a scene of which nothing is left is an error that names the file or cluster; the output is
 * then empty. After an abort it is empty, too. The reader runs again when the scene's file has changed on disk, but
 * does not watch the images and the camera model.
 *
 * C. J. Taylor, "Surface Reconstruction from Feature Based Stereo", ICCV 2003, section 3.
 *
 * @sa vtkPhotographReader vtkClusterProposal vtkDelaunayDisparityFilter vtkFeatureOverlayWriter
 *
 * @warning Only edges are matched. A surface without texture has features at its outline only, and
 * highlights and reflections are matched as if they were on the surface.
 */
#ifndef vtkEdgeStereoReader_h
#define vtkEdgeStereoReader_h

#include "vtkFreespaceReadersModule.h" // for the export macro
#include "vtkFreespaceSetGet.h"        // for file names
#include "vtkMultiBlockDataSetAlgorithm.h"

#include "vtkSmartPointer.h" // for the cluster proposal

#include <array>  // for Triplets
#include <string> // for FileName
#include <vector> // for FilesRead

class vtkClusterProposal;

namespace freespace
{
struct EdgeStereoOptions;
struct MemoryScene;
class SharedWork;
}

class VTKFREESPACEREADERS_EXPORT vtkEdgeStereoReader : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkEdgeStereoReader* New();
  vtkTypeMacro(vtkEdgeStereoReader, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The scene.json to read; none where images are connected.
   */
  vtkSetFilePathStringMacro(FileName);
  vtkGetFilePathStringMacro(FileName);
  ///@}

  ///@{
  /**
   * Clusters of connected images: a triplet of images about in a row, by the names of their blocks, the
   * reference in the middle. Triplets of one cluster have the same reference. Default: none.
   */
  void AddTriplet(const std::string& cluster, const std::string& first,
    const std::string& reference, const std::string& last);
  void RemoveAllTriplets();
  int GetNumberOfTriplets();
  ///@}

  ///@{
  /**
   * The depths to search in front of each reference camera, in the unit of the camera model. 0
   * stands for no limit but the cameras' common volume. Defaults 0 and 0.
   */
  vtkSetMacro(MinimumDepth, double);
  vtkGetMacro(MinimumDepth, double);
  vtkSetMacro(MaximumDepth, double);
  vtkGetMacro(MaximumDepth, double);
  ///@}

  ///@{
  /**
   * Sigma of the Gaussian of the edge detector, in pixels. Default 1.
   */
  vtkSetMacro(Smoothing, double);
  vtkGetMacro(Smoothing, double);
  ///@}

  ///@{
  /**
   * Minimum gradient of an edge pixel, in grey levels per pixel. Default 1.8.
   */
  vtkSetMacro(LowContrast, double);
  vtkGetMacro(LowContrast, double);
  ///@}

  ///@{
  /**
   * Gradient that at least one token of a chain must reach (hysteresis), in grey levels per pixel. Default 4.5.
   */
  vtkSetMacro(HighContrast, double);
  vtkGetMacro(HighContrast, double);
  ///@}

  ///@{
  /**
   * Maximum distance of an edge, across it, from where two other images predict it, in pixels. Default
   * 0.7; images whose edges fit better than that are held to several times their median error.
   */
  vtkSetMacro(Tolerance, double);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Minimum angle between an edge and the epipolar line for a match, in degrees. Default 6.
   */
  vtkSetMacro(MinimumAngle, double);
  vtkGetMacro(MinimumAngle, double);
  ///@}

  ///@{
  /**
   * Maximum mean difference of the colours on the more similar side of an edge, in grey levels of
   * a logarithmic scale. Default 45.
   */
  vtkSetMacro(ColorTolerance, double);
  vtkGetMacro(ColorTolerance, double);
  ///@}

  ///@{
  /**
   * Minimum number of consecutive tokens of a chain that match. Default 4.
   */
  vtkSetMacro(MinimumRun, int);
  vtkGetMacro(MinimumRun, int);
  ///@}

  ///@{
  /**
   * Whether small patches of the images, aligned to each other, become features where the edges leave
   * gaps: at edges without a match and between them. The paper uses edges only. Default on.
   */
  vtkSetMacro(Patches, vtkTypeBool);
  vtkGetMacro(Patches, vtkTypeBool);
  vtkBooleanMacro(Patches, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether every image of a cluster makes a view, not the reference alone: never (off), always (on), or
   * in small scenes, whose clusters have no more than 15 images in all. There the other images add most, and
   * the time is short. Default small scenes.
   */
  enum EveryImageMode
  {
    NEVER = 0,
    ALWAYS = 1,
    IN_SMALL_SCENES = 2
  };
  vtkSetClampMacro(EveryImage, int, NEVER, IN_SMALL_SCENES);
  vtkGetMacro(EveryImage, int);
  vtkBooleanMacro(EveryImage, int);
  ///@}

  ///@{
  /**
   * Whether the edges refine the poses of the cameras before they are matched: never (off), always (on),
   * or where the scene has up to 200 images. Cameras that fit the edges as they are stay exactly as they
   * are in any case. The views then have the refined cameras. Default small scenes.
   */
  enum RefineCamerasMode
  {
    REFINE_NEVER = 0,
    REFINE_ALWAYS = 1,
    REFINE_SMALL_SCENES = 2
  };
  vtkSetClampMacro(RefineCameras, int, REFINE_NEVER, REFINE_SMALL_SCENES);
  vtkGetMacro(RefineCameras, int);
  vtkBooleanMacro(RefineCameras, int);
  ///@}

  ///@{
  /**
   * Whether images that do not fit the others are left out, with a warning that names them: those whose
   * edges contradict the edges of the images about them, because the file is another image, the image is
   * rotated, or its camera is wrong, and those whose observations in the camera model are not the projections of their
   * points. Default true.
   */
  vtkSetMacro(CheckImages, vtkTypeBool);
  vtkGetMacro(CheckImages, vtkTypeBool);
  vtkBooleanMacro(CheckImages, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether the rays through the black pixels of the images' masks are free space: every image of the camera model
   * that has a mask gives a silhouette, with which the surface lies within the visual hull of the masks. Silhouettes
   * are blocks behind those of the views, named after the image, with triangles behind all features; their points
   * have the SourceView -1 and are no features. The scene must have masks. For turntables and objects in front of a
   * background that is masked. Default off: what is masked is not known.
   */
  vtkSetMacro(MaskIsFree, vtkTypeBool);
  vtkGetMacro(MaskIsFree, vtkTypeBool);
  vtkBooleanMacro(MaskIsFree, vtkTypeBool);
  ///@}

  ///@{
  /**
   * How clusters are chosen where the scene.json names none: by the parameters of this object. None, the
   * default, stands for one with the default parameters.
   */
  void SetClusterProposal(vtkClusterProposal* proposal);
  vtkClusterProposal* GetClusterProposal();
  ///@}

  /**
   * What shares the work out among several processes, each of which updates a reader like this one with the same
   * input, within its Together; all get the same output. For C++; it must outlive the update. Default: none.
   */
  void SetSharedWork(freespace::SharedWork* work) { this->Shared = work; }

  /**
   * After Update(): in one line, how many of the images were chosen to be references and which have no
   * neighbours, see vtkClusterProposal::GetSummary. Empty when the scene.json names its clusters.
   */
  std::string GetClusterSummary() { return this->ClusterSummary; }

  /**
   * After Update(): in one line, how many images differ in size from the cameras of the model, which
   * are then scaled. Empty when none has.
   */
  std::string GetImageSummary() { return this->ImageSummary; }

  /**
   * After Update(): in one line, whether the poses of the cameras were refined, and what that brought.
   */
  std::string GetCameraSummary() { return this->CameraSummary; }

  /**
   * After Update(): in one line, whether every image of a cluster is a view or its reference alone, and why.
   */
  std::string GetViewSummary() { return this->ViewSummary; }

  /**
   * Later than the reader's own modification time when one of the files that it has read has changed since:
   * the scene.json, the camera model or an image.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkEdgeStereoReader();
  ~vtkEdgeStereoReader() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  std::string FileName;
  std::vector<std::array<std::string, 4>> Triplets; // cluster, first, reference, last
  double MinimumDepth = 0.0;
  double MaximumDepth = 0.0;
  // Defaults are those of freespace::EdgeStereoOptions.
  double Smoothing;
  double LowContrast;
  double HighContrast;
  double Tolerance;
  double MinimumAngle;
  double ColorTolerance;
  int MinimumRun;
  vtkTypeBool Patches;
  int EveryImage = IN_SMALL_SCENES;
  int RefineCameras = REFINE_SMALL_SCENES;
  vtkTypeBool CheckImages = true;
  vtkTypeBool MaskIsFree = false;

private:
  freespace::EdgeStereoOptions StereoOptions() const;
  bool IsEveryImageAView(std::size_t images);
  freespace::MemoryScene SceneOf(vtkInformationVector* images) const;

  vtkEdgeStereoReader(const vtkEdgeStereoReader&) = delete;
  void operator=(const vtkEdgeStereoReader&) = delete;

  vtkSmartPointer<vtkClusterProposal> ClusterProposal;
  freespace::SharedWork* Shared = nullptr;
  std::string ClusterSummary;
  std::string ImageSummary;
  std::string CameraSummary;
  std::string ViewSummary;
  vtkTimeStamp FilesChanged;
  long long FilesTime = 0;            // of when all of them were written
  std::vector<std::string> FilesRead; // beside the scene's
};

#endif
