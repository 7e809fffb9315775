// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkReport.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkJournal.h"
#include "dgtkLayerColors.h"
#include "dgtkLongDocuments.h"
#include "dgtkReportChecks.h"
#include "dgtkReportObjects.h"
#include "dgtkReportPage.h"
#include "dgtkReportSpace.h"
#include "dgtkUtf8.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

namespace dgtk
{

namespace
{
constexpr double mostCells = 3e6; ///< samples of all pictures and layers together: some 10 MB of page
constexpr int smallestSide = 64;  ///< of a picture on the sheet, pixels
constexpr int largestSide = 640;
constexpr std::size_t mostNotes = 200;
constexpr std::size_t listedFrames = 24;

/// Text between the tags of a script or an element: neither ends it.
std::string harmless(const std::string& json)
{
  std::string text;
  for (const char c : json)
  {
    if (c == '<')
    {
      text += "\\u003c";
    }
    else
    {
      text += c;
    }
  }
  return text;
}

std::string escaped(const std::string& text)
{
  std::string out;
  for (const char c : text)
  {
    switch (c)
    {
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '&':
        out += "&amp;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string nameOfDataset(const std::string& folder)
{
  namespace fs = std::filesystem;
  const fs::path path = fs::path(folder).lexically_normal();
  const std::string name = (path.has_filename() ? path : path.parent_path()).filename().string();
  return printable(name.empty() || name == "." ? "dataset" : name);
}

/// Longest side of what is shown of each picture, so that all together are mostCells at most.
int sideOf(const ReportSource& source, const std::vector<ReportLayer>& layers)
{
  double cells = 0; // of all, where the longest sides are 1
  for (const std::size_t picture : source.shown)
  {
    const CameraRecord& camera = source.pictures[picture].shot->camera;
    const double ratio = double(camera.height) / camera.width;
    const auto files = std::count_if(
      layers.begin(), layers.end(), [&](const ReportLayer& layer) { return layer.files.count(picture) > 0; });
    cells += double(files) * std::min(ratio, 1 / ratio);
  }
  const double side = std::sqrt(mostCells / std::max(1.0, cells));
  return std::min(largestSide, std::max(smallestSide, static_cast<int>(side) / 8 * 8));
}

/// The page, written as it comes.
class PageWriter
{
public:
  explicit PageWriter(const std::string& file)
    : File(file)
    , Template(reportHtml)
  {
  }
  void text(const std::string& text)
  {
    this->File.write(text);
    this->Bytes += text.size();
  }
  /// The template up to a place, and behind it from then on.
  void upTo(const std::string& place)
  {
    const std::size_t end = this->Template.find("{{" + place + "}}", this->Next);
    this->text(this->Template.substr(this->Next, end - this->Next));
    this->Next = end == std::string::npos ? this->Template.size() : end + place.size() + 4;
  }
  void block(const std::string& id, const std::string& text)
  {
    this->text("<script type=\"text/plain\" id=\"" + id + "\">" + text + "</script>\n");
  }
  std::uint64_t finish()
  {
    this->text(this->Template.substr(this->Next));
    this->File.commit();
    return this->Bytes;
  }

private:
  AtomicFile File;
  std::string Template;
  std::size_t Next = 0;
  std::uint64_t Bytes = 0;
};

/// What is known of a picture beside its pixels.
struct FrameFacts
{
  std::map<std::size_t, double> covered;
  std::map<std::size_t, double> brightness;
};

ReportJson pictureJson(const ReportSource& source, std::size_t picture, const FrameFacts& facts)
{
  const ReportPicture& one = source.pictures[picture];
  std::uint64_t bytes = 0;
  for (const DatasetFile& file : source.viewOf(one).filesOf(*one.shot))
  {
    bytes += file.bytes;
  }
  ReportJson json{ { "scene", one.scene }, { "camera", utf8FromBytes(one.shot->name()) },
    { "frame", one.shot->frame() }, { "width", one.shot->camera.width }, { "height", one.shot->camera.height },
    { "bytes", bytes } };
  const auto place = std::lower_bound(source.shown.begin(), source.shown.end(), picture);
  if (place != source.shown.end() && *place == picture)
  {
    json["shown"] = place - source.shown.begin();
  }
  const auto covered = facts.covered.find(picture);
  if (covered != facts.covered.end())
  {
    json["covered"] = covered->second;
  }
  const auto brightness = facts.brightness.find(picture);
  if (brightness != facts.brightness.end())
  {
    json["brightness"] = brightness->second;
  }
  return json;
}

/// The pictures that come first when they are sorted by `less`.
template <typename Less>
ReportJson firstOnes(const ReportSource& source, const FrameFacts& facts, std::vector<std::size_t> pictures, Less less)
{
  std::stable_sort(pictures.begin(), pictures.end(), less);
  pictures.resize(std::min(pictures.size(), listedFrames));
  ReportJson list = ReportJson::array();
  for (const std::size_t picture : pictures)
  {
    list.push_back(pictureJson(source, picture, facts));
  }
  return list;
}

std::vector<std::size_t> keysOf(const std::map<std::size_t, double>& values)
{
  std::vector<std::size_t> keys;
  keys.reserve(values.size());
  for (const auto& [key, value] : values)
  {
    keys.push_back(key);
  }
  return keys;
}

ReportJson framesJson(const ReportSource& source, const FrameFacts& facts)
{
  std::map<std::size_t, std::uint64_t> bytes;
  for (const std::size_t picture : source.read)
  {
    bytes[picture] = pictureJson(source, picture, {})["bytes"];
  }
  const auto emptier = [&](std::size_t a, std::size_t b) { return facts.covered.at(a) < facts.covered.at(b); };
  const auto darker = [&](std::size_t a, std::size_t b) { return facts.brightness.at(a) < facts.brightness.at(b); };
  const auto larger = [&](std::size_t a, std::size_t b) { return bytes[a] > bytes[b]; };
  return { { "emptiest", firstOnes(source, facts, keysOf(facts.covered), emptier) },
    { "darkest", firstOnes(source, facts, keysOf(facts.brightness), darker) },
    { "largest", firstOnes(source, facts, source.read, larger) } };
}

ReportJson datasetJson(const ReportSource& source, const ReportRequest& request)
{
  const DatasetView& first = *source.scenes.front().view;
  std::set<std::string> cameras;
  std::uint64_t bytes = 0;
  std::uint64_t files = 0;
  std::size_t warningCount = 0;
  ReportJson warnings = ReportJson::array();
  for (const ReportScene& scene : source.scenes)
  {
    for (const std::string& camera : scene.view->cameras())
    {
      cameras.insert(camera);
    }
    for (const DatasetShot& shot : scene.view->shots())
    {
      for (const DatasetFile& file : scene.view->filesOf(shot))
      {
        bytes += file.bytes;
        ++files;
      }
    }
    for (const std::string& line : scene.view->manifest().warnings)
    {
      if (++warningCount <= mostNotes)
      {
        warnings.push_back((scene.name.empty() ? "" : printable(scene.name) + ": ") + printable(line));
      }
    }
  }
  ReportJson info = ReportJson::object();
  for (const auto& [key, value] : first.manifest().info)
  {
    info[utf8FromBytes(key)] = utf8FromBytes(value);
  }
  return { { "name", nameOfDataset(request.dataset) }, { "version", utf8FromBytes(first.manifest().version) },
    { "many", source.many }, { "scenesFound", source.scenesFound }, { "scenes", source.scenes.size() },
    { "pictures", source.pictures.size() }, { "read", source.read.size() }, { "shown", source.shown.size() },
    { "cameras", cameras.size() }, { "files", files }, { "bytes", bytes },
    { "units", utf8FromBytes(first.manifest().units) }, { "seed", request.seed }, { "info", info },
    { "warnings", warnings }, { "warningCount", warningCount } };
}

ReportJson layerJson(const ReportLayer& layer, const LayerResult& result)
{
  const LayerSpec& spec = layer.spec;
  ReportJson json{ { "label", utf8FromBytes(layer.label) }, { "meaning", nameOf(spec.meaning) },
    { "unit", utf8FromBytes(spec.unit) }, { "frame", utf8FromBytes(spec.frame) },
    { "invalid", utf8FromBytes(spec.invalid) }, { "description", utf8FromBytes(spec.description) },
    { "pictures", result.counted }, { "legend", result.legend } };
  if (result.numbers.values + result.numbers.nothing > 0)
  {
    json["numbers"] = result.numbers.json();
  }
  if (result.brightness.values > 0)
  {
    json["brightness"] = result.brightness.json();
  }
  return json;
}

/// The first layer that has it serves.
template <typename T>
void keepFirst(std::map<std::size_t, T>& kept, std::map<std::size_t, T>& found)
{
  if (kept.empty())
  {
    kept.swap(found);
  }
}

void addNotes(std::vector<std::string>& notes, const std::vector<std::string>& more)
{
  notes.insert(notes.end(), more.begin(), more.end());
}

ReportJson swatches()
{
  ReportJson colors = ReportJson::array();
  for (std::uint32_t id = 0; id < 256; ++id)
  {
    const Rgb color = idColor(id);
    colors.push_back({ color[0], color[1], color[2] });
  }
  return colors;
}
} // namespace

ReportResult writeReport(const ReportRequest& request, const ReportProgress& progress)
{
  ReportResult result;
  requireOutsideDatasets(request.file);
  const ReportJson verification = verificationOf(request); // what is wrong with documents is said before the work
  const ReportJson exports = exportsOf(request);
  const ReportJson samples = samplesOf(request);
  const ReportSource source(request);
  result.notes = source.notes;
  const std::vector<ReportLayer> layers = reportLayers(source);
  const int side = sideOf(source, layers);

  PageWriter page(request.file);
  page.upTo("title");
  page.text(escaped(nameOfDataset(request.dataset)));
  page.upTo("css");
  page.text(reportCss);
  page.upTo("data");
  ThreadPool pool(std::max(1, request.threads));
  FrameFacts facts;
  std::map<std::size_t, double> coveredByDepth;
  std::map<std::size_t, IdTally> objects;
  std::map<std::size_t, IdTally> classes;
  ReportJson layerList = ReportJson::array();
  for (std::size_t i = 0; i < layers.size(); ++i)
  {
    LayerResult one = readLayer(source, layers[i], side, pool,
      [&](std::size_t shown, const std::string& text)
      { page.block("d" + std::to_string(i) + '-' + std::to_string(shown), text); });
    layerList.push_back(layerJson(layers[i], one));
    addNotes(result.notes, one.notes);
    const LayerSpec& spec = layers[i].spec;
    const bool isId = spec.meaning == Meaning::Id;
    // surfaces whose target is behind the camera have no displacement, a sensor's drop-outs no depth
    if (spec.meaning != Meaning::Displacement && spec.name != "depth_noisy")
    {
      keepFirst(isId ? facts.covered : coveredByDepth, one.covered);
    }
    keepFirst(facts.brightness, one.means);
    keepFirst(isId ? objects : classes, one.ids);
    if (progress)
    {
      progress(i + 1, layers.size());
    }
  }
  keepFirst(facts.covered, coveredByDepth);

  ReportJson model;
  model["dataset"] = datasetJson(source, request);
  model["layers"] = layerList;
  model["pictures"] = ReportJson::array();
  for (const std::size_t picture : source.shown)
  {
    model["pictures"].push_back(pictureJson(source, picture, facts));
  }
  model["names"] = namesOf(source);
  model["colors"] = swatches();
  model["seen"] = objectsSeen(source, objects, classes, result.notes);
  model["plans"] = plansOf(source);
  model["viewpoints"] = viewpointsOf(source, objects);
  model["frames"] = framesJson(source, facts);
  model["verification"] = verification;
  model["exports"] = exports;
  model["samples"] = samples;
  model["notes"] = ReportJson::array();
  for (std::size_t i = 0; i < std::min(mostNotes, result.notes.size()); ++i)
  {
    model["notes"].push_back(printable(result.notes[i]));
  }
  model["noteCount"] = result.notes.size();
  page.text("<script type=\"application/json\" id=\"model\">");
  page.text(harmless(model.dump(-1, ' ', false, ReportJson::error_handler_t::replace)));
  page.text("</script>\n");
  page.upTo("js");
  page.text(reportJs);
  result.bytes = page.finish();
  result.pictures = source.pictures.size();
  result.read = source.read.size();
  result.shown = source.shown.size();
  result.layers = layers.size();
  return result;
}

} // namespace dgtk
