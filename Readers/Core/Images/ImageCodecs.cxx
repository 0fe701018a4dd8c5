// SPDX-License-Identifier: BSD-3-Clause
#include "Images/ImageCodecs.h"

#include "Common/Error.h"

#include <opencv2/imgcodecs.hpp>

#ifdef FREESPACE_IMGCODECS_SONAME
#include <dlfcn.h>
#endif

namespace freespace
{

namespace
{

struct ImageCodecs
{
  cv::Mat (*read)(const cv::String&, int);
  cv::Mat (*decode)(cv::InputArray, int);
  bool (*encode)(
    const cv::String&, cv::InputArray, std::vector<unsigned char>&, const std::vector<int>&);
};

#ifdef FREESPACE_IMGCODECS_SONAME

template <typename Function>
void FindFunction(void* library, const char* name, Function& function)
{
  function = library ? reinterpret_cast<Function>(dlsym(library, name)) : nullptr;
  if (!function)
  {
    const char* fault = dlerror();
    throw Error("Images can be neither read nor written: " +
      std::string(fault ? fault : FREESPACE_IMGCODECS_SONAME " lacks a function") + ".");
  }
}

// The functions stand under the names that the C++ binary interface gives them.
ImageCodecs LoadCodecs()
{
  void* library = dlopen(FREESPACE_IMGCODECS_SONAME, RTLD_LAZY | RTLD_LOCAL);
  ImageCodecs codecs;
  FindFunction(
    library, "_ZN2cv6imreadERKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEEi", codecs.read);
  FindFunction(library, "_ZN2cv8imdecodeERKNS_11_InputArrayEi", codecs.decode);
  FindFunction(library,
    "_ZN2cv8imencodeERKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEE"
    "RKNS_11_InputArrayERSt6vectorIhSaIhEERKSB_IiSaIiEE",
    codecs.encode);
  return codecs;
}

#else

ImageCodecs LoadCodecs()
{
  return { cv::imread, cv::imdecode, cv::imencode };
}

#endif

const ImageCodecs& Codecs()
{
  static const ImageCodecs codecs = LoadCodecs(); // tried again after an error
  return codecs;
}

}

cv::Mat ReadImageFile(const std::string& file, int flags)
{
  return Codecs().read(file, flags);
}

cv::Mat DecodeImageBytes(const cv::Mat& bytes, int flags)
{
  return Codecs().decode(bytes, flags);
}

std::vector<std::uint8_t> EncodeImage(
  const std::string& extension, const cv::Mat& image, const std::vector<int>& parameters)
{
  std::vector<std::uint8_t> bytes;
  Codecs().encode(extension, image, bytes, parameters);
  return bytes;
}

}
