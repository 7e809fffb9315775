// SPDX-License-Identifier: BSD-3-Clause
#include "Commands.h"

#include "dgtkError.h"
#include "dgtkGLContext.h"
#include "dgtkGenerator.h"
#include "dgtkLayerWriter.h"
#include "dgtkModelReader.h"

#include <algorithm>
#include <functional>

namespace dgtk::app
{

namespace
{
using Row = std::vector<std::string>;

std::string joined(const std::vector<std::string>& words)
{
  std::string text;
  for (const std::string& word : words)
  {
    text += (text.empty() ? "" : ",") + word;
  }
  return text;
}

// Columns as wide as their widest cell; the last one is free.
std::string table(const std::vector<Row>& rows)
{
  std::vector<std::size_t> widths;
  for (const Row& row : rows)
  {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i)
    {
      widths[i] = std::max(widths[i], row[i].size());
    }
  }
  std::string text;
  for (const Row& row : rows)
  {
    std::string line = "  ";
    for (std::size_t i = 0; i < row.size(); ++i)
    {
      line += row[i] + (i + 1 < row.size() ? std::string(widths[i] + 2 - row[i].size(), ' ') : "");
    }
    text += line + '\n';
  }
  return text;
}

std::vector<Row> readers()
{
  std::vector<Row> rows;
  for (const ReaderInfo& reader : modelReaders())
  {
    rows.push_back({ reader.format, joined(reader.extensions), reader.description });
  }
  return rows;
}

std::vector<Row> layers()
{
  std::vector<Row> rows;
  for (const LayerInfo& layer : generatorLayers())
  {
    rows.push_back({ layer.layer, joined(layer.formats), layer.description });
  }
  return rows;
}

std::vector<Row> writers()
{
  std::vector<Row> rows;
  for (const WriterInfo& writer : layerWriters())
  {
    rows.push_back({ writer.format, writer.extension, writer.description });
  }
  return rows;
}

std::vector<Row> cameras()
{
  return { { "pinhole", "perspective, by vertical field of view or by K (off-centre, fx != fy)" },
    { "orthographic", "parallel projection" } };
}

std::vector<Row> gl()
{
  std::vector<Row> rows;
  for (const GLBackendInfo& backend : glBackends())
  {
    rows.push_back({ nameOf(backend.backend), backend.available ? "available" : "not available", backend.description });
  }
  return rows;
}

struct Section
{
  const char* name;
  std::vector<Row> (*rows)();
};
constexpr Section sections[] = { { "readers", &readers }, { "layers", &layers }, { "writers", &writers },
  { "cameras", &cameras }, { "gl", &gl } };

int run(const Arguments& arguments)
{
  const std::string wanted = arguments.positional().empty() ? "" : arguments.positional()[0];
  std::string text;
  std::vector<std::string> names;
  for (const Section& section : sections)
  {
    names.emplace_back(section.name);
    if (wanted == section.name)
    {
      text = table(section.rows());
    }
    else if (wanted.empty())
    {
      text += std::string(text.empty() ? "" : "\n") + section.name + ":\n" + table(section.rows());
    }
  }
  if (text.empty())
  {
    throw UsageError("list: expected one of " + joined(names) + ", found " + quoted(wanted));
  }
  print(text);
  return 0;
}
} // namespace

Command listCommand()
{
  return { "list", "[readers|layers|writers|cameras|gl]", 0, 1, "Lists what this program can read, derive and write.",
    {}, &run };
}

} // namespace dgtk::app
