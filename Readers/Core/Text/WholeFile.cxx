// SPDX-License-Identifier: BSD-3-Clause
#include "Text/WholeFile.h"

#include "Common/Error.h"

#include "Text/TextSource.h"

#include <csetjmp>
#include <cstdio>

#include <jpeglib.h>
// After jpeglib.h, which it needs.
#include <jerror.h>

namespace freespace
{

namespace
{

// Some cameras and phones pad the end of a scan with a few harmless bytes.
constexpr int mostPadding = 64;

/// Collects what libjpeg reports while it decodes a file.
struct Decoder
{
  jpeg_error_mgr errors; // the first member: libjpeg knows of no other
  std::jmp_buf afterError;
  bool isDamaged = false;
};

Decoder& DecoderOf(j_common_ptr info)
{
  return *reinterpret_cast<Decoder*>(info->err);
}

void OnError(j_common_ptr info)
{
  DecoderOf(info).isDamaged = true;
  std::longjmp(DecoderOf(info).afterError, 1);
}

void OnMessage(j_common_ptr info, int level)
{
  const jpeg_error_mgr& message = *info->err;
  if (level < 0) // a warning
  {
    const bool isPadding =
      message.msg_code == JWRN_EXTRANEOUS_DATA && message.msg_parm.i[0] <= mostPadding;
    DecoderOf(info).isDamaged = DecoderOf(info).isDamaged || !isPadding;
  }
}

// Decodes the coefficients, which is about half of the work for the pixels.
bool IsWhole(const std::string& bytes)
{
  Decoder decoder;
  jpeg_decompress_struct info;
  info.err = jpeg_std_error(&decoder.errors);
  decoder.errors.error_exit = OnError;
  decoder.errors.emit_message = OnMessage;
  if (setjmp(decoder.afterError) == 0)
  {
    jpeg_create_decompress(&info);
    jpeg_mem_src(&info, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_read_header(&info, TRUE);
    jpeg_read_coefficients(&info);
    jpeg_finish_decompress(&info);
  }
  jpeg_destroy_decompress(&info);
  return !decoder.isDamaged;
}

}

void CheckWholeJPEG(const std::string& fileName)
{
  const std::string bytes = ReadWholeFile(fileName);
  if (bytes.compare(0, 3, "\xFF\xD8\xFF") == 0 && !IsWhole(bytes))
  {
    throw Error("Cannot read the image " + fileName + ": it is damaged or truncated.");
  }
}

}
