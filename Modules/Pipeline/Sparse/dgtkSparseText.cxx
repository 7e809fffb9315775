// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSparseText.h"

#include "dgtkError.h"
#include "dgtkText.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>

namespace dgtk
{

namespace
{
constexpr int largestImage = 1 << 20;
constexpr double largestId = 4294967295.0;

bool isSeparator(char c) { return c == ' ' || c == '\t' || c == ',' || c == '\r'; }

/// Calls act(line, number) for each line, numbered from 1, after a byte order mark.
void forLines(const std::string& text, const std::function<void(const std::string&, int)>& act)
{
  int number = 0;
  for (std::size_t begin = text.compare(0, 3, "\xef\xbb\xbf") == 0 ? 3 : 0; begin < text.size();)
  {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    act(text.substr(begin, end - begin), ++number);
    begin = end + 1;
  }
}

/// The numbers of a line without its comment.
std::vector<double> numbersOf(const std::string& whole, const std::string& what, const std::string& name, int number)
{
  const std::string line = whole.substr(0, whole.find('#'));
  std::vector<double> values;
  const char* const stop = line.data() + line.size();
  const char* at = std::find_if_not(line.data(), stop, isSeparator);
  for (; at != stop; at = std::find_if_not(at, stop, isSeparator))
  {
    double value = 0;
    const auto [next, error] = std::from_chars(at, stop, value);
    if (error != std::errc() || std::isinf(value) || (next != stop && !isSeparator(*next)))
    {
      throw InputError(name, number, what + ", found " + quoted(line) + ')');
    }
    values.push_back(value);
    at = next;
  }
  return values;
}

std::string viewLine(const char* word, const SparseView& view)
{
  return std::string("# ") + word + ' ' + view.camera + '@' + std::to_string(view.frame) + ' ' +
         std::to_string(view.width) + 'x' + std::to_string(view.height) + '\n';
}

bool parseInteger(const std::string& text, int least, int& value)
{
  const auto [next, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && next == text.data() + text.size() && value >= least;
}

/// "# from NAME@FRAME WxH"; other comments are no views.
bool parseView(std::string line, const std::string& word, SparseView& view)
{
  if (!line.empty() && line.back() == '\r')
  {
    line.pop_back();
  }
  const std::string start = "# " + word + ' ';
  const std::size_t blank = line.rfind(' ');
  const std::size_t at = line.rfind('@');
  const std::size_t cross = line.rfind('x');
  if (line.compare(0, start.size(), start) != 0 || blank == std::string::npos || at == std::string::npos ||
      at <= start.size() || blank < at || cross == std::string::npos || cross < blank)
  {
    return false;
  }
  view.camera = line.substr(start.size(), at - start.size());
  return parseInteger(line.substr(at + 1, blank - at - 1), 0, view.frame) &&
         parseInteger(line.substr(blank + 1, cross - blank - 1), 1, view.width) && view.width <= largestImage &&
         parseInteger(line.substr(cross + 1), 1, view.height) && view.height <= largestImage;
}

SparseMatch matchOf(const std::vector<double>& values, const std::string& name, int number)
{
  constexpr int lastClass = static_cast<int>(VisibilityClass::Behind);
  const bool valid = std::isfinite(values[0]) && std::isfinite(values[1]) && values[4] >= 0 && values[4] <= lastClass &&
                     values[4] == std::floor(values[4]) && values[5] >= 0 && values[5] <= largestId &&
                     values[5] == std::floor(values[5]);
  if (!valid)
  {
    throw InputError(name, number, "is not a match (expected a point, a class from 0 to 5 and the id of an object)");
  }
  SparseMatch match;
  match.from = { values[0], values[1] };
  match.to.pixel = { values[2], values[3] };
  match.to.visibility = static_cast<VisibilityClass>(static_cast<int>(values[4]));
  match.hit.object = static_cast<std::uint32_t>(values[5]);
  return match;
}
} // namespace

std::string sparseText(const SparseSet& set)
{
  std::string text = viewLine("from", set.from) + viewLine("to", set.to) + "# x y x' y' class object\n";
  for (const SparseMatch& match : set.matches)
  {
    text += shortest(match.from.x()) + ' ' + shortest(match.from.y()) + ' ' + shortest(match.to.pixel.x()) + ' ' +
            shortest(match.to.pixel.y()) + ' ' + std::to_string(static_cast<int>(match.to.visibility)) + ' ' +
            std::to_string(match.hit.object) + '\n';
  }
  return text;
}

std::vector<SparseSet> parseSparseText(const std::string& text, const std::string& name)
{
  std::vector<SparseSet> sets;
  SparseSet next;
  bool isNew = true;
  forLines(text,
    [&](const std::string& line, int number)
    {
      SparseView view;
      if (parseView(line, "from", view))
      {
        next.from = view;
        isNew = true;
        return;
      }
      if (parseView(line, "to", view))
      {
        next.to = view;
        isNew = true;
        return;
      }
      const std::vector<double> values =
        numbersOf(line, "is not a match (expected x y x' y' class object", name, number);
      if (values.empty())
      {
        return;
      }
      if (values.size() != 6)
      {
        throw InputError(name, number,
          "is not a match (expected x y x' y' class object, found " + std::to_string(values.size()) + " numbers)");
      }
      if (isNew)
      {
        sets.push_back(next);
        isNew = false;
      }
      sets.back().matches.push_back(matchOf(values, name, number));
    });
  return sets;
}

std::vector<Eigen::Vector2d> parsePoints(const std::string& text, const std::string& name, const SparseView& view)
{
  std::vector<Eigen::Vector2d> points;
  forLines(text,
    [&](const std::string& line, int number)
    {
      // Of a match, what is not its point may be nan.
      std::vector<double> values = numbersOf(line, "is not a point (expected two numbers", name, number);
      if (values.empty())
      {
        return;
      }
      const bool count = values.size() == 2 || values.size() == 6;
      if (!count || std::isnan(values[0]) || std::isnan(values[1]))
      {
        throw InputError(name, number,
          "is not a point (expected two numbers, found " + (count ? "nan" : std::to_string(values.size())) + ')');
      }
      if (!(values[0] >= 0 && values[1] >= 0 && values[0] <= view.width && values[1] <= view.height))
      {
        throw InputError(name, number,
          "point (" + shortest(values[0]) + ", " + shortest(values[1]) + ") is outside the image of camera " +
            quoted(view.camera) + " (expected 0 to " + std::to_string(view.width) + ", 0 to " +
            std::to_string(view.height) + ')');
      }
      points.emplace_back(values[0], values[1]);
    });
  return points;
}

} // namespace dgtk
