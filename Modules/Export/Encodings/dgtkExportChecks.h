// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkExportChecks_h
#define dgtkExportChecks_h

// Private to Export: what several formats cannot say, and how they choose cameras. Each throws a UsageError that begins
// with the format's name.

#include "dgtkExporter.h"

#include <string>
#include <vector>

namespace dgtk
{

/// The format's readers look for .png.
void requirePng(const OptionValues& options, const std::string& format);
/// The format has no parts.
void requireWhole(const OptionValues& options, const std::string& format);
/// No value of a layer is without a code, where such are to be refused (option out_of_range); `place`: of which values.
void requireCodes(const LayerRounding& layer, const OptionValues& options, const std::string& place);
/// Of a whole export: no layer is without a code at all its values.
void requireSomeCodes(const std::vector<LayerRounding>& layers, const std::string& format);
/// The dataset has a file at least of every layer.
void requireLayers(const DatasetView& dataset, const ExportNeeds& needs, const std::string& format);
/// A picture has a file of the layer with one of the extensions; every picture has.
void requireFile(const DatasetView& dataset, const DatasetShot& shot, const std::string& layer,
  const std::string& format, const std::vector<std::string>& extensions = {});
void requireEverywhere(const DatasetView& dataset, const std::string& layer, const std::string& format,
  const std::vector<std::string>& extensions = {});
/// The format has one matrix, and one size, for all frames of a camera.
void requireFixedIntrinsics(const DatasetView& dataset, const std::string& format);
/// The frames of every camera follow each other without a gap.
void requireConsecutive(const DatasetView& dataset, const std::string& format);

/// A camera, and the right one of its rectified pair where it has one.
struct CameraEyes
{
  std::string left;
  std::string right; ///< "" for none
  std::string name;  ///< of both: the left one as SafeNames has it
};
/// Every camera once. A camera with several partners has the nearest one.
std::vector<CameraEyes> eyesOf(const DatasetView& dataset);
/// Pairs only of cameras whose disparities are those to each other, where the dataset has some.
std::vector<CameraEyes> eyesOfDisparities(const DatasetView& dataset);
/// The format has one matrix for both cameras of a pair.
void requireOneMatrix(const DatasetView& dataset, const CameraEyes& pair, const std::string& format);
/// The same, pairs only; at least one.
std::vector<CameraEyes> pairsOf(const DatasetView& dataset, const std::string& format);

/// Metres between the cameras of a rectified pair at one frame.
double baselineMetres(const DatasetView& dataset, const DatasetShot& left, const DatasetShot& right);
/// Numbers as their shortest texts, one space between.
std::string numbersLine(const std::vector<double>& numbers);
/// The same of all numbers of matrixRows().
std::string matrixLine(const Rigid3& pose);
/// A text in double quotes, as JSON and YAML read it: line breaks of Unicode, which YAML folds, as \uXXXX.
std::string quotedText(const std::string& text);
/// A number with leading zeros.
std::string padded(int number, int digits);

} // namespace dgtk

#endif
