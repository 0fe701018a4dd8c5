// SPDX-License-Identifier: BSD-3-Clause
#ifndef PictureComparison_h
#define PictureComparison_h

#include <vtkErrorCode.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPNGWriter.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

/// How two pictures of one size differ. VTK's own test metric lets a sphere pass for one with half
/// as many facets; these two do not.
struct PictureDifference
{
  double mean = 255.0; ///< absolute difference of a channel, 0 to 255
  double share = 1.0;  ///< of the pixels that differ by more than 16 in a channel
};

/// The worst of differences when the sizes or channels are not the same.
inline PictureDifference ComparePictures(vtkImageData* a, vtkImageData* b)
{
  int sizeA[3];
  int sizeB[3];
  a->GetDimensions(sizeA);
  b->GetDimensions(sizeB);
  const int channels = a->GetNumberOfScalarComponents();
  if (!std::equal(sizeA, sizeA + 3, sizeB) || channels != b->GetNumberOfScalarComponents())
  {
    return PictureDifference();
  }
  const auto* valuesA = static_cast<const unsigned char*>(a->GetScalarPointer());
  const auto* valuesB = static_cast<const unsigned char*>(b->GetScalarPointer());
  const std::size_t pixels = std::size_t(sizeA[0]) * sizeA[1];
  double sum = 0;
  std::size_t differing = 0;
  for (std::size_t i = 0; i < pixels; ++i)
  {
    int greatest = 0;
    for (int channel = 0; channel < channels; ++channel)
    {
      const int difference = std::abs(*valuesA++ - *valuesB++);
      greatest = std::max(greatest, difference);
      sum += difference;
    }
    differing += greatest > 16;
  }
  return { sum / (pixels * channels), double(differing) / pixels };
}

/// Whether two pictures may come from the same scene and two versions of a software rasterizer.
inline bool AreAlike(const PictureDifference& difference)
{
  return difference.mean < 0.25 && difference.share < 0.002;
}

/// Holds a picture against FREESPACE_BASELINES/NAME.png. On failure the picture is left in the
/// current folder; it becomes the baseline by being copied, after somebody has looked at it.
inline void ExpectBaseline(vtkImageData* picture, const std::string& name)
{
  const std::string file = std::string(FREESPACE_BASELINES) + "/" + name + ".png";
  vtkNew<vtkPNGReader> reader;
  PictureDifference difference;
  if (std::filesystem::exists(file))
  {
    reader->SetFileName(file.c_str());
    reader->Update();
    difference = ComparePictures(picture, reader->GetOutput());
  }
  if (!AreAlike(difference))
  {
    const std::string seen = name + ".png";
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputData(picture);
    writer->SetFileName(seen.c_str());
    writer->Write();
    ADD_FAILURE() << std::filesystem::absolute(seen) << " is not " << file << ": mean difference "
                  << difference.mean << ", share of differing pixels " << difference.share;
  }
}

#endif
