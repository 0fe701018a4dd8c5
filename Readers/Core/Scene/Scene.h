// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Scene_h
#define freespace_Scene_h

#include "Images/CalibratedImage.h"
#include "SparseModel/SparseModel.h"

#include <opencv2/core.hpp>

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace freespace
{

/// Images around a reference image, from which one view's features are found.
struct Cluster
{
  std::string name;
  std::string reference; ///< an image of the model
  /// Three images about in a row each, the reference in the middle.
  std::vector<std::array<std::string, 3>> triplets;
};

/// The images of a cluster beside its reference, each once, in the order of its triplets.
std::vector<std::string> OtherImages(const Cluster& cluster);

/// A calibration board.
struct Board
{
  enum class Kind
  {
    Charuco, ///< chequered, with a marker in each white square
    Chessboard
  };

  Kind kind = Kind::Charuco;
  int columns = 0; ///< squares of a ChArUco board, inner corners of a chessboard
  int rows = 0;
  double square = 0;      ///< side of a square, in the unit of the model; > 0
  double marker = 0;      ///< side of a marker, smaller than the square; ChArUco only
  std::string dictionary; ///< OpenCV's name, for instance DICT_5X5_250; ChArUco only

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// What a scene.json says:
///
///     { "images": "images", "model": "sparse", "masks": "masks",
///       "clusters": [ { "name": "cluster1", "reference": "c.jpg",
///                       "triplets": [["l.jpg", "c.jpg", "r.jpg"], ["u.jpg", "c.jpg", "d.jpg"]] }
///                       ],
///       "board": { "type": "charuco", "squares": [15, 15], "square_m": 0.03, "marker_m": 0.0225,
///                  "dictionary": "DICT_5X5_250" } }
///
/// `images` and `model`, any that FindModel finds, are relative to the file. So is the optional
/// `masks`: a folder of masks, each named after its image with .png appended (l.jpg.png), as COLMAP has them;
/// black pixels of a mask are ignored in the image. `clusters` and `board` are optional. A chessboard has
/// "type": "chessboard", "corners": [9, 6] (inner ones) and "square_m".
struct Scene
{
  std::string file;              ///< the scene.json
  std::string images;            ///< folder of the images as the file gives it
  std::string model;             ///< folder or file of the camera model as the file gives it
  std::string masks;             ///< folder of the masks as the file gives it; empty: none
  std::vector<Cluster> clusters; ///< empty when the file has none: they are to be proposed
  std::optional<Board> board;
  /// The images by name, where they are in memory (MemoryScene): blue, green, red. Null: they are files.
  std::shared_ptr<const std::map<std::string, cv::Mat>> pixels;

  /// The folders, ready to be opened.
  std::string ImagesFolder() const;
  std::string ModelFolder() const;
  std::string ImagePath(const std::string& image) const;

  /// The image as its camera took it: blue, green, red. Throws Error naming it as LoadImage does.
  cv::Mat Pixels(const CalibratedImage& image) const;

  /// The image's mask, which need not exist; empty where the scene has no masks.
  std::string MaskPath(const std::string& image) const;
};

/// Reads a scene.json, or that of a folder. Of a model (FindModel) it makes a scene whose images are
/// where the model's file tells, or else in the folder `images` beside the model or above it. Throws Error
/// naming the file and the fault: broken JSON, a missing, unknown or ill-typed key, a triplet without the
/// reference in its middle or with an image twice, two clusters of one name, a board that makes no sense.
Scene ReadScene(const std::string& file);

/// Writes a scene as a scene.json, which is made beside its target and renamed. Relative folders
/// are made relative to the new file. Throws Error when the file cannot be written.
void WriteScene(const Scene& scene, const std::string& file);

/// Reads the scene's camera model, its cameras scaled to the images (ScaleToPhotographs, which says
/// what is put into `scaled`). Throws Error when that fails (see ReadSparseModel) or when a
/// cluster names an image that the model does not have.
SparseModel ReadSceneModel(const Scene& scene, std::string* scaled = nullptr);

/// The images of a model (FindModel) or of a scene's. Throws as ReadSparseModel, ReadScene and ReadSceneModel do.
std::vector<CalibratedImage> ReadCameras(const std::string& path);

/// The images of the scene's model. Throws as ReadSceneModel does.
std::vector<CalibratedImage> ReadSceneImages(const Scene& scene);

/// Those of a scene's images whose files are there.
std::vector<CalibratedImage> PresentImages(const Scene& scene, std::vector<CalibratedImage> images);

}

#endif
