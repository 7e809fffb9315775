// SPDX-License-Identifier: BSD-3-Clause
#include "Commands.h"

#include "dgtkCameraEntry.h"
#include "dgtkError.h"
#include "dgtkExport.h"
#include "dgtkExporterEntry.h"
#include "dgtkGenerator.h"
#include "dgtkLayerWriter.h"
#include "dgtkModelReader.h"
#include "dgtkRenderGLCalls.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace dgtk::app
{

namespace
{
using Row = std::vector<std::string>;
using Json = nlohmann::ordered_json;

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

std::vector<Row> allCommands()
{
  std::vector<Row> rows;
  for (const CommandRow& row : commandRows())
  {
    rows.push_back({ row.name, row.make().arguments, row.help });
  }
  return rows;
}

std::vector<Row> readers()
{
  std::vector<Row> rows;
  for (const ReaderInfo& reader : modelReaders())
  {
    rows.push_back({ reader.format, joinedNames(reader.extensions), reader.description });
  }
  return rows;
}

std::vector<Row> layers()
{
  std::vector<Row> rows;
  for (const LayerInfo& layer : generatorLayers())
  {
    rows.push_back({ layer.layer, joinedNames(layer.formats), layer.description });
  }
  return rows;
}

std::vector<Row> options()
{
  std::vector<Row> rows;
  for (const OptionRow* option : allOptions())
  {
    rows.push_back({ option->name, option->value, option->value.empty() ? "" : option->fallback, option->help });
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
  std::vector<Row> rows;
  for (const CameraRow& camera : cameraRows())
  {
    rows.push_back({ camera.model, camera.description });
  }
  return rows;
}

std::vector<Row> exporters()
{
  std::vector<Row> rows;
  for (const ExporterRow& row : exporterRows())
  {
    rows.push_back({ row.info.name, joinedNames(row.make()->needs({}).layers), row.info.description });
  }
  return rows;
}

std::vector<Row> gl()
{
  std::vector<Row> rows;
  for (const GLBackendInfo& backend : renderGL().glBackends())
  {
    rows.push_back(
      { renderGL().nameOf(backend.backend), backend.available ? "available" : "not available", backend.description });
  }
  return rows;
}

Json outputsOf(const LayerInfo& layer)
{
  Json outputs = Json::array();
  for (const LayerRecord& record : layer.records)
  {
    const LayerSpec& spec = record.spec;
    outputs.push_back({ { "name", spec.name }, { "format", record.format }, { "type", nameOf(spec.type) },
      { "channels", spec.channels }, { "unit", spec.unit }, { "frame", spec.frame }, { "invalid", spec.invalid },
      { "meaning", nameOf(spec.meaning) }, { "description", spec.description } });
  }
  return outputs;
}

void describeLayers(Json& rows)
{
  const std::vector<LayerInfo> infos = generatorLayers();
  for (std::size_t i = 0; i < infos.size(); ++i)
  {
    rows[i]["outputs"] = outputsOf(infos[i]);
    rows[i]["options"] = Json::array();
    for (const OptionRow* option : infos[i].options)
    {
      rows[i]["options"].push_back(option->name);
    }
  }
}

/// Size, pose, near and far are not among the parameters: all cameras have them.
void describeCameras(Json& rows)
{
  for (Json& row : rows)
  {
    row["parameters"] = Json::array();
    for (const CameraParameter& parameter : findCamera(row["model"].get<std::string>())->parameters)
    {
      row["parameters"].push_back(
        { { "name", parameter.name }, { "unit", parameter.unit }, { "description", parameter.help },
          { "counts", parameter.counts }, { "default", parameter.usual }, { "moves", parameter.moves } });
    }
  }
}

void describeOption(Json& row, const OptionRow& option)
{
  static const char* const kinds[] = { "switch", "integer", "choice", "names", "size", "numbers" };
  row["kind"] = kinds[static_cast<int>(option.kind)];
  if (option.most > 0)
  {
    row["least"] = option.least;
    row["most"] = option.most;
  }
  if (!option.choices.empty())
  {
    row["choices"] = option.choices;
  }
}

void describeOptions(Json& rows)
{
  for (Json& row : rows)
  {
    describeOption(row, requestOption(row["name"].get<std::string>()));
  }
}

/// Options that a format has beside those of all.
void describeExporters(Json& rows)
{
  for (Json& row : rows)
  {
    row["options"] = Json::array();
    for (const OptionRow* option : findExporter(row["format"].get<std::string>()).make()->options())
    {
      Json described{ { "name", option->name }, { "value", option->value }, { "default", option->fallback },
        { "help", option->help } };
      describeOption(described, *option);
      row["options"].push_back(described);
    }
  }
}

Json describeOption(const Option& option)
{
  Json row{ { "name", option.name } };
  if (const std::string brief = shortName(option.name); !brief.empty())
  {
    row["short"] = brief;
  }
  row["value"] = option.value;
  row["default"] = option.fallback;
  row["help"] = option.help;
  if (!option.choices.empty())
  {
    row["choices"] = option.choices;
    row["many"] = option.many;
  }
  return row;
}

void describeCommands(Json& rows)
{
  const std::vector<CommandRow>& all = commandRows();
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    rows[i]["options"] = Json::array();
    for (const Option& option : shownOptions(all[i].make()))
    {
      rows[i]["options"].push_back(describeOption(option));
    }
  }
}

struct Section
{
  const char* name;
  std::vector<Row> (*rows)();
  Row columns;                            ///< keys of JSON
  void (*describe)(Json& rows) = nullptr; ///< adds what a line has no room for
};

Json jsonOf(const Section& section)
{
  Json list = Json::array();
  for (const Row& row : section.rows())
  {
    Json object;
    for (std::size_t i = 0; i < row.size(); ++i)
    {
      object[section.columns[i]] = row[i];
    }
    list.push_back(object);
  }
  if (section.describe != nullptr)
  {
    section.describe(list);
  }
  return list;
}

const std::vector<Section>& sections()
{
  static const std::vector<Section> all{ { "readers", &readers, { "format", "extensions", "description" } },
    { "layers", &layers, { "layer", "formats", "description" }, &describeLayers },
    { "options", &options, { "name", "value", "default", "help" }, &describeOptions },
    { "writers", &writers, { "format", "extension", "description" } },
    { "cameras", &cameras, { "model", "description" }, &describeCameras },
    { "exporters", &exporters, { "format", "layers", "description" }, &describeExporters },
    { "gl", &gl, { "backend", "state", "description" } },
    { "commands", &allCommands, { "command", "arguments", "help" }, &describeCommands } };
  return all;
}

int runList(const Arguments& arguments)
{
  const std::string wanted = arguments.positional().empty() ? "" : arguments.positional()[0];
  std::string text;
  Json json;
  std::vector<std::string> names;
  for (const Section& section : sections())
  {
    names.emplace_back(section.name);
    if (!wanted.empty() && wanted != section.name)
    {
      continue;
    }
    text += (wanted.empty() ? (text.empty() ? "" : "\n") + names.back() + ":\n" : "") + table(section.rows());
    json[section.name] = arguments.has("--json") ? jsonOf(section) : Json();
  }
  if (text.empty())
  {
    throw UsageError("list: expected one of " + joinedNames(names) + ", found " + quoted(wanted));
  }
  print(arguments.has("--json") ? json.dump(2) + '\n' : text);
  return 0;
}
} // namespace

Command listCommand()
{
  return { "[readers|layers|options|writers|cameras|exporters|gl|commands]", 0, 1,
    { { "--json", "", "", "as JSON, with all that is known of commands, layers and options" } }, &runList };
}

} // namespace dgtk::app
