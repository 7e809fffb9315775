// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkArraySink.h"

#include "dgtkArrayMemory.h"
#include "dgtkError.h"
#include "dgtkSpaceNeeded.h"

#include <algorithm>
#include <cstdint>

#include <unistd.h>

namespace dgtk
{

namespace
{
LayerArray arrayOf(const std::string& name, PixelType type, int channels)
{
  LayerArray array;
  array.name = name;
  array.type = type;
  array.channels = channels;
  return array;
}

} // namespace

std::vector<LayerArray> surfaceArrays(const std::string& name)
{
  std::vector<LayerArray> arrays{ arrayOf(name, PixelType::UInt32, 1), arrayOf(name, PixelType::UInt8, 4),
    arrayOf(name, PixelType::Float64, 1), arrayOf(name, PixelType::UInt32, 1) };
  for (std::size_t i = 0; i < arrays.size(); ++i)
  {
    arrays[i].part = ldiParts[i];
  }
  return arrays;
}

ArraySink::ArraySink(const JobContext& context, const std::vector<LayerOutput>& outputs)
{
  for (const std::string& name : distinctNames(context.queries.stage().objectNames()))
  {
    this->Ids.push_back(cryptomatteId(name));
  }
  for (const LayerOutput& output : outputs)
  {
    this->Outputs.push_back({ output, {}, {}, {} });
  }
}

void ArraySink::rows(std::size_t output, const Rows& rows)
{
  Values& values = this->Outputs[output];
  if (values.arrays.empty())
  {
    values.arrays.push_back(arrayOf(values.output.name, rows.type(), rows.channels()));
    values.arrays.front().data.reserve(rows.rowBytes() * std::size_t(values.output.height));
  }
  append(values.arrays.front(), rows.data(), rows.bytes());
}

void ArraySink::surfaces(std::size_t output, const LdiRows& rows)
{
  Values& values = this->Outputs[output];
  if (values.arrays.empty())
  {
    values.arrays = surfaceArrays(values.output.name);
  }
  append(values.arrays[SurfaceCounts], rows.counts.data(), rows.counts.size());
  for (const LdiSurface& surface : rows.surfaces)
  {
    const std::array<std::uint8_t, 4> color = ldiColor(surface.rgba);
    append(values.arrays[SurfaceColors], color.data(), color.size());
    append(values.arrays[SurfaceDepths], &surface.depth, 1);
    append(values.arrays[SurfaceSplats], &surface.splatIndex, 1);
  }
}

void ArraySink::ranks(std::size_t output, const std::vector<CoveredId>& ranks, std::uint32_t pixels)
{
  this->Outputs[output].ranks.push_back(ranks);
  this->Outputs[output].pixels.push_back(pixels);
}

void ArraySink::document(std::size_t output, const std::string& text)
{
  Values& values = this->Outputs[output];
  LayerArray array = arrayOf(values.output.name, PixelType::UInt8, 1);
  array.format = values.output.formats.front();
  append(array, text.data(), text.size());
  values.arrays.push_back(std::move(array));
}

/// Channels as CryptomatteWriter has them: as many ranks as a pixel needs, but at least those of the layer.
void ArraySink::completeRanks(Values& values) const
{
  std::size_t most = std::size_t(values.output.spec.channels) / 2;
  for (const std::vector<CoveredId>& run : values.ranks)
  {
    most = std::max(most, run.size() + run.size() % 2); // files have two ranks in four channels
  }
  LayerArray array = arrayOf(values.output.name, PixelType::Float32, static_cast<int>(2 * most));
  std::vector<float> pixel(2 * most);
  for (std::size_t i = 0; i < values.ranks.size(); ++i)
  {
    std::fill(pixel.begin(), pixel.end(), 0.0f);
    for (std::size_t rank = 0; rank < values.ranks[i].size(); ++rank)
    {
      const CoveredId& covered = values.ranks[i][rank];
      pixel[2 * rank] = covered.id == 0 ? 0.0f : this->Ids[covered.id - 1];
      pixel[2 * rank + 1] = covered.coverage;
    }
    for (std::uint32_t k = 0; k < values.pixels[i]; ++k)
    {
      append(array, pixel.data(), pixel.size());
    }
  }
  values.arrays.push_back(std::move(array));
}

std::vector<LayerArray> ArraySink::finish()
{
  std::vector<LayerArray> all;
  for (Values& values : this->Outputs)
  {
    if (!values.ranks.empty())
    {
      this->completeRanks(values);
    }
    for (LayerArray& array : values.arrays)
    {
      array.isImage = array.format.empty() && &array == &values.arrays.front();
      all.push_back(std::move(array));
    }
  }
  return all;
}

void requireArrayMemory(int width, int height, double bytes)
{
  constexpr double gigabyte = 1e9;
  const double there = double(::sysconf(_SC_PHYS_PAGES)) * double(::sysconf(_SC_PAGESIZE));
  if (bytes > there)
  {
    throw MachineError("not enough memory: arrays of " + std::to_string(width) + " x " + std::to_string(height) +
                       " pixels take " + std::to_string(std::uint64_t(bytes / gigabyte)) + " GB, and there are " +
                       std::to_string(std::uint64_t(there / gigabyte)));
  }
}

void requireMemory(const WorkPlan& plan, const Stage& stage, const Job& job)
{
  double needed = 0;
  int width = 0;
  int height = 0;
  for (const LayerOutput& output : outputsOf(plan, stage, job))
  {
    const bool isImage = std::any_of(output.formats.begin(), output.formats.end(),
      [&output](const std::string& format)
      { return spaceOf(output.spec, format, 1, 1).likely > 0 || format == "png"; });
    width = output.width;
    height = output.height;
    needed += isImage ? double(width) * height * output.spec.channels * double(bytesOf(output.spec.type)) : 0;
  }
  requireArrayMemory(width, height, needed);
}

} // namespace dgtk
