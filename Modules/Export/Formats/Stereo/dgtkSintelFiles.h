// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSintelFiles_h
#define dgtkSintelFiles_h

// Private to Export: files that only MPI Sintel has.

#include "dgtkExporter.h"

#include <string>

namespace dgtk::sintel
{

/// A .cam file: K in Sintel's pixels, then [R|t], float64, rows first.
std::string cameraBytes(const CameraRecord& camera);
/// Disparity as R, G, B of 8 bits: 4 R + G / 64 + B / 16384, 0 for none.
void writeDisparity(ExportSink& sink, const DatasetView& dataset, const DatasetShot& shot, const std::string& name,
  const OptionValues& options);

} // namespace dgtk::sintel

#endif
