// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkReadLayers.h"

#include "dgtkArrayMemory.h"
#include "dgtkError.h"
#include "dgtkLayerRequest.h"
#include "dgtkLdi.h"
#include "dgtkPixelValues.h"
#include "dgtkText.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>

namespace dgtk
{

namespace
{
/// A file, the layer that was asked for to have it, and what its values are called.
struct Piece
{
  std::string layer;
  std::string output;
  LayerSpec spec;
  DatasetFile file;
};

/// Layers by the names of their images and documents.
class LayerNames
{
public:
  LayerNames()
  {
    for (const LayerInfo& info : generatorLayers())
    {
      const std::size_t place = this->Order.size();
      this->Order.emplace(info.layer, place);
      this->Layers.emplace(info.layer, info.layer);
      for (const LayerRecord& record : info.records)
      {
        this->Layers.emplace(record.spec.name, info.layer);
      }
    }
  }
  /// Of a name that is no layer's, itself.
  std::string layerOf(const std::string& name) const
  {
    const auto found = this->Layers.find(name);
    return found == this->Layers.end() ? name : found->second;
  }
  std::size_t placeOf(const std::string& layer) const
  {
    const auto found = this->Order.find(layer);
    return found == this->Order.end() ? this->Order.size() : found->second;
  }

private:
  std::map<std::string, std::string> Layers;
  std::map<std::string, std::size_t> Order;
};

/// The own name of the folder of a file, "" at the top of the dataset.
std::string folderOf(const std::string& path)
{
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  return folder.filename().string();
}

/// The output's name: the folder has those of the other camera and of the object, the file's layer what follows.
std::string outputOf(const DatasetFile& file, const std::string& layer)
{
  return folderOf(file.path) + (file.layer.rfind(layer, 0) == 0 ? file.layer.substr(layer.size()) : std::string());
}

bool isDocument(const Piece& piece) { return !isLayerFile(piece.file.path); }

/// What belongs to a cloud of points follows it.
bool isLast(const Piece& piece) { return extensionOf(piece.file.path) == "json"; }

const LayerNames& layerNames()
{
  static const LayerNames names;
  return names;
}

/// A picture's files that are of a layer; those of its frame that are no camera's own belong to all pictures of it, and
/// are looked for among these when it is asked for.
std::vector<Piece> piecesOf(const DatasetView& dataset, const DatasetShot& shot, bool ofFrame)
{
  const LayerNames& names = layerNames();
  std::map<std::string, LayerSpec> specs;
  for (const LayerRecord& record : dataset.manifest().layers)
  {
    specs.emplace(record.spec.name, record.spec);
  }
  std::vector<Piece> pieces;
  for (const DatasetShot* other : ofFrame ? dataset.shotsAt(shot.frame()) : std::vector<const DatasetShot*>{ &shot })
  {
    for (const DatasetFile& file : dataset.filesOf(*other))
    {
      const bool own = other->index == shot.index;
      if (!file.layer.empty() && (own || file.path.rfind(other->name() + '/', 0) != 0))
      {
        const std::string layer = names.layerOf(file.layer);
        const auto spec = specs.find(file.layer);
        pieces.push_back({ layer, outputOf(file, layer), spec == specs.end() ? LayerSpec() : spec->second, file });
      }
    }
  }
  std::stable_sort(pieces.begin(), pieces.end(),
    [&](const Piece& a, const Piece& b)
    {
      const std::size_t left = names.placeOf(a.layer);
      const std::size_t right = names.placeOf(b.layer);
      const bool lastA = isLast(a);
      const bool lastB = isLast(b);
      return std::tie(left, a.output, lastA) < std::tie(right, b.output, lastB);
    });
  return pieces;
}

LayerArray arrayOf(const std::string& name, const Rows& rows)
{
  LayerArray array;
  array.name = name;
  array.type = rows.type();
  array.channels = rows.channels();
  append(array, rows.data(), rows.bytes());
  return array;
}

/// Ids as numbers, whatever the file has them in.
LayerArray idsOf(const std::string& name, const Rows& rows)
{
  LayerArray array;
  array.name = name;
  array.type = PixelType::UInt32;
  for (int y = 0; y < rows.height(); ++y)
  {
    std::vector<std::uint32_t> ids(static_cast<std::size_t>(rows.width()));
    for (int x = 0; x < rows.width(); ++x)
    {
      ids[std::size_t(x)] = idAt(rows, x, y);
    }
    append(array, ids.data(), ids.size());
  }
  return array;
}

/// A file of Cryptomatte has its channels in alphabetical order, a, b, g, r of each four; the layer r, g, b, a.
void orderRanks(LayerArray& array)
{
  auto* const values = reinterpret_cast<float*>(array.data.data());
  for (std::size_t i = 0; i + 4 <= array.data.size() / sizeof(float); i += 4)
  {
    std::reverse(values + i, values + i + 4);
  }
}

/// An image of the picture's size, or a table with a row a line.
LayerArray readPixels(const DatasetShot& shot, const Piece& piece, const std::string& path)
{
  const std::unique_ptr<RowReader> reader = openLayerTable(path);
  const ImageInfo& info = reader->info();
  requireArrayMemory(info.width, info.height, 2.0 * double(info.pixelBytes()));
  const bool isImage = info.width == shot.camera.width && info.height == shot.camera.height;
  if (!isImage && (info.format != "npy" || info.channels != 1 || info.width != piece.spec.channels))
  {
    throw InputError(path, "has another size than the picture",
      std::to_string(shot.camera.width) + " x " + std::to_string(shot.camera.height),
      std::to_string(info.width) + " x " + std::to_string(info.height));
  }
  const Rows rows = info.height > 0 ? reader->read(info.height) : Rows(info.type, info.channels, info.width, 0, 0);
  const bool ids = piece.spec.type == PixelType::UInt32 && piece.spec.channels == 1;
  LayerArray array = ids ? idsOf(piece.output, rows) : arrayOf(piece.output, rows);
  if (piece.spec.meaning == Meaning::Coverage && info.format == "exr" && info.channels % 4 == 0)
  {
    orderRanks(array);
  }
  array.isImage = isImage;
  array.channels = isImage ? array.channels : info.width;
  return array;
}

std::vector<LayerArray> readSurfaces(const DatasetShot& shot, const Piece& piece, const std::string& path)
{
  LdiReader reader(path);
  if (reader.width() != shot.camera.width || reader.height() != shot.camera.height)
  {
    throw InputError(path, "has another size than the picture");
  }
  std::vector<LayerArray> arrays = surfaceArrays(piece.output);
  for (LdiRow row; reader.read(row);)
  {
    append(arrays[SurfaceCounts], row.counts.data(), row.counts.size());
    for (const LdiRecord& record : row.records)
    {
      append(arrays[SurfaceColors], record.rgba.data(), record.rgba.size());
      append(arrays[SurfaceDepths], &record.depth, 1);
      append(arrays[SurfaceSplats], &record.splatIndex, 1);
    }
  }
  for (LayerArray& array : arrays)
  {
    array.isImage = &array == &arrays.front();
  }
  return arrays;
}

LayerArray readDocument(const DatasetView& dataset, const Piece& piece)
{
  const std::string text = dataset.bytesOf(piece.file.path);
  LayerArray array;
  array.name = piece.output;
  array.format = extensionOf(piece.file.path);
  array.isImage = false;
  append(array, text.data(), text.size());
  return array;
}

/// An output of the picture: its documents, or the best of its images.
std::vector<LayerArray> readOutput(
  const DatasetView& dataset, const DatasetShot& shot, const std::vector<Piece>& pieces)
{
  std::vector<LayerArray> arrays;
  for (const Piece& piece : pieces)
  {
    if (isDocument(piece) && piece.spec.meaning == Meaning::Surfaces)
    {
      return readSurfaces(shot, piece, dataset.pathOf(piece.file.path));
    }
    if (isDocument(piece))
    {
      arrays.push_back(readDocument(dataset, piece));
    }
  }
  if (!arrays.empty())
  {
    return arrays;
  }
  const Piece& first = pieces.front();
  const std::string best = dataset.file(shot, first.file.layer, {}, folderOf(first.file.path));
  const std::string what = "layer " + first.layer + " as " + extensionOf(first.file.path);
  if (best.empty())
  {
    throw UsageError(what + ": holds no values that can be read back, but a picture of them");
  }
  const auto alike = [&](const Piece& piece) { return extensionOf(piece.file.path) == extensionOf(best); };
  if (std::count_if(pieces.begin(), pieces.end(), alike) > 1)
  {
    throw UsageError(what + ": several files hold one picture");
  }
  const std::string path = dataset.pathOf(best);
  if (first.spec.meaning == Meaning::Surfaces)
  {
    throw UsageError(what + ": is deep OpenEXR, which OpenImageIO reads");
  }
  return { readPixels(shot, first, path) };
}
} // namespace

std::vector<std::pair<std::string, std::vector<std::string>>> layersOf(const DatasetView& dataset)
{
  const LayerNames& names = layerNames();
  std::map<std::pair<std::size_t, std::string>, std::set<std::string>> found;
  for (const DatasetShot& shot : dataset.shots())
  {
    for (const DatasetFile& file : dataset.filesOf(shot))
    {
      if (!file.layer.empty())
      {
        const std::string layer = names.layerOf(file.layer);
        found[{ names.placeOf(layer), layer }].insert(outputOf(file, layer));
      }
    }
  }
  std::vector<std::pair<std::string, std::vector<std::string>>> layers;
  for (const auto& [key, outputs] : found)
  {
    layers.emplace_back(key.second, std::vector<std::string>(outputs.begin(), outputs.end()));
  }
  return layers;
}

std::vector<LayerArray> readLayers(
  const DatasetView& dataset, const DatasetShot& shot, const std::vector<std::string>& names)
{
  const auto isMeant = [](const Piece& piece, const std::string& name)
  { return piece.layer == name || piece.output == name; };
  const auto missing = [&](const std::vector<Piece>& pieces)
  {
    return std::find_if(names.begin(), names.end(),
      [&](const std::string& name)
      { return std::none_of(pieces.begin(), pieces.end(), [&](const Piece& piece) { return isMeant(piece, name); }); });
  };
  std::vector<Piece> pieces = piecesOf(dataset, shot, false);
  if (missing(pieces) != names.end())
  {
    pieces = piecesOf(dataset, shot, true);
  }
  if (const auto name = missing(pieces); name != names.end())
  {
    std::vector<std::string> layers;
    for (const Piece& piece : pieces)
    {
      if (layers.empty() || layers.back() != piece.layer)
      {
        layers.push_back(piece.layer);
      }
    }
    throw UsageError("there is no layer " + quoted(*name) + " of camera " + quoted(shot.name()) + " at frame " +
                     std::to_string(shot.frame()) + " (expected some of " + joined(layers) + ')');
  }
  std::vector<LayerArray> all;
  for (auto begin = pieces.cbegin(); begin != pieces.cend();)
  {
    const auto end =
      std::find_if(begin, pieces.cend(), [&](const Piece& piece) { return piece.output != begin->output; });
    const bool meant = std::any_of(begin, end,
      [&](const Piece& piece) {
        return std::any_of(names.begin(), names.end(), [&](const std::string& name) { return isMeant(piece, name); });
      });
    if (meant)
    {
      std::vector<LayerArray> arrays = readOutput(dataset, shot, { begin, end });
      all.insert(all.end(), std::make_move_iterator(arrays.begin()), std::make_move_iterator(arrays.end()));
    }
    begin = end;
  }
  return all;
}

} // namespace dgtk
