// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExportPixels.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkText.h"

#include <jpeglib.h>

namespace dgtk
{

namespace
{
struct Damaged
{
};
void fail(j_common_ptr) { throw Damaged(); }
void ignore(j_common_ptr, int) {}

} // namespace

DecodedPixels decodeJpeg(const std::string& path, const std::string& bytes)
{
  jpeg_error_mgr errors = {};
  jpeg_decompress_struct decoder = {};
  decoder.err = jpeg_std_error(&errors);
  errors.error_exit = &fail;
  errors.emit_message = &ignore;
  jpeg_create_decompress(&decoder);
  DecodedPixels pixels;
  try
  {
    jpeg_mem_src(&decoder, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_read_header(&decoder, TRUE);
    decoder.dct_method = JDCT_ISLOW;
    jpeg_start_decompress(&decoder);
    pixels.width = static_cast<int>(decoder.output_width);
    pixels.height = static_cast<int>(decoder.output_height);
    pixels.channels = decoder.output_components;
    std::vector<unsigned char> line(std::size_t(pixels.width) * static_cast<unsigned>(pixels.channels));
    while (decoder.output_scanline < decoder.output_height)
    {
      JSAMPROW row = line.data();
      jpeg_read_scanlines(&decoder, &row, 1);
      pixels.values.insert(pixels.values.end(), line.begin(), line.end());
    }
    jpeg_finish_decompress(&decoder);
  }
  catch (const Damaged&)
  {
    jpeg_destroy_decompress(&decoder);
    throw InputError(path, "is no JPEG picture, or damaged");
  }
  jpeg_destroy_decompress(&decoder);
  return pixels;
}

DecodedPixels decodePicture(const std::string& path)
{
  const std::string extension = extensionOf(path);
  if (extension == "jpg" || extension == "jpeg")
  {
    return decodeJpeg(path, readFile(path));
  }
  DecodedPixels pixels = decodePng(path, {});
  if (readLayerFile(path).info.type == PixelType::UInt16)
  {
    for (double& value : pixels.values)
    {
      value /= 257;
    }
  }
  return pixels;
}

} // namespace dgtk
