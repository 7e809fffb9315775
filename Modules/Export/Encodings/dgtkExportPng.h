// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkExportPng_h
#define dgtkExportPng_h

// Private to Export: pictures and coded values as other formats have them.

#include "dgtkClassedRows.h"
#include "dgtkExporter.h"
#include "dgtkPngEncoder.h"

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace dgtk
{

/// A PNG whose rows, of PngEncoder::rowBytes() bytes, `fill` makes from top to bottom.
void writePng(ExportSink& sink, const std::string& name, const ExportedPixels& pixels, const PngEncoder::Header& header,
  const std::function<void(int y, unsigned char* row)>& fill);

/// "png" or "jpg", after the option image_format.
std::string pictureExtension(const OptionValues& options);
/// The picture of a shot, in the format of pictureExtension(): the dataset's file itself where it is a PNG, else
/// JPEG, which is decoded again to say how far it is off. `layer`: "color", "color_rgba", ... Throws UsageError for a
/// dataset whose pictures are no PNG.
void writePicture(ExportSink& sink, const DatasetView& dataset, const DatasetShot& shot, const std::string& layer,
  const std::string& name, const OptionValues& options);

/// A picture as writePicture() would write it.
struct EncodedPicture
{
  std::string bytes;
  LayerRounding rounding;
};
/// For containers of pictures. Throws InputError for a file that is not as the manifest says.
EncodedPicture encodePicture(
  const DatasetView& dataset, const DatasetShot& shot, const std::string& layer, const OptionValues& options);

/// Numbers as whole codes: a value v becomes round(v factor / scale + offset) where that lies in [least, most].
struct LinearCode
{
  double factor = 1; ///< of the format's unit in the layer's: 1000 for millimetres of metres
  double scale = 1;  ///< of a code, in the format's unit; a power of two or a decimal as the format says
  double offset = 0;
  std::uint32_t least = 1;
  std::uint32_t most = 65535;
  std::uint32_t nothing = 0; ///< not in [least, most]
  std::string unit = {};     ///< the format's

  /// The code of a value; `nothing` for what is not finite or out of range.
  std::uint32_t of(double value) const;
  PixelEncoding encoding(const std::string& kind = "linear") const;
};

/// Counts values and those without a code over the pixels of a file.
class CodeCounter
{
public:
  CodeCounter(const LinearCode& code, const std::string& layer)
    : Code(code)
    , Layer(layer)
  {
  }
  /// The code; a value that is not finite is none.
  std::uint32_t operator()(double value);
  /// Of a pixel of several values: whether all have a code.
  void count(bool hasCode)
  {
    ++this->Values;
    this->Without += hasCode ? 0 : 1;
  }
  /// Throws UsageError where values without a code are to be refused (option out_of_range).
  void report(ExportSink& sink, const DatasetShot& shot, const OptionValues& options) const;

private:
  LinearCode Code;
  std::string Layer;
  std::uint64_t Values = 0;
  std::uint64_t Without = 0;
};

/// A one-channel layer as 16-bit gray PNG; where classes are wanted, pixels of these only. `row` is told every row's
/// codes.
void writeCodedPng(ExportSink& sink, const DatasetView& dataset, const DatasetShot& shot, const std::string& layer,
  const std::string& name, const LinearCode& code, const OptionValues& options, const WantedClasses& classes = {},
  const std::function<void(int y, const std::vector<std::uint32_t>& codes)>& row = {});

/// How a code stands in a PNG: 8 bits, or 24 bits as R, G, B.
enum class IdBytes
{
  Gray,
  RedHigh,
  RedLow
};
/// A code for each id or class of a layer; ids without one are 0.
void writeIdPng(ExportSink& sink, const DatasetView& dataset, const DatasetShot& shot, const std::string& layer,
  const std::string& name, const std::map<std::uint32_t, std::uint32_t>& codes, IdBytes bytes = IdBytes::Gray);

} // namespace dgtk

#endif
