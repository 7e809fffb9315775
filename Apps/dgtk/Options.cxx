// SPDX-License-Identifier: BSD-3-Clause
#include "Options.h"

#include "dgtkError.h"
#include "dgtkOption.h"
#include "dgtkSystem.h"
#include "dgtkText.h"

#include <algorithm>
#include <charconv>

namespace dgtk::app
{

const Option noCacheOption{ "--no-cache", "", "", "read models anew, and keep none of them for other runs" };

namespace
{
const Option helpOption{ "--help", "", "", "show this page" };
const std::map<std::string, std::string> shortNames{ { "--output", "-o" }, { "--help", "-h" } };

const Option* find(const Command& command, const std::string& name)
{
  if (name == helpOption.name)
  {
    return &helpOption;
  }
  const auto found = std::find_if(
    command.options.begin(), command.options.end(), [&](const Option& option) { return option.name == name; });
  return found == command.options.end() ? nullptr : &*found;
}

/// Names may be written with '_' for '-'.
std::string longName(const std::string& word)
{
  const auto known =
    std::find_if(shortNames.begin(), shortNames.end(), [&](const auto& names) { return names.second == word; });
  std::string name = known != shortNames.end() ? known->first : word;
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

[[noreturn]] void unknownOption(const Command& command, const std::string& word)
{
  std::vector<std::string> names{ helpOption.name };
  for (const Option& option : command.options)
  {
    names.push_back(option.name);
  }
  const std::string near = nearest(word, names);
  throw UsageError("unknown option " + quoted(word) + (near.empty() ? "" : ", did you mean " + near + "?") +
                   " (see dgtk " + command.name + " --help)");
}
} // namespace

Arguments::Arguments(const Command& command, const std::vector<std::string>& words)
  : Self(command)
{
  bool optionsEnd = false;
  for (std::size_t i = 0; i < words.size(); ++i)
  {
    if (optionsEnd || words[i].size() < 2 || words[i][0] != '-')
    {
      this->Positional.push_back(words[i]);
      continue;
    }
    if (words[i] == "--")
    {
      optionsEnd = true;
      continue;
    }
    const std::size_t equals = words[i].find('=');
    const std::string name = longName(words[i].substr(0, equals));
    const Option* option = find(command, name);
    if (!option)
    {
      unknownOption(command, words[i]);
    }
    if (option->value.empty() && equals != std::string::npos)
    {
      throw UsageError(name + " takes no value");
    }
    if (!option->value.empty() && equals == std::string::npos && i + 1 == words.size())
    {
      throw UsageError(name + " needs a value: " + name + ' ' + option->value);
    }
    this->Values[name].push_back(option->value.empty()         ? ""
                                 : equals != std::string::npos ? words[i].substr(equals + 1)
                                                               : words[++i]);
  }
  const std::size_t count = this->Positional.size();
  if (!this->has("--help") && (count < command.least || count > command.most))
  {
    throw UsageError(std::string(count < command.least ? "too few" : "too many") + " arguments; usage: dgtk " +
                     command.name + ' ' + command.arguments + " [options] (see dgtk " + command.name + " --help)");
  }
}

std::string Arguments::text(const std::string& name) const
{
  const auto found = this->Values.find(name);
  if (found != this->Values.end())
  {
    return found->second.back();
  }
  const Option* option = find(this->Self, name);
  return option ? option->fallback : "";
}

std::vector<std::string> Arguments::all(const std::string& name) const
{
  const auto found = this->Values.find(name);
  return found != this->Values.end() ? found->second : std::vector<std::string>();
}

int parseInteger(const std::string& text, const std::string& what, int least, int most)
{
  int value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size() || value < least || value > most)
  {
    throw UsageError(what + ": expected an integer from " + std::to_string(least) + " to " + std::to_string(most) +
                     ", found " + quoted(text));
  }
  return value;
}

int Arguments::integer(const std::string& name, int least, int most) const
{
  return parseInteger(this->text(name), name, least, most);
}

int Arguments::threads() const
{
  constexpr int most = 1024;
  const int asked = this->has("--threads") ? this->integer("--threads", 0, most) : 0;
  return asked > 0 ? asked : machineThreads();
}

void Arguments::size(const std::string& name, int most, int& width, int& height) const
{
  const std::string text = this->text(name);
  const std::size_t x = text.find_first_of("xX");
  if (x == std::string::npos)
  {
    throw UsageError(name + ": expected WxH, for example 640x480, found " + quoted(text));
  }
  width = parseInteger(text.substr(0, x), name + " width", 1, most);
  height = parseInteger(text.substr(x + 1), name + " height", 1, most);
}

std::vector<std::string> Arguments::list(const std::string& name) const
{
  const std::string text = this->text(name);
  if (text.empty() && this->has(name)) // a variable that is not set must not mean all
  {
    throw UsageError(name + ": expected names, found ''");
  }
  return splitNames(text, name);
}

std::vector<Option> shownOptions(const Command& command)
{
  std::vector<Option> options = command.options;
  options.push_back(helpOption);
  return options;
}

std::string shortName(const std::string& name)
{
  const auto known = shortNames.find(name);
  return known == shortNames.end() ? "" : known->second;
}

std::string helpPage(const Command& command)
{
  const std::vector<Option> options = shownOptions(command);
  std::size_t width = 0;
  std::vector<std::string> left;
  for (const Option& option : options)
  {
    const std::string brief = shortName(option.name);
    left.push_back(
      (brief.empty() ? "    " : brief + ", ") + option.name + (option.value.empty() ? "" : ' ' + option.value));
    width = std::max(width, left.back().size());
  }
  std::string page = "usage: dgtk " + command.name + ' ' + command.arguments + " [options]\n\n" + command.help + "\n\n";
  for (std::size_t i = 0; i < options.size(); ++i)
  {
    page += "  " + left[i] + std::string(width + 2 - left[i].size(), ' ') + options[i].help +
            (options[i].fallback.empty() ? "" : " [" + options[i].fallback + ']') + '\n';
  }
  return page;
}

} // namespace dgtk::app
