// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_RowScene_h
#define freespace_RowScene_h

#include "Agreement/CheckedScene.h"
#include "Support/SyntheticImages.h"
#include "Support/TemporaryFolder.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace freespace
{

/// Two slanted planes of coloured squares, photographed from a row of seven places, on disk.
class RowScene
{
public:
  static constexpr int Count = 7;

  RowScene()
  {
    const Layers planes = TwoPlanes(1.2, [](double x, double y) { return x * x + y * y < 0.02; });
    std::filesystem::create_directories(this->Folder.Path("images"));
    for (int i = 0; i < Count; ++i)
    {
      const double x = 0.1 * (i - Count / 2);
      this->Cameras.push_back(LookAt({ x, 0.02 * (i % 2), 0.1 * x * x }, { 0, 0, 1 }));
      cv::imwrite(this->File(i), Render(planes, this->Cameras[i], nullptr, 12));
    }
    this->WriteModel();
    this->Path = this->Folder.Write("scene.json", R"({ "images": "images", "model": "sparse" })");
  }

  std::string File(int i) const
  {
    return this->Folder.Path("images/" + std::to_string(i) + ".png");
  }

  void Turn(int i) const
  {
    cv::Mat turned;
    cv::rotate(cv::imread(this->File(i)), turned, cv::ROTATE_180);
    cv::imwrite(this->File(i), turned);
  }

  void WriteModel() const
  {
    std::ostringstream images;
    images.precision(17);
    for (int i = 0; i < Count; ++i)
    {
      const Eigen::Quaterniond q(this->Cameras[i].R);
      const Eigen::Vector3d& t = this->Cameras[i].t;
      images << i + 1 << ' ' << q.w() << ' ' << q.x() << ' ' << q.y() << ' ' << q.z() << ' '
             << t.x() << ' ' << t.y() << ' ' << t.z() << " 1 " << i << ".png\n\n";
    }
    this->Folder.Write("sparse/images.txt", images.str());
    this->Folder.Write("sparse/cameras.txt", "1 PINHOLE 240 180 400 400 121.3 88.6\n");
  }

  CheckedScene Check(bool check = true) const
  {
    const Scene scene = ReadScene(this->Path);
    EdgeStore edges(scene, EdgeTokenOptions());
    return CheckScene(scene, ReadSceneModel(scene), edges, MatcherOptions(),
      ClusterProposalOptions(), check, SerialFor, Progress());
  }

  TemporaryFolder Folder;
  std::vector<Camera> Cameras;
  std::string Path;
};

}

#endif
