// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkReadTexts_h
#define dgtkReadTexts_h

// Private to Verification: what readers of formats with plain texts share.

#include "dgtkExportJudge.h"

#include "dgtkTrackDocuments.h"

#include <map>
#include <string>
#include <vector>

namespace dgtk
{

/// Words of the lines of a text, lines that begin with '#' left out. A line that ends with a space, or has two in a
/// row, has empty words.
std::vector<std::vector<std::string>> linesOf(const std::string& path);
/// A number, or an InputError that names the file and the line (from 1, comments not counted).
double numberIn(const std::string& path, std::size_t line, const std::string& word);
/// "KEY: 1 2 3" a line; lines without a colon and empty ones are left out.
std::map<std::string, std::vector<double>> keyedNumbers(const std::string& path);
/// The numbers of a key, that many; throws InputError.
const std::vector<double>& numbersOf(
  const std::map<std::string, std::vector<double>>& all, const std::string& path, const std::string& key, int count);

/// The numbers of all words of a line, that many; throws InputError.
std::vector<double> numbersIn(
  const std::string& path, std::size_t line, const std::vector<std::string>& words, std::size_t count);
/// A number with zeros before it.
std::string digitsOf(const std::string& number, std::size_t digits);
inline std::string digitsOf(std::size_t number, std::size_t digits) { return digitsOf(std::to_string(number), digits); }
/// Nine numbers row by row; rows lie `step` numbers apart.
Eigen::Matrix3d matrixOf(const std::vector<double>& numbers, std::size_t step = 3);
/// K of pixels whose centres are whole numbers as the judge wants it.
Eigen::Matrix3d fromWholeCentres(Eigen::Matrix3d K);
/// Of Hamilton's quaternion x, y, z, w.
Eigen::Matrix3d rotationOf(const Eigen::Vector4d& q);

/// Metres of a scene unit: as the export was asked for, or as the dataset says. Throws InputError for none.
double metresOf(const ExportedFrom& source);
/// The dataset's points of tracks; those on objects that only some frames of the export's pictures have are not static.
std::vector<TrackPoint> trackPointsOf(const ExportedFrom& source);
/// Files of an export below a folder with an extension.
std::vector<const ExportedFile*> filesIn(
  const ExportedFrom& source, const std::string& folder, const std::string& extension);
/// The picture of a name; says so and gives null where export.json has none.
const ExportedName* pictureOf(ExportJudge& judge, const std::string& file, const std::string& name);
/// The name of a file without folders and extension.
std::string stemOf(const std::string& path);

} // namespace dgtk

#endif
