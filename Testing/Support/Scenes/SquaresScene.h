// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SquaresScene_h
#define freespace_SquaresScene_h

#include "Support/SyntheticImages.h"
#include "Support/TemporaryFolder.h"

#include <opencv2/imgcodecs.hpp>

#include <sstream>
#include <string>
#include <vector>

namespace freespace
{

/// A scene.json with as many clusters, all of the same three images of coloured squares.
class SquaresScene
{
public:
  explicit SquaresScene(int clusters)
  {
    Layer plane;
    plane.exists = Everywhere();
    plane.color = RandomSquares(0.06, 5);
    const std::vector<Camera> cameras = CrossOfCameras();
    std::filesystem::create_directories(this->Folder.Path("images"));
    std::ostringstream images;
    images.precision(17);
    const char* names[3] = { "c.png", "l.png", "r.png" };
    for (int i = 0; i < 3; ++i)
    {
      cv::imwrite(
        this->Folder.Path("images/" + std::string(names[i])), Render({ plane }, cameras[i]));
      const Eigen::Quaterniond q(cameras[i].R);
      const Eigen::Vector3d& t = cameras[i].t;
      images << i + 1 << ' ' << q.w() << ' ' << q.x() << ' ' << q.y() << ' ' << q.z() << ' '
             << t.x() << ' ' << t.y() << ' ' << t.z() << " 1 " << names[i] << "\n\n";
    }
    this->Folder.Write("sparse/images.txt", images.str());
    this->Folder.Write("sparse/cameras.txt", "1 PINHOLE 240 180 400 400 121.3 88.6\n");
    std::string json;
    for (int i = 0; i < clusters; ++i)
    {
      json += std::string(i ? "," : "") + R"({ "name": "cluster)" + std::to_string(i) +
        R"(", "reference": "c.png", "triplets": [["l.png", "c.png", "r.png"]] })";
    }
    this->File = this->Folder.Write(
      "scene.json", R"({ "images": "images", "model": "sparse", "clusters": [)" + json + "] }");
  }

  TemporaryFolder Folder;
  std::string File;
};

}

#endif
