// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCompare.h"

#include "dgtkDatasetDocuments.h"
#include "dgtkError.h"
#include "dgtkFolder.h"
#include "dgtkFolderContents.h"
#include "dgtkInputFile.h"
#include "dgtkJournal.h"
#include "dgtkJsonText.h"
#include "dgtkLayerReader.h"
#include "dgtkLdi.h"
#include "dgtkPixelValues.h"
#include "dgtkText.h"
#include "dgtkUtf8.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <set>

namespace dgtk
{

namespace
{
namespace fs = std::filesystem;

constexpr std::size_t blockBytes = std::size_t(4) << 20;

bool sameContents(const std::string& a, const std::string& b)
{
  const InputFile first(a);
  const InputFile second(b);
  if (first.size() != second.size())
  {
    return false;
  }
  std::vector<char> one(blockBytes);
  std::vector<char> other(blockBytes);
  for (std::uint64_t at = 0; at < first.size(); at += blockBytes)
  {
    const std::size_t n = static_cast<std::size_t>(std::min<std::uint64_t>(blockBytes, first.size() - at));
    first.read(at, one.data(), n);
    second.read(at, other.data(), n);
    if (std::memcmp(one.data(), other.data(), n) != 0)
    {
      return false;
    }
  }
  return true;
}

double differenceOf(double a, double b)
{
  if (a == b || (std::isnan(a) && std::isnan(b)))
  {
    return 0;
  }
  const double difference = std::abs(a - b);
  return std::isnan(difference) ? std::numeric_limits<double>::infinity() : difference;
}

template <typename A, typename B>
void compareValues(const Rows& a, const Rows& b, CompareResult& result)
{
  const int channels = a.channels();
  const double limit = result.tolerance ? result.tolerance->value : 0;
  for (int y = a.y(); y < a.y() + a.height(); ++y)
  {
    const A* left = a.row<A>(y);
    const B* right = b.row<B>(y);
    for (int x = 0; x < a.width(); ++x, left += channels, right += channels)
    {
      double largest = 0;
      for (int c = 0; c < channels; ++c)
      {
        largest = std::max(largest, differenceOf(static_cast<double>(left[c]), static_cast<double>(right[c])));
      }
      if (largest > 0)
      {
        if (result.differing++ == 0)
        {
          result.firstX = x;
          result.firstY = y;
        }
        if (largest > result.largest)
        {
          result.largest = largest;
          result.worstX = x;
          result.worstY = y;
        }
        result.beyond += largest > limit ? 1 : 0;
      }
    }
  }
}

void compareRows(const Rows& a, const Rows& b, CompareResult& result)
{
  if (a.type() == b.type() && std::memcmp(a.data(), b.data(), a.bytes()) == 0)
  {
    return;
  }
  withPixelType(a.type(), [&](auto one)
    { withPixelType(b.type(), [&](auto other) { compareValues<decltype(one), decltype(other)>(a, b, result); }); });
}

std::string shapeOf(const ImageInfo& info)
{
  return std::to_string(info.width) + " x " + std::to_string(info.height) + " pixels of " +
         std::to_string(info.channels) + " x " + nameOf(info.type);
}

void comparePixels(const std::string& a, const std::string& b, CompareResult& result)
{
  const std::unique_ptr<RowReader> left = openLayerTable(a);
  const std::unique_ptr<RowReader> right = openLayerTable(b);
  const ImageInfo& one = left->info();
  const ImageInfo& other = right->info();
  if (one.width != other.width || one.height != other.height || one.channels != other.channels)
  {
    result.problem = shapeOf(one) + " against " + shapeOf(other);
    return;
  }
  const std::size_t rowBytes = std::size_t(one.pixelBytes() / std::uint64_t(std::max(one.height, 1)));
  const int rows = static_cast<int>(std::max<std::size_t>(1, blockBytes / std::max<std::size_t>(1, rowBytes)));
  for (int y = 0; y < one.height; y += rows)
  {
    compareRows(left->read(rows), right->read(rows), result);
  }
  result.pixels = std::uint64_t(one.width) * static_cast<std::uint64_t>(one.height);
  result.equal = result.tolerance ? result.tolerance->allows(result.beyond, result.pixels) : result.differing == 0;
}

/// The files of a dataset by its manifest, else those below the folder.
std::set<std::string> filesOf(const std::string& folder)
{
  requireFinished(folder);
  std::set<std::string> names;
  std::error_code code;
  const fs::path manifest = fs::path(folder) / manifestName;
  if (fs::exists(manifest, code))
  {
    for (const DatasetFile& file : readManifestIn(folder).files)
    {
      names.insert(file.path);
    }
    return names;
  }
  fs::recursive_directory_iterator it(folder, code);
  for (const fs::recursive_directory_iterator end; !code && it != end; it.increment(code))
  {
    const std::string name = it->path().lexically_relative(folder).generic_string();
    if ((it->is_symlink(code) || it->is_regular_file(code)) && name != journalName)
    {
      names.insert(name);
    }
  }
  if (code)
  {
    throw InputError(folder, "cannot be read: " + code.message());
  }
  return names;
}

std::vector<std::string> manifestDifferences(const std::string& a, const std::string& b)
{
  const fs::path paths[] = { fs::path(a) / manifestName, fs::path(b) / manifestName };
  std::error_code code;
  if (!fs::exists(paths[0], code) || !fs::exists(paths[1], code))
  {
    return {};
  }
  const Manifest one = readManifest(paths[0].string());
  const Manifest other = readManifest(paths[1].string());
  std::vector<std::string> names;
  if (one.version != other.version)
  {
    names.emplace_back("version");
  }
  std::map<std::string, std::string> left(one.request.begin(), one.request.end());
  std::map<std::string, std::string> right(other.request.begin(), other.request.end());
  std::set<std::string> keys;
  for (const auto* request : { &left, &right })
  {
    for (const auto& entry : *request)
    {
      keys.insert(entry.first);
    }
  }
  for (const std::string& key : keys)
  {
    if (left.count(key) != right.count(key) || left[key] != right[key])
    {
      names.push_back("request: " + key);
    }
  }
  return names;
}

/// Whether there are ids or classes among the values: of tracks in a column, of coverage beside each share.
bool hasNames(const LayerSpec& spec)
{
  const bool ranks = spec.meaning == Meaning::Coverage && spec.channels > 1;
  return ranks || spec.unit == "id" || spec.unit.find("class") != std::string::npos;
}

/// The layers of a dataset's files; refuses tolerances that would say nothing about them.
std::map<std::string, std::string> layersOf(
  const std::string& folder, const std::map<std::string, CompareTolerance>& tolerances)
{
  std::map<std::string, std::string> layers; // by file
  if (tolerances.empty())
  {
    return layers;
  }
  const Manifest manifest = readManifest((fs::path(folder) / manifestName).string());
  std::set<std::string> known;
  for (const DatasetFile& file : manifest.files)
  {
    layers[file.path] = file.layer;
    known.insert(file.layer);
  }
  for (const auto& [layer, tolerance] : tolerances)
  {
    if (layer.empty() || known.count(layer) == 0)
    {
      known.erase("");
      throw UsageError("a tolerance for " + quoted(layer) + ": " + folder + " has no such layer (it has " +
                       joined({ known.begin(), known.end() }) + ')');
    }
    const auto isImage = [files = Folder(folder), &name = layer](const DatasetFile& file)
    {
      return file.layer == name && isLayerFile(file.path) &&
             !(files.look(file.path) == EntryKind::File && isDeepExr(files.pathOf(file.path)));
    };
    if (std::none_of(manifest.files.begin(), manifest.files.end(), isImage))
    {
      throw UsageError("a tolerance for " + layer + ": its files are no images");
    }
    const auto names = [&name = layer](const LayerRecord& record)
    { return record.spec.name == name && hasNames(record.spec); };
    if (tolerance.value > 0 && std::any_of(manifest.layers.begin(), manifest.layers.end(), names))
    {
      throw UsageError("a tolerance for " + layer +
                       ": its values are names, or some of them, none is nearer than another (expected pixels or a "
                       "share)");
    }
  }
  return layers;
}

std::string toleranceText(const CompareResult& result)
{
  const CompareTolerance& tolerance = *result.tolerance;
  std::string limits = tolerance.pixels || !tolerance.share ? std::to_string(tolerance.pixels.value_or(0)) : "";
  if (tolerance.share)
  {
    limits += (limits.empty() ? "" : " and ") + shortest(*tolerance.share) + " of all";
  }
  return std::string(result.equal ? "within" : "beyond") + " the tolerance" +
         (result.layer.empty() ? "" : " of " + result.layer) + " (" + std::to_string(result.beyond) +
         (tolerance.value > 0 ? " by more than " + shortest(tolerance.value) : "") + ", at most " + limits + ')';
}

JsonObject members(const CompareResult& result, int indent)
{
  JsonObject object(indent);
  object.text("path", result.path)
    .boolean("equal", result.equal)
    .boolean("same_bytes", result.sameBytes)
    .text("problem", result.problem)
    .integer("pixels", static_cast<std::int64_t>(result.pixels))
    .integer("differing", static_cast<std::int64_t>(result.differing))
    .number("largest", result.largest);
  if (result.differing > 0)
  {
    object.raw("first", "[" + std::to_string(result.firstX) + ", " + std::to_string(result.firstY) + "]")
      .raw("worst", "[" + std::to_string(result.worstX) + ", " + std::to_string(result.worstY) + "]");
  }
  if (result.tolerance)
  {
    object.text("layer", result.layer).integer("beyond", static_cast<std::int64_t>(result.beyond));
  }
  return object;
}

/// None where it is no picture that a dataset's layers have: one with a palette, of an export or of a model.
std::optional<std::uint64_t> pixelsOf(const std::string& file)
{
  try
  {
    const std::unique_ptr<RowReader> reader = openLayerTable(file);
    return std::uint64_t(reader->info().width) * static_cast<std::uint64_t>(reader->info().height);
  }
  catch (const InputError&)
  {
    std::string head(4, '\0');
    std::ifstream(file, std::ios::binary).read(head.data(), std::streamsize(head.size()));
    if (head == "\x89PNG" || head == "\x93NUM")
    {
      return std::nullopt;
    }
    throw;
  }
}
} // namespace

bool CompareTolerance::allows(std::uint64_t counted, std::uint64_t all) const
{
  const bool few = counted <= this->pixels.value_or(this->share ? counted : 0);
  // As a quotient, which is the number that people write: 29 of 100 are 0.29.
  return few && (!this->share || counted == 0 || double(counted) / double(all) <= *this->share);
}

CompareResult compareFiles(const std::string& a, const std::string& b, const std::optional<CompareTolerance>& tolerance)
{
  CompareResult result;
  result.tolerance = tolerance;
  result.sameBytes = sameContents(a, b);
  const bool images = isLayerFile(a) && isLayerFile(b) && !isDeepExr(a) && !isDeepExr(b);
  if (images && result.sameBytes)
  {
    result.pixels = pixelsOf(a).value_or(0);
  }
  else if (images && (pixelsOf(a) || pixelsOf(b))) // what cannot be read at all is the other's bytes or not
  {
    comparePixels(a, b, result);
    return result;
  }
  result.equal = result.sameBytes;
  result.problem = result.sameBytes ? "" : "the bytes differ";
  return result;
}

DatasetComparison compareDatasets(
  const std::string& a, const std::string& b, const std::map<std::string, CompareTolerance>& tolerances)
{
  const std::map<std::string, std::string> layers = layersOf(a, tolerances);
  const std::set<std::string> left = filesOf(a);
  const std::set<std::string> right = filesOf(b);
  std::set<std::string> all = left;
  all.insert(right.begin(), right.end());
  DatasetComparison comparison;
  comparison.equal = true;
  comparison.files = all.size();
  for (const std::string& name : all)
  {
    const Folder folders[] = { Folder(a), Folder(b) };
    const bool there[] = { folders[0].look(name) != EntryKind::Nothing, folders[1].look(name) != EntryKind::Nothing };
    CompareResult result;
    if (there[0] && there[1])
    {
      const auto layer = layers.find(name);
      const auto tolerance = layer == layers.end() ? tolerances.end() : tolerances.find(layer->second);
      const bool tolerant = tolerance != tolerances.end();
      result = compareFiles(
        folders[0].fileAt(name), folders[1].fileAt(name), tolerant ? std::optional(tolerance->second) : std::nullopt);
      result.layer = tolerant ? tolerance->first : "";
    }
    else
    {
      result.problem = "is missing in " + (there[0] ? b : there[1] ? a : a + " and " + b);
    }
    result.path = name;
    comparison.equal = comparison.equal && result.equal;
    if (!result.sameBytes)
    {
      comparison.differing.push_back(result);
    }
  }
  comparison.manifest = manifestDifferences(a, b);
  return comparison;
}

std::string describe(const CompareResult& result)
{
  const std::string name = result.path.empty() ? "" : printable(result.path) + ": ";
  if (!result.problem.empty())
  {
    return name + printable(result.problem);
  }
  if (result.differing == 0)
  {
    return name + (result.sameBytes ? "identical" : "the same pixels in other bytes");
  }
  const auto place = [](int x, int y) { return "(" + std::to_string(x) + ", " + std::to_string(y) + ")"; };
  return name + std::to_string(result.differing) + " of " + std::to_string(result.pixels) +
         " pixels differ, the first at " + place(result.firstX, result.firstY) + "; largest difference " +
         shortest(result.largest) + " at " + place(result.worstX, result.worstY) +
         (result.tolerance ? "; " + toleranceText(result) : "");
}

std::string compareJson(const CompareResult& result) { return members(result, 2).block() + "\n"; }

std::string compareJson(const DatasetComparison& result)
{
  JsonArray rows(4);
  for (const CompareResult& row : result.differing)
  {
    rows.add(members(row, 6).line());
  }
  JsonArray manifest(4);
  for (const std::string& name : result.manifest)
  {
    manifest.add(jsonString(name));
  }
  return JsonObject(2)
           .boolean("equal", result.equal)
           .integer("files", static_cast<std::int64_t>(result.files))
           .raw("differing", rows.block())
           .raw("manifest", manifest.block())
           .block() +
         "\n";
}

} // namespace dgtk
