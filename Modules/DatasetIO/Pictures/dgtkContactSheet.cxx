// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkContactSheet.h"

#include "dgtkCanvas.h"
#include "dgtkError.h"
#include "dgtkJournal.h"
#include "dgtkLayerReader.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

namespace dgtk
{

namespace
{
namespace fs = std::filesystem;

constexpr Rgb paper = { 22, 22, 26 };
constexpr Rgb ink = { 230, 230, 230 };
constexpr int gap = 6;
constexpr int line = 13; // of text

/// Places of a sheet's cells.
struct Grid
{
  int columns;
  int rows;
  int cellWidth;
  int cellHeight;
  int left; ///< for the rows' names
  int top;  ///< for the columns' names
  int x(int column) const { return this->left + gap + column * (this->cellWidth + gap); }
  int y(int row) const { return this->top + gap + row * (this->cellHeight + gap); }
  Canvas sheet() const { return { this->x(this->columns), this->y(this->rows), paper }; }
};

/// `count` of the items, evenly, with the first and the last.
std::vector<int> spread(const std::set<int>& items, int count)
{
  std::vector<int> all(items.begin(), items.end());
  if (static_cast<int>(all.size()) <= count)
  {
    return all;
  }
  std::vector<int> chosen;
  chosen.reserve(std::size_t(count));
  for (int i = 0; i < count; ++i)
  {
    chosen.push_back(all[count > 1 ? std::size_t(i) * (all.size() - 1) / std::size_t(count - 1) : 0]);
  }
  return chosen;
}

/// Size of an image that fits into width x height.
std::pair<int, int> fit(const ImageInfo& info, int width, int height)
{
  const double scale = std::min(double(width) / info.width, double(height) / info.height);
  return { std::min(width, std::max(1, static_cast<int>(std::lround(info.width * scale)))),
    std::min(height, std::max(1, static_cast<int>(std::lround(info.height * scale)))) };
}

void drawCell(Canvas& sheet, const std::string& path, const LayerSpec& spec, const Grid& grid, int column, int row)
{
  const auto [width, height] = fit(openLayerFile(path)->info(), grid.cellWidth, grid.cellHeight);
  sheet.paste(makeThumbnail(path, spec, width, height), grid.x(column) + (grid.cellWidth - width) / 2,
    grid.y(row) + (grid.cellHeight - height) / 2);
}

/// One image of the dataset: where it is drawn.
using Key = std::tuple<std::string, int, std::string>; // camera, frame, layer

struct Contents
{
  std::vector<LayerSpec> layers;
  std::vector<std::string> cameras;
  std::set<int> frames;
  std::map<Key, std::string> images;
};

/// Layers whose files are one picture of the view.
bool isPicture(const LayerSpec& spec)
{
  const bool ranks = spec.meaning == Meaning::Coverage && spec.channels > 1;
  return spec.meaning != Meaning::Surfaces && spec.meaning != Meaning::Record && !ranks;
}

bool isPng(const std::string& path) { return fs::path(path).extension() == ".png"; }

Contents contentsOf(const Manifest& manifest)
{
  Contents contents;
  std::map<std::string, LayerSpec> known;
  for (const LayerRecord& layer : manifest.layers)
  {
    known.emplace(layer.spec.name, layer.spec);
  }
  std::set<std::string> found;
  std::set<std::string> cameras;
  std::vector<const DatasetFile*> files;
  for (const DatasetFile& file : manifest.files)
  {
    const auto layer = known.find(file.layer);
    if (layer != known.end() && isPicture(layer->second) && !file.camera.empty() && isLayerFile(file.path))
    {
      files.push_back(&file);
    }
  }
  std::sort(files.begin(), files.end(), [](const DatasetFile* a, const DatasetFile* b) { return a->path < b->path; });
  for (const DatasetFile* file : files)
  {
    // the first in alphabetical order where a layer has several formats; a picture loses nothing to values
    std::string& path = contents.images[{ file->camera, file->frame, file->layer }];
    const bool better = known[file->layer].meaning == Meaning::Picture && isPng(file->path) && !isPng(path);
    if (path.empty() || better)
    {
      path = file->path;
    }
    contents.frames.insert(file->frame);
    found.insert(file->layer);
    cameras.insert(file->camera);
  }
  contents.cameras.assign(cameras.begin(), cameras.end());
  for (const LayerRecord& layer : manifest.layers)
  {
    if (found.erase(layer.spec.name) > 0)
    {
      contents.layers.push_back(layer.spec);
    }
  }
  return contents;
}

std::string frameText(int frame)
{
  const std::string digits = std::to_string(frame);
  return std::string(digits.size() < 6 ? 6 - digits.size() : 0, '0') + digits;
}
} // namespace

DatasetFile writeContactSheet(
  const std::string& folder, const Manifest& manifest, const std::string& path, const ContactSheetOptions& options)
{
  Contents contents = contentsOf(manifest);
  if (contents.images.empty())
  {
    throw UsageError(folder + ": the dataset has no images for a contact sheet");
  }
  contents.cameras.resize(std::min(contents.cameras.size(), std::size_t(std::max(1, options.maxCameras))));
  const std::vector<int> frames = spread(contents.frames, std::max(1, options.maxFrames));
  const auto inFolder = [&](const std::string& name) { return (fs::path(folder) / name).string(); };
  const ImageInfo shape = openLayerFile(inFolder(contents.images.begin()->second))->info();
  Grid grid{};
  grid.columns = static_cast<int>(contents.layers.size());
  grid.rows = static_cast<int>(contents.cameras.size() * frames.size());
  grid.cellWidth = std::max(16, options.thumbnailWidth);
  grid.cellHeight = std::max(1,
    std::min(2 * grid.cellWidth, static_cast<int>(std::lround(double(grid.cellWidth) * shape.height / shape.width))));
  std::size_t longest = 6;
  for (const std::string& camera : contents.cameras)
  {
    longest = std::max(longest, camera.size());
  }
  grid.left = gap + std::min(120, Canvas::textWidth(std::string(longest, ' ')));
  grid.top = line;
  Canvas sheet = grid.sheet();
  for (int column = 0; column < grid.columns; ++column)
  {
    sheet.text(contents.layers[std::size_t(column)].name, grid.x(column), gap, grid.cellWidth, ink);
  }
  int row = 0;
  for (const std::string& camera : contents.cameras)
  {
    for (const int frame : frames)
    {
      sheet.text(camera, gap, grid.y(row) + 2, grid.left - gap, ink);
      sheet.text(frameText(frame), gap, grid.y(row) + 2 + line, grid.left - gap, ink);
      for (int column = 0; column < grid.columns; ++column)
      {
        const LayerSpec& spec = contents.layers[std::size_t(column)];
        const auto image = contents.images.find({ camera, frame, spec.name });
        if (image != contents.images.end())
        {
          drawCell(sheet, inFolder(image->second), spec, grid, column, row);
        }
      }
      ++row;
    }
  }
  DatasetFile file = sheet.write(FilePlace(folder, path));
  file.path = path;
  return file;
}

DatasetFile writeContactSheet(const std::string& folder, const std::string& path, const ContactSheetOptions& options)
{
  return writeContactSheet(folder, readManifest((fs::path(folder) / manifestName).string()), path, options);
}

} // namespace dgtk
