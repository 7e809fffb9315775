// SPDX-License-Identifier: BSD-3-Clause
#include "Commands.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkSparseText.h"
#include "dgtkUtf8.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <iterator>

namespace dgtk::app
{

namespace
{
constexpr int largestPicture = 1 << 20;
const char* const classNames[] = { "no surface", "visible", "occluded", "self-occluded", "outside", "behind" };

/// "CAM" or "CAM@FRAME"; a name may hold an @.
void parseView(const std::string& text, const std::string& option, const Stage& stage, std::size_t& camera, int& frame)
{
  const std::vector<std::string> names = stage.cameraNames();
  const SceneDescription& scene = stage.description();
  frame = scene.firstFrame();
  auto found = std::find(names.begin(), names.end(), text);
  const std::size_t at = text.rfind('@');
  if (found == names.end() && at != std::string::npos)
  {
    found = std::find(names.begin(), names.end(), text.substr(0, at));
    frame = parseInteger(text.substr(at + 1), option + ": frame", scene.firstFrame(), scene.lastFrame());
  }
  if (found == names.end())
  {
    throw UsageError(option + ": the scene has no camera " + quoted(text.substr(0, at)));
  }
  camera = static_cast<std::size_t>(found - names.begin());
}

SparseView named(const Stage& stage, std::size_t camera, int frame, const SparseRequest& request)
{
  const View view = stage.view(camera, frame, request.width, request.height);
  return { view.name, frame, view.model->width(), view.model->height() };
}

std::string asText(const Stage& stage, const SparseRequest& request, const std::vector<SparseMatch>& matches)
{
  return sparseText({ named(stage, request.fromCamera, request.fromFrame, request),
    named(stage, request.toCamera, request.toFrame, request), matches });
}

std::string asJson(const std::vector<SparseMatch>& matches, const Stage& stage)
{
  const std::vector<std::string> objects = stage.objectNames();
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const SparseMatch& match : matches)
  {
    nlohmann::ordered_json item;
    item["from"] = { match.from.x(), match.from.y() };
    const bool somewhere = std::isfinite(match.to.pixel.x());
    item["to"] = somewhere ? nlohmann::ordered_json{ match.to.pixel.x(), match.to.pixel.y() } : nullptr;
    const int kind = static_cast<int>(match.to.visibility);
    item["class"] = kind;
    item["visibility"] = classNames[kind];
    item["object"] = match.hit.object;
    if (match.hit.object != 0)
    {
      item["name"] = utf8FromBytes(objects[match.hit.object - 1]);
    }
    list.push_back(item);
  }
  return nlohmann::ordered_json{ { "matches", list } }.dump(2) + '\n';
}

int runCorrespond(const Arguments& arguments)
{
  for (const char* const option : { "--from", "--to", "--points" })
  {
    if (!arguments.has(option))
    {
      throw UsageError(std::string("correspond needs ") + option + " (see dgtk correspond --help)");
    }
  }
  const auto stage = Stage::load(readScene(arguments.positional()[0]),
    [](const std::string& line) { std::cerr << "dgtk: warning: " << line << '\n'; });
  SparseRequest request;
  parseView(arguments.text("--from"), "--from", *stage, request.fromCamera, request.fromFrame);
  parseView(arguments.text("--to"), "--to", *stage, request.toCamera, request.toFrame);
  if (arguments.has("--size"))
  {
    arguments.size("--size", largestPicture, request.width, request.height);
  }
  const std::string file = arguments.text("--points");
  const std::string text = file == "-"
                             ? std::string(std::istreambuf_iterator<char>(std::cin), std::istreambuf_iterator<char>())
                             : readFile(file);
  const SparseView from = named(*stage, request.fromCamera, request.fromFrame, request);
  const std::vector<SparseMatch> matches =
    correspondPoints(*stage, request, parsePoints(text, file == "-" ? "standard input" : file, from));
  print(arguments.has("--json") ? asJson(matches, *stage) : asText(*stage, request, matches));
  return 0;
}
} // namespace

Command correspondCommand()
{
  Command command{ "SCENE", 1, 1, {}, &runCorrespond };
  command.options = { { "--from", "CAM[@FRAME]", "", "first view (default frame: the scene's first)" },
    { "--to", "CAM[@FRAME]", "", "second view" },
    { "--points", "FILE|-", "", "image points x y, one a line, in pixels; - reads standard input" },
    { "--size", "WxH", "", "size of the images in pixels (default: the camera's own, else 640x480)" },
    { "--json", "", "", "print JSON" }, noCacheOption };
  return command;
}

} // namespace dgtk::app
