// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkOption.h"

#include "dgtkError.h"
#include "dgtkText.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace dgtk
{

namespace
{
constexpr double largestNumber = 1e30;
constexpr const char* on = "on";
constexpr const char* off = "off";

template <typename T>
bool parse(const std::string& text, T& value)
{
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  return code == std::errc() && end == text.data() + text.size();
}

[[noreturn]] void refuse(const OptionRow& row, const std::string& expected, const std::string& text)
{
  throw UsageError(row.name + ": expected " + expected + ", found " + quoted(text));
}

std::string plainJoin(const std::vector<std::string>& words, const char* between)
{
  std::string text;
  for (const std::string& word : words)
  {
    text += (text.empty() ? "" : between) + word;
  }
  return text;
}

bool parse(const OptionRow& row, const std::string& text, int& value)
{
  return parse(text, value) && value >= row.least && value <= row.most;
}

int integerIn(const OptionRow& row, const std::string& text)
{
  int value = 0;
  if (!parse(row, text, value))
  {
    refuse(row, "an integer from " + std::to_string(row.least) + " to " + std::to_string(row.most), text);
  }
  return value;
}

bool switchIn(const OptionRow& row, const std::string& text)
{
  if (text != on && text != off && !text.empty())
  {
    refuse(row, "on or off", text);
  }
  return text != off;
}

std::pair<int, int> sizeIn(const OptionRow& row, const std::string& text)
{
  const std::size_t x = std::min(text.find_first_of("xX"), text.size());
  std::pair<int, int> size;
  if (!parse(row, text.substr(0, x), size.first) || !parse(row, text.substr(std::min(x + 1, text.size())), size.second))
  {
    refuse(row, row.value + ", each from 1 to " + std::to_string(row.most) + ", for example 640x480", text);
  }
  return size;
}

std::vector<std::string> namesIn(const OptionRow& row, const std::string& text)
{
  std::vector<std::string> names = splitNames(text, row.name);
  for (const std::string& name : names)
  {
    if (!row.choices.empty() && std::find(row.choices.begin(), row.choices.end(), name) == row.choices.end())
    {
      refuse(row, "some of " + plainJoin(row.choices, ","), name);
    }
  }
  return names;
}

std::vector<double> numbersIn(const OptionRow& row, const std::string& text)
{
  std::vector<double> values;
  for (const std::string& word : splitNames(text, row.name))
  {
    double value = 0;
    const bool right = parse(word, value) && value > row.leastNumber && value < largestNumber;
    values.push_back(right ? value : NAN);
  }
  const bool wrong = std::any_of(values.begin(), values.end(), [](double value) { return std::isnan(value); });
  if (values.size() != row.count || wrong)
  {
    refuse(row, row.value + ", all " + (row.leastNumber == 0 ? "above 0 and " : "") + "below 1e30", text);
  }
  return values;
}
} // namespace

std::string joinedNames(const std::vector<std::string>& names)
{
  std::string text;
  for (const std::string& name : names)
  {
    text += text.empty() ? "" : ",";
    for (const char c : name)
    {
      text += c == ',' || c == '\\' ? "\\" : "";
      text += c;
    }
  }
  return text;
}

std::vector<std::string> splitNames(const std::string& text, const std::string& what)
{
  std::vector<std::string> names;
  bool open = false; // a name has begun, or has to
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    if (!open)
    {
      names.emplace_back();
    }
    open = text[i] != ',';
    const bool escaped = text[i] == '\\' && i + 1 < text.size() && (text[i + 1] == ',' || text[i + 1] == '\\');
    if (open)
    {
      i += escaped ? 1 : 0;
      names.back() += text[i];
    }
  }
  const bool trailing = !text.empty() && !open;
  if (trailing || std::any_of(names.begin(), names.end(), [](const std::string& name) { return name.empty(); }))
  {
    throw UsageError(what + ": an empty name in " + quoted(text));
  }
  return names;
}

std::string OptionRow::normal(const std::string& given) const
{
  switch (this->kind)
  {
    case Kind::Switch:
      return switchIn(*this, given) ? on : off;
    case Kind::Integer:
      return std::to_string(integerIn(*this, given));
    case Kind::Choice:
      if (std::find(this->choices.begin(), this->choices.end(), given) == this->choices.end())
      {
        refuse(*this, "one of " + plainJoin(this->choices, ", "), given);
      }
      return given;
    case Kind::Names:
      return joinedNames(namesIn(*this, given));
    case Kind::Size:
    {
      const auto [wide, high] = sizeIn(*this, given);
      return std::to_string(wide) + 'x' + std::to_string(high);
    }
    case Kind::Numbers:
      break;
  }
  std::vector<std::string> words;
  for (const double number : numbersIn(*this, given))
  {
    words.push_back(shortest(number));
  }
  return plainJoin(words, ",");
}

std::string OptionRow::text(const OptionValues& values) const
{
  const auto found = values.find(this->name);
  return found == values.end() ? this->fallback : this->normal(found->second);
}

SwitchOption::SwitchOption(const std::string& named, const std::string& says)
  : OptionRow{ Kind::Switch, named, "", off, says }
{
}

bool SwitchOption::of(const OptionValues& values) const { return this->text(values) == on; }

IntegerOption::IntegerOption(
  const std::string& named, std::optional<int> usual, int from, int to, const std::string& says)
  : OptionRow{ Kind::Integer, named, "N", usual ? std::to_string(*usual) : "", says, from, to }
{
}

std::optional<int> IntegerOption::given(const OptionValues& values) const
{
  const std::string chosen = this->text(values);
  return chosen.empty() ? std::nullopt : std::optional<int>(integerIn(*this, chosen));
}

ChoiceOption::ChoiceOption(const std::string& named, const std::vector<std::string>& words, const std::string& says)
  : ChoiceOption(named, plainJoin(words, "|"), words, says)
{
}

ChoiceOption::ChoiceOption(const std::string& named, const std::string& standsFor,
  const std::vector<std::string>& words, const std::string& says)
  : OptionRow{ Kind::Choice, named, standsFor, words.front(), says, 0, 0, words }
{
}

NamesOption::NamesOption(const std::string& named, const std::string& standsFor, const std::string& says,
  const std::vector<std::string>& words)
  : OptionRow{ Kind::Names, named, standsFor, words.empty() ? "" : words.front(), says, 0, 0, words }
{
}

NamesOption::NamesOption(
  const std::string& named, const std::string& standsFor, const std::string& usual, const std::string& says)
  : OptionRow{ Kind::Names, named, standsFor, usual, says }
{
}

std::vector<std::string> NamesOption::of(const OptionValues& values) const
{
  return namesIn(*this, this->text(values));
}

SizeOption::SizeOption(const std::string& named, int usualWidth, int usualHeight, int to, const std::string& says)
  : OptionRow{ Kind::Size, named, "WxH", std::to_string(usualWidth) + 'x' + std::to_string(usualHeight), says, 1, to }
{
}

int SizeOption::width(const OptionValues& values) const { return sizeIn(*this, this->text(values)).first; }

int SizeOption::height(const OptionValues& values) const { return sizeIn(*this, this->text(values)).second; }

NumbersOption::NumbersOption(
  const std::string& named, const std::string& standsFor, std::size_t number, double above, const std::string& says)
  : OptionRow{ Kind::Numbers, named, standsFor, "", says, 0, 0, {}, number, above }
{
}

std::vector<double> NumbersOption::of(const OptionValues& values) const
{
  const std::string chosen = this->text(values);
  return chosen.empty() ? std::vector<double>() : numbersIn(*this, chosen);
}

} // namespace dgtk
