// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSintelFiles.h"

#include "dgtkExportPng.h"
#include "dgtkLayerFile.h"

namespace dgtk::sintel
{

std::string cameraBytes(const CameraRecord& camera)
{
  constexpr float magic = 202021.25F;
  const Eigen::Matrix3d K = intrinsicsOf(camera, PixelCentre::Integer);
  std::string bytes;
  putLittle(bytes, magic);
  for (int i = 0; i < 9; ++i)
  {
    putLittle(bytes, K(i / 3, i % 3));
  }
  for (int i = 0; i < 12; ++i)
  {
    putLittle(bytes, i % 4 == 3 ? camera.t[i / 4] : camera.R(i / 4, i % 4));
  }
  return bytes;
}

void writeDisparity(ExportSink& sink, const DatasetView& dataset, const DatasetShot& shot, const std::string& name,
  const OptionValues& options)
{
  LinearCode code;
  code.scale = 1.0 / 16384;
  code.most = (1U << 24) - 1;
  code.unit = "px";
  ClassedRows rows(dataset, shot, "disparity");
  CodeCounter counter(code, "disparity");
  PngEncoder::Header header;
  header.width = rows.info().width;
  header.height = rows.info().height;
  writePng(sink, name, { "disparity", &shot, code.encoding("sintel-disparity") }, header,
    [&](int, unsigned char* row)
    {
      rows.next();
      for (int x = 0; x < header.width; ++x)
      {
        const std::uint32_t value = counter(rows.at(x));
        row[3 * x] = static_cast<unsigned char>(value >> 16);
        row[3 * x + 1] = static_cast<unsigned char>(value >> 8);
        row[3 * x + 2] = static_cast<unsigned char>(value);
      }
    });
  counter.report(sink, shot, options);
}

} // namespace dgtk::sintel
