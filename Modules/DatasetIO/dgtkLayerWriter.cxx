// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLayerWriter.h"

#include "dgtkError.h"
#include "dgtkText.h"
#include "dgtkWriterEntry.h"

#include <cstdlib>

namespace dgtk
{

namespace
{
const WriterRow* findWriter(const std::string& format)
{
  for (const WriterRow& row : writerRows())
  {
    if (row.info.format == format)
    {
      return &row;
    }
  }
  return nullptr;
}

std::string formatList()
{
  std::vector<std::string> list;
  for (const WriterRow& row : writerRows())
  {
    list.push_back(row.info.format);
  }
  return joined(list);
}
} // namespace

const std::vector<WriterInfo>& layerWriters()
{
  static const std::vector<WriterInfo> infos = []
  {
    std::vector<WriterInfo> all;
    for (const WriterRow& row : writerRows())
    {
      all.push_back(row.info);
    }
    return all;
  }();
  return infos;
}

bool canWrite(const std::string& format, const LayerSpec& spec)
{
  const WriterRow* row = findWriter(format);
  return row && spec.channels >= 1 && row->entry->canWrite(spec);
}

bool holdsMatrices(const std::string& format)
{
  const WriterRow* row = findWriter(format);
  return row && row->entry->matrices;
}

PixelType storedType(const std::string& format, PixelType type)
{
  const WriterRow* row = findWriter(format);
  return row && row->entry->rounds && type == PixelType::Float64 ? PixelType::Float32 : type;
}

LayerSpec storedSpec(const std::string& format, const LayerSpec& spec)
{
  LayerSpec stored = spec;
  const WriterRow* row = findWriter(format);
  if (row && row->entry->marksNothing && spec.type == PixelType::UInt32 &&
      std::strtoul(spec.invalid.c_str(), nullptr, 10) > row->entry->largestId)
  {
    stored.invalid = std::to_string(row->entry->largestId);
  }
  return stored;
}

std::uint32_t largestStored(const std::string& format, const LayerSpec& spec)
{
  const WriterRow* row = findWriter(format);
  const std::uint32_t largest = row ? row->entry->largestId : 0;
  return storedSpec(format, spec).invalid == spec.invalid ? largest : largest - 1;
}

std::unique_ptr<LayerWriter> makeLayerWriter(const std::string& format, const FilePlace& path, const LayerSpec& spec,
  int width, int height, const LayerWriterContext& context)
{
  const WriterRow* row = findWriter(format);
  if (!row)
  {
    throw UsageError("no such format: " + quoted(format) + " (there are " + formatList() + ")");
  }
  if (!canWrite(format, spec))
  {
    throw UsageError("layer " + quoted(spec.name) + " (" + std::to_string(spec.channels) + " x " + nameOf(spec.type) +
                     ") cannot be written as " + format);
  }
  if (width < 1 || height < 1)
  {
    throw UsageError(path.path() + ": an image of " + std::to_string(width) + " x " + std::to_string(height) +
                     " pixels cannot be written");
  }
  return row->entry->open(path, spec, width, height, context);
}

} // namespace dgtk
