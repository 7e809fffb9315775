// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPictureColors.h"

#include "dgtkCryptomatte.h"
#include "dgtkEditorLanguage.h"

#include <QCoreApplication>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace dgtk
{

namespace
{
constexpr std::size_t mostSamples = 100000; // from which a range is taken
constexpr std::size_t mostSwatches = 40;
constexpr std::size_t mostIds = 4096; // above, ids are not counted one by one

LayerLook lookOf(const PictureValues& picture)
{
  if (isObjectMask(picture.layer))
  {
    return LayerLook::Ids;
  }
  return isFlow(picture.layer.spec, picture.info) ? LayerLook::Flow : dgtk::lookOf(picture.layer.spec, picture.info);
}

bool isCoverage(const PictureValues& picture)
{
  return picture.layer.spec.meaning == Meaning::Coverage && picture.info.channels % 4 == 0;
}

/// What stands for nothing although it is a finite number.
bool zeroIsNothing(const PictureValues& picture)
{
  return picture.layer.spec.meaning == Meaning::InverseDepth || picture.layer.spec.meaning == Meaning::Surfaces;
}

/// Calls with the channels of every kept pixel, or of every `every`-th.
template <typename F>
void forEach(const PictureValues& picture, std::size_t every, F&& each)
{
  std::vector<double> channels(std::size_t(std::max(1, picture.values.channels())));
  const std::size_t columns = std::size_t(picture.columns());
  const std::size_t count = columns * std::size_t(picture.rows());
  for (std::size_t i = 0; i < count; i += every)
  {
    picture.get(static_cast<int>(i % columns), static_cast<int>(i / columns), channels.data());
    each(i, channels.data());
  }
}

/// Finite values of a channel, or lengths of a flow: the whole range, or without the outermost hundredths.
PictureRange rangeOf(const PictureValues& picture, LayerLook look, int channel)
{
  std::vector<double> values;
  const std::size_t count = std::size_t(picture.columns()) * std::size_t(picture.rows());
  const bool zeroLeftOut = zeroIsNothing(picture);
  forEach(picture, std::max<std::size_t>(1, count / mostSamples),
    [&](std::size_t, const double* v)
    {
      const double value = look == LayerLook::Flow ? std::hypot(v[0], v[1]) : v[channel];
      if (std::isfinite(value) && !(zeroLeftOut && value == 0))
      {
        values.push_back(value);
      }
    });
  if (values.empty())
  {
    return {};
  }
  std::sort(values.begin(), values.end());
  const std::size_t cut = look == LayerLook::Depth ? 0 : values.size() / 100;
  const double high = values[values.size() - 1 - cut];
  return { look == LayerLook::Flow ? 0.0 : values[cut], high };
}

std::uint32_t wordOf(Rgb color)
{
  return 0xff000000u | std::uint32_t(color[0]) << 16 | std::uint32_t(color[1]) << 8 | color[2];
}

std::string nameOfId(const DatasetPictures& dataset, const LayerSpec& spec, std::uint32_t id)
{
  std::string number = std::to_string(id);
  const ObjectRecord* const object = dataset.object(id);
  switch (spec.meaning)
  {
    case Meaning::Visibility:
      return number + " " + visibilityText(id).toStdString();
    case Meaning::Id:
      return number + (object ? " " + object->name : id == 0 ? " " + backgroundText() : "");
    case Meaning::Mask:
      return number + " " + (id == 0 ? outsideText() : object ? object->name : std::string());
    case Meaning::Class:
    {
      const std::string name = dataset.className(id);
      return number + (id == 0 ? " " + backgroundText() : name.empty() ? "" : " " + name);
    }
    default:
      return number;
  }
}

using Counts = std::unordered_map<std::uint32_t, std::size_t>;

void addSwatches(const DatasetPictures& dataset, const PictureValues& picture, const Counts& counts,
  const LayerColors& colors, PictureLegend& legend)
{
  legend.kind = PictureLegend::Kind::Swatches;
  if (counts.size() > mostIds)
  {
    legend.text = "each id has a colour of its own";
    return;
  }
  std::vector<std::pair<std::size_t, std::uint32_t>> sorted;
  for (const auto& [id, count] : counts)
  {
    sorted.emplace_back(count, id);
  }
  std::sort(sorted.begin(), sorted.end(),
    [](const auto& a, const auto& b) { return a.first != b.first ? a.first > b.first : a.second < b.second; });
  for (const auto& [count, id] : sorted)
  {
    if (legend.swatches.size() < mostSwatches)
    {
      legend.swatches.push_back({ colors.idColorOf(id), nameOfId(dataset, picture.layer.spec, id) });
    }
  }
  legend.hidden = sorted.size() - legend.swatches.size();
}

PictureColors colorCoverage(const DatasetPictures& dataset, const PictureValues& picture)
{
  PictureColors out;
  LayerSpec spec;
  spec.meaning = Meaning::Id;
  const LayerColors colors(LayerLook::Ids, spec, picture.info);
  Counts counts;
  forEach(picture, 1,
    [&](std::size_t, const double* v)
    {
      double mixed[3] = { 0, 0, 0 };
      for (const CoveredObject& object : coveredObjects(dataset, picture, v))
      {
        const Rgb color = idColor(object.id);
        for (std::size_t c = 0; c < 3; ++c)
        {
          mixed[c] += object.coverage * color[c];
        }
        ++counts[object.id];
      }
      const auto byte = [&](int c) { return static_cast<std::uint8_t>(std::min(mixed[c] + 0.5, 255.0)); };
      out.pixels.push_back(wordOf({ byte(0), byte(1), byte(2) }));
    });
  PictureValues named;
  named.layer.spec = spec;
  addSwatches(dataset, named, counts, colors, out.legend);
  return out;
}

LayerColors makeColors(const PictureValues& picture, LayerLook look)
{
  return { look, picture.layer.spec, picture.info };
}

void describe(const PictureValues& picture, LayerLook look, PictureLegend& legend)
{
  const LayerSpec& spec = picture.layer.spec;
  legend.unit = spec.unit == "1" || spec.meaning == Meaning::Surfaces ? "" : spec.unit;
  const bool ramp = look == LayerLook::Depth || (look == LayerLook::Ranges && picture.info.channels == 1);
  legend.hasRange = ramp || look == LayerLook::Flow;
  switch (look)
  {
    case LayerLook::Normal:
      legend.kind = PictureLegend::Kind::Axes;
      legend.text = "red right, green up, blue towards the camera";
      break;
    case LayerLook::Fractions:
      legend.kind = PictureLegend::Kind::Axes;
      legend.text = "red u, green v, without whole numbers";
      break;
    case LayerLook::Flow:
      legend.kind = PictureLegend::Kind::Wheel;
      break;
    case LayerLook::Picture:
      legend.kind = PictureLegend::Kind::None;
      break;
    case LayerLook::Ids:
      legend.kind = PictureLegend::Kind::Swatches; // see addSwatches()
      break;
    default:
      legend.kind = ramp ? PictureLegend::Kind::Ramp : PictureLegend::Kind::Axes;
      legend.text = ramp                         ? ""
                    : picture.info.channels == 2 ? "red x, green y, over the range of each"
                                                 : "red x, green y, blue z, over the range of each";
      break;
  }
}
} // namespace

std::string backgroundText() { return QCoreApplication::translate("PixelText", "background").toStdString(); }

std::string outsideText() { return QCoreApplication::translate("PixelText", "outside").toStdString(); }

std::vector<CoveredObject> coveredObjects(
  const DatasetPictures& dataset, const PictureValues& picture, const double* channels)
{
  std::vector<CoveredObject> objects;
  // the channels of a file are in alphabetical order: a, b, g, r of each four; r and b are ids, g and a coverages
  for (int group = 0; group + 3 < picture.info.channels; group += 4)
  {
    const double pairs[2][2] = { { channels[group + 3], channels[group + 2] },
      { channels[group + 1], channels[group] } };
    for (const auto& [hash, coverage] : pairs)
    {
      if (coverage > 0)
      {
        objects.push_back({ dataset.objectOfHash(static_cast<float>(hash)), coverage });
      }
    }
  }
  return objects;
}

PictureColors colorPicture(
  const DatasetPictures& dataset, const PictureValues& picture, const std::optional<PictureRange>& range)
{
  if (isCoverage(picture))
  {
    return colorCoverage(dataset, picture);
  }
  PictureColors out;
  PictureLegend& legend = out.legend;
  const LayerLook look = lookOf(picture);
  LayerColors colors = makeColors(picture, look);
  describe(picture, look, legend);
  for (int channel = 0; channel < colors.ranges(); ++channel)
  {
    const PictureRange found = rangeOf(picture, look, channel);
    legend.found = channel == 0 ? found : legend.found;
    const PictureRange used = legend.hasRange && range ? *range : found;
    legend.range = channel == 0 ? used : legend.range;
    colors.setRange(channel, used.low, used.high);
  }
  Counts counts;
  const bool ids = look == LayerLook::Ids;
  const bool zeroLeftOut = zeroIsNothing(picture);
  out.pixels.resize(std::size_t(picture.columns()) * std::size_t(picture.rows()));
  forEach(picture, 1,
    [&](std::size_t i, const double* v)
    {
      out.pixels[i] = wordOf(zeroLeftOut && v[0] == 0 ? nothingColor : colors(v));
      if (ids && counts.size() <= mostIds && colors.isId(colors.id(v)))
      {
        ++counts[colors.id(v)];
      }
    });
  if (ids)
  {
    addSwatches(dataset, picture, counts, colors, legend);
  }
  return out;
}

bool legendIsLogarithmic(const PictureValues& picture, const PictureLegend& legend)
{
  return lookOf(picture) == LayerLook::Depth && legend.range.low > 0;
}

Rgb legendColor(const PictureValues& picture, const PictureLegend& legend, double position)
{
  const LayerLook look = lookOf(picture);
  LayerColors colors = makeColors(picture, look);
  const auto [low, high] = legend.range;
  colors.setRange(0, low, high);
  const double value =
    legendIsLogarithmic(picture, legend) ? low * std::pow(high / low, position) : low + position * (high - low);
  return colors(&value);
}

} // namespace dgtk
