// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkKitti.h"

#include "dgtkClassedRows.h"
#include "dgtkExportChecks.h"
#include "dgtkLayerFile.h"
#include "dgtkText.h"

#include <cmath>

namespace dgtk::kitti
{

LinearCode code256(double factor, const std::string& unit)
{
  LinearCode code;
  code.factor = factor;
  code.scale = 1.0 / 256;
  code.unit = unit;
  return code;
}

namespace
{
constexpr std::uint32_t noCode = 65536;

LinearCode flowCode()
{
  LinearCode code;
  code.scale = 1.0 / 64;
  code.offset = 32768;
  code.least = 0;
  code.nothing = noCode;
  code.unit = "px";
  return code;
}

void putFlow(double u, double v, CodeCounter& counter, unsigned char* pixel)
{
  static const LinearCode code = flowCode();
  std::uint32_t first = noCode;
  std::uint32_t second = noCode;
  if (std::isfinite(u) && std::isfinite(v))
  {
    first = code.of(u);
    second = code.of(v);
    counter.count(first != noCode && second != noCode);
  }
  const bool valid = first != noCode && second != noCode;
  putBig16(pixel, valid ? first : 0);
  putBig16(pixel + 2, valid ? second : 0);
  putBig16(pixel + 4, valid ? 1 : 0);
}
} // namespace

void writeFlow(ExportSink& sink, const DatasetView& dataset, const DatasetShot& shot, const std::string& layer,
  const std::string& name, const WantedClasses& classes, const OptionValues& options)
{
  ClassedRows rows(dataset, shot, layer, classes);
  PngEncoder::Header header;
  header.width = rows.info().width;
  header.height = rows.info().height;
  header.bitDepth = 16;
  ExportedPixels pixels{ layer, &shot, flowCode().encoding("kitti-flow") };
  addClasses(pixels.encoding, layer, classes);
  CodeCounter counter(flowCode(), layer);
  writePng(sink, name, pixels, header,
    [&](int, unsigned char* row)
    {
      rows.next();
      for (int x = 0; x < header.width; ++x)
      {
        putFlow(rows.at(x, 0), rows.at(x, 1), counter, row + 6 * std::size_t(x));
      }
    });
  counter.report(sink, shot, options);
  rows.reportGone(sink, 1);
}

namespace
{
std::vector<double> rowMajor(const Eigen::Matrix3d& m)
{
  return { m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2) };
}

std::string cameraBlock(const std::string& number, const CameraRecord& camera, double offset)
{
  const std::string size = numbersLine({ double(camera.width), double(camera.height) });
  const std::string K = numbersLine(rowMajor(intrinsicsOf(camera, PixelCentre::Integer)));
  const std::string turn = numbersLine(rowMajor(Eigen::Matrix3d::Identity()));
  return "S_" + number + ": " + size + "\nK_" + number + ": " + K + "\nD_" + number + ": 0 0 0 0 0\nR_" + number +
         ": " + turn + "\nT_" + number + ": " + numbersLine({ offset, 0, 0 }) + "\nS_rect_" + number + ": " + size +
         "\nR_rect_" + number + ": " + turn + "\nP_rect_" + number + ": " + projectionLine(camera, offset) + '\n';
}
} // namespace

std::string projectionLine(const CameraRecord& camera, double offset)
{
  Eigen::Matrix<double, 3, 4> P;
  P.leftCols<3>() = intrinsicsOf(camera, PixelCentre::Integer);
  P.col(3) = P.col(0) * offset;
  std::vector<double> numbers(12);
  Eigen::Map<Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(numbers.data()) = P;
  return numbersLine(numbers);
}

std::string camToCam(const CameraRecord& left, const CameraRecord* right, double baseline)
{
  const CameraRecord& second = right ? *right : left;
  std::string text;
  for (const char* number : { "00", "01", "02", "03" })
  {
    const bool isRight = number[1] == '1' || number[1] == '3';
    text += cameraBlock(number, isRight ? second : left, isRight && right ? -baseline : 0);
  }
  return text;
}

std::string scannerLine() { return numbersLine({ 0, -1, 0, 0, 0, 0, -1, 0, 1, 0, 0, 0 }); }

TextPairs conventions(const DatasetView& dataset)
{
  return { { "pixel_centre", "integer: cx and cy are 0.5 less" }, { "axes", "x right, y down, z forward" },
    { "metres_per_unit", shortest(dataset.metres()) } };
}

} // namespace dgtk::kitti
