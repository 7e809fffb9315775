// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExportJpeg.h"

#include "dgtkDatasetView.h"
#include "dgtkError.h"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <vector>

#include <jpeglib.h>

namespace dgtk
{

namespace
{
struct Failure
{
};

void fail(j_common_ptr) { throw Failure(); }
void ignore(j_common_ptr, int) {}

jpeg_error_mgr* quiet(jpeg_error_mgr& errors)
{
  jpeg_std_error(&errors);
  errors.error_exit = &fail;
  errors.emit_message = &ignore;
  return &errors;
}

/// 8-bit samples, gray or RGB.
std::vector<unsigned char> samplesOf(const ImageData& picture, int channels)
{
  const Rows& rows = picture.pixels;
  std::vector<unsigned char> samples;
  samples.reserve(std::size_t(rows.width()) * rows.height() * channels);
  for (int y = 0; y < rows.height(); ++y)
  {
    for (int x = 0; x < rows.width(); ++x)
    {
      for (int c = 0; c < channels; ++c)
      {
        const double value = valueAt(rows, x, y, c);
        samples.push_back(static_cast<unsigned char>(rows.type() == PixelType::UInt16
                                                       ? (static_cast<unsigned>(value) * 255 + 32767) / 65535
                                                       : static_cast<unsigned>(value)));
      }
    }
  }
  return samples;
}

std::string compressed(const std::vector<unsigned char>& samples, int width, int height, int channels, int quality)
{
  jpeg_error_mgr errors = {};
  jpeg_compress_struct coder = {};
  coder.err = quiet(errors);
  jpeg_create_compress(&coder);
  unsigned char* buffer = nullptr;
  unsigned long bytes = 0;
  jpeg_mem_dest(&coder, &buffer, &bytes);
  coder.image_width = static_cast<JDIMENSION>(width);
  coder.image_height = static_cast<JDIMENSION>(height);
  coder.input_components = channels;
  coder.in_color_space = channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_set_defaults(&coder);
  coder.dct_method = JDCT_ISLOW;
  jpeg_set_quality(&coder, quality, TRUE);
  coder.comp_info[0].h_samp_factor = 1;
  coder.comp_info[0].v_samp_factor = 1;
  jpeg_start_compress(&coder, TRUE);
  while (coder.next_scanline < coder.image_height)
  {
    JSAMPROW row = const_cast<JSAMPROW>(samples.data() + std::size_t(coder.next_scanline) * width * channels);
    jpeg_write_scanlines(&coder, &row, 1);
  }
  jpeg_finish_compress(&coder);
  jpeg_destroy_compress(&coder);
  const std::unique_ptr<unsigned char, void (*)(void*)> owner(buffer, &std::free);
  return { reinterpret_cast<const char*>(buffer), bytes };
}

int largestDifference(const std::string& bytes, const std::vector<unsigned char>& samples)
{
  jpeg_error_mgr errors = {};
  jpeg_decompress_struct coder = {};
  coder.err = quiet(errors);
  jpeg_create_decompress(&coder);
  jpeg_mem_src(&coder, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  jpeg_read_header(&coder, TRUE);
  coder.dct_method = JDCT_ISLOW;
  jpeg_start_decompress(&coder);
  std::vector<unsigned char> line(std::size_t(coder.output_width) * static_cast<unsigned>(coder.output_components));
  int largest = 0;
  while (coder.output_scanline < coder.output_height)
  {
    const unsigned char* expected = samples.data() + std::size_t(coder.output_scanline) * line.size();
    JSAMPROW row = line.data();
    jpeg_read_scanlines(&coder, &row, 1);
    for (std::size_t i = 0; i < line.size(); ++i)
    {
      largest = std::max(largest, std::abs(int(line[i]) - int(expected[i])));
    }
  }
  jpeg_finish_decompress(&coder);
  jpeg_destroy_decompress(&coder);
  return largest;
}
} // namespace

JpegPicture encodeJpeg(const ImageData& picture, int quality)
{
  const int width = picture.pixels.width();
  const int height = picture.pixels.height();
  if (width > JPEG_MAX_DIMENSION || height > JPEG_MAX_DIMENSION)
  {
    throw UsageError("image_format: JPEG holds at most 65500 columns and rows, found " + std::to_string(width) + "x" +
                     std::to_string(height));
  }
  const int channels = picture.pixels.channels() < 3 ? 1 : 3;
  const std::vector<unsigned char> samples = samplesOf(picture, channels);
  JpegPicture jpeg;
  jpeg.bytes = compressed(samples, width, height, channels, quality);
  jpeg.largest = largestDifference(jpeg.bytes, samples);
  return jpeg;
}

} // namespace dgtk
