// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExportChecks.h"

#include "dgtkError.h"
#include "dgtkExport.h"
#include "dgtkExportPng.h"
#include "dgtkText.h"
#include "dgtkUtf8.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace dgtk
{

void requirePng(const OptionValues& options, const std::string& format)
{
  if (pictureExtension(options) != "png")
  {
    throw UsageError(
      "image_format: the pictures of " + format + " are PNG (expected png, found " + pictureExtension(options) + ')');
  }
}

void requireWhole(const OptionValues& options, const std::string& format)
{
  if (!exported::split().of(options).empty())
  {
    throw UsageError("split: " + format + " has no parts");
  }
}

void requireCodes(const LayerRounding& layer, const OptionValues& options, const std::string& place)
{
  if (layer.withoutCode > 0 && exported::outOfRange().of(options) == "refuse")
  {
    throw UsageError("out_of_range: " + std::to_string(layer.withoutCode) + " values of layer " + layer.layer + " (" +
                     place + ") have no code in the format");
  }
}

void requireSomeCodes(const std::vector<LayerRounding>& layers, const std::string& format)
{
  for (const LayerRounding& one : layers)
  {
    if (one.values > 0 && one.withoutCode == one.values)
    {
      throw UsageError(format + ": none of the " + std::to_string(one.values) + " values of layer " + one.layer +
                       " has a code in the format (expected some within its range)");
    }
  }
}

namespace
{
/// Whether some picture of the whole dataset has a file of the layer.
bool hasSome(const Manifest& manifest, const std::string& layer)
{
  return std::any_of(manifest.layers.begin(), manifest.layers.end(),
           [&](const LayerRecord& one) { return one.spec.name == layer; }) &&
         std::none_of(manifest.empty.begin(), manifest.empty.end(),
           [&](const EmptyRecord& one) { return one.layer == layer && one.pictures == one.of; });
}
} // namespace

void requireLayers(const DatasetView& dataset, const ExportNeeds& needs, const std::string& format)
{
  std::vector<std::string> missing;
  std::copy_if(needs.layers.begin(), needs.layers.end(), std::back_inserter(missing),
    [&](const std::string& layer) { return !dataset.has(layer); });
  const bool elsewhere = std::all_of(
    missing.begin(), missing.end(), [&](const std::string& layer) { return hasSome(dataset.manifest(), layer); });
  if (!missing.empty() && elsewhere)
  {
    throw UsageError(format + ": no picture that is exported has layers that the format needs: " + joined(missing) +
                     " (the dataset has them of other cameras or frames; a last frame is followed by none)");
  }
  if (!missing.empty())
  {
    throw UsageError(format + ": the dataset lacks layers that the format needs: " + joined(missing) + " (it needs " +
                     joined(needs.layers) + ")");
  }
}

void requireFile(const DatasetView& dataset, const DatasetShot& shot, const std::string& layer,
  const std::string& format, const std::vector<std::string>& extensions)
{
  if (dataset.file(shot, layer, extensions).empty())
  {
    const bool picture = extensions.empty() && !dataset.file(shot, layer, { "png" }).empty();
    throw UsageError(format + ": camera " + quoted(shot.name()) + " has no file of layer " + layer +
                     (extensions.empty() ? "" : " as ." + joined(extensions, " or .")) + " at frame " +
                     std::to_string(shot.frame()) +
                     (picture ? " but a picture for people: its values are to be rendered as npy" : ""));
  }
}

void requireEverywhere(const DatasetView& dataset, const std::string& layer, const std::string& format,
  const std::vector<std::string>& extensions)
{
  for (const DatasetShot& shot : dataset.shots())
  {
    requireFile(dataset, shot, layer, format, extensions);
  }
}

void requireFixedIntrinsics(const DatasetView& dataset, const std::string& format)
{
  std::map<std::string, const DatasetShot*> firsts;
  for (const DatasetShot& shot : dataset.shots())
  {
    const CameraRecord& first = firsts.emplace(shot.name(), &shot).first->second->camera;
    const CameraRecord& camera = shot.camera;
    if (camera.K != first.K || camera.width != first.width || camera.height != first.height)
    {
      throw UsageError(format + ": camera " + quoted(shot.name()) + " has another matrix at frame " +
                       std::to_string(shot.frame()) + " than at frame " + std::to_string(first.frame) +
                       ", which the format cannot say");
    }
  }
}

void requireConsecutive(const DatasetView& dataset, const std::string& format)
{
  for (const std::string& camera : dataset.cameras())
  {
    const std::vector<const DatasetShot*> shots = dataset.shotsOf(camera);
    if (shots.back()->frame() - shots.front()->frame() + 1 != static_cast<int>(shots.size()))
    {
      throw UsageError(
        format + ": the frames of camera " + quoted(camera) + " are not consecutive, but flow leads to the next one");
    }
  }
}

namespace
{
std::vector<CameraEyes> eyesOf(const DatasetView& dataset, std::vector<RectifiedPair> pairs)
{
  std::sort(pairs.begin(), pairs.end(),
    [](const RectifiedPair& a, const RectifiedPair& b)
    { return std::tie(a.baseline, a.left, a.right) < std::tie(b.baseline, b.left, b.right); });
  std::vector<CameraEyes> eyes;
  std::set<std::string> used;
  for (const RectifiedPair& pair : pairs)
  {
    if (used.count(pair.left) == 0 && used.count(pair.right) == 0)
    {
      used.insert({ pair.left, pair.right });
      eyes.push_back({ pair.left, pair.right, "" });
    }
  }
  for (const std::string& camera : dataset.cameras())
  {
    if (used.count(camera) == 0)
    {
      eyes.push_back({ camera, "", "" });
    }
  }
  std::sort(eyes.begin(), eyes.end(), [](const CameraEyes& a, const CameraEyes& b) { return a.left < b.left; });
  SafeNames names;
  for (CameraEyes& one : eyes)
  {
    one.name = names.of(one.left);
  }
  return eyes;
}
} // namespace

std::vector<CameraEyes> eyesOf(const DatasetView& dataset) { return eyesOf(dataset, dataset.rectifiedPairs()); }

namespace
{
/// Of a pair: a picture whose disparities are to another camera, and which one it should be; null for none.
struct Stranger
{
  const DatasetShot* shot = nullptr;
  std::string meant;
};

Stranger strangerOf(const DatasetView& dataset, const RectifiedPair& pair, const std::vector<std::string>& partners)
{
  for (const auto& [camera, other] : { std::tie(pair.left, pair.right), std::tie(pair.right, pair.left) })
  {
    for (const DatasetShot* const shot : dataset.shotsOf(camera))
    {
      if (partners[shot->index] != other && dataset.shot(other, shot->frame()) != nullptr)
      {
        return { shot, other };
      }
    }
  }
  return {};
}
} // namespace

std::vector<CameraEyes> eyesOfDisparities(const DatasetView& dataset)
{
  std::vector<RectifiedPair> pairs = dataset.rectifiedPairs();
  if (dataset.has("disparity"))
  {
    const std::vector<std::string> partners = dataset.disparityPartners();
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(),
                  [&](const RectifiedPair& pair) { return strangerOf(dataset, pair, partners).shot != nullptr; }),
      pairs.end());
  }
  return eyesOf(dataset, std::move(pairs));
}

void requireOneMatrix(const DatasetView& dataset, const CameraEyes& pair, const std::string& format)
{
  for (const DatasetShot* const shot : dataset.shotsOf(pair.left))
  {
    const DatasetShot* const right = dataset.shot(pair.right, shot->frame());
    const double cx = shot->camera.K(0, 2);
    if (right != nullptr && std::abs(right->camera.K(0, 2) - cx) > 1e-9 * shot->camera.K(0, 0))
    {
      throw UsageError(format + ": camera " + quoted(pair.right) + " has another cx than " + quoted(pair.left) + " (" +
                       shortest(right->camera.K(0, 2)) + " and " + shortest(cx) + "), which the format cannot say");
    }
  }
}

std::vector<CameraEyes> pairsOf(const DatasetView& dataset, const std::string& format)
{
  std::vector<CameraEyes> pairs;
  for (const CameraEyes& one : eyesOfDisparities(dataset))
  {
    if (!one.right.empty())
    {
      pairs.push_back(one);
    }
  }
  const std::vector<RectifiedPair> all = dataset.rectifiedPairs();
  if (pairs.empty() && !all.empty())
  {
    const auto nearest = std::min_element(
      all.begin(), all.end(), [](const RectifiedPair& a, const RectifiedPair& b) { return a.baseline < b.baseline; });
    const std::vector<std::string> partners = dataset.disparityPartners();
    const Stranger stranger = strangerOf(dataset, *nearest, partners);
    throw UsageError(format + ": the disparities of camera " + quoted(stranger.shot->name()) + " at frame " +
                     std::to_string(stranger.shot->frame()) + " are those to " +
                     quoted(partners[stranger.shot->index]) + ", not to " + quoted(stranger.meant) +
                     "; a run of these two cameras alone has theirs");
  }
  if (pairs.empty())
  {
    throw UsageError(format + ": no two cameras are a rectified pair: plain pinholes of one size and, but for cx, one "
                              "matrix, alike turned, the right one along the left one's x");
  }
  return pairs;
}

double baselineMetres(const DatasetView& dataset, const DatasetShot& left, const DatasetShot& right)
{
  return (left.camera.t - right.camera.t).x() * dataset.metres();
}

std::string numbersLine(const std::vector<double>& numbers)
{
  std::vector<std::string> words;
  words.reserve(numbers.size());
  for (const double number : numbers)
  {
    words.push_back(shortest(number + 0.0)); // no -0
  }
  return joined(words, " ");
}

std::string matrixLine(const Rigid3& pose)
{
  std::vector<double> numbers;
  for (const std::vector<double>& row : matrixRows(pose))
  {
    numbers.insert(numbers.end(), row.begin(), row.end());
  }
  return numbersLine(numbers);
}

std::string quotedText(const std::string& text)
{
  std::string out = nlohmann::json(utf8FromBytes(text)).dump();
  for (const auto& [bytes, escape] : { std::pair<const char*, const char*>{ "\xC2\x85", "\\u0085" },
         { "\xE2\x80\xA8", "\\u2028" }, { "\xE2\x80\xA9", "\\u2029" }, { "\xEF\xBB\xBF", "\\ufeff" } })
  {
    for (std::size_t at = out.find(bytes); at != std::string::npos; at = out.find(bytes, at))
    {
      out.replace(at, std::char_traits<char>::length(bytes), escape);
    }
  }
  return out;
}

std::string padded(int number, int digits)
{
  std::string text = std::to_string(number);
  return text.size() < std::size_t(digits) ? std::string(std::size_t(digits) - text.size(), '0') + text : text;
}

} // namespace dgtk
