// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkAppOptions_h
#define dgtkAppOptions_h

#include <map>
#include <string>
#include <vector>

namespace dgtk::app
{

/// One row of a command's table of options.
struct Option
{
  std::string name;                      ///< with its dashes: "--size"
  std::string value;                     ///< what stands for the value in the help, "" for a switch: "WxH"
  std::string fallback;                  ///< shown as the default; "" for none
  std::string help;                      ///< one line
  std::vector<std::string> choices = {}; ///< all words that it takes; none where they are not known beforehand
  bool many = false;                     ///< some of them, separated by commas
};

/// Switch of the commands that read models: without it, they use those that are kept for the user.
extern const Option noCacheOption;

/// A command: what it is called, what it takes, what it does.
struct Command
{
  std::string arguments; ///< "SCENE"
  std::size_t least;     ///< number of arguments
  std::size_t most;
  std::vector<Option> options;
  int (*run)(const class Arguments&);
  std::string name = {}; ///< of its row, see commandOf()
  std::string help = {}; ///< one line, of its row
};

/// The parsed command line of one command.
class Arguments
{
public:
  /// Throws UsageError for an unknown option (with the nearest known one), a missing or superfluous value, or a wrong
  /// number of arguments.
  Arguments(const Command& command, const std::vector<std::string>& words);

  const std::vector<std::string>& positional() const { return this->Positional; }
  bool has(const std::string& name) const { return this->Values.count(name) > 0; }
  /// The value given, or the option's fallback; "" where the command has no such option.
  std::string text(const std::string& name) const;
  /// The values of an option that may be repeated, as given.
  std::vector<std::string> all(const std::string& name) const;
  /// An integer in [least, most]; UsageError otherwise.
  int integer(const std::string& name, int least, int most) const;
  int threads() const; ///< of --threads, else as many as the machine has cores
  /// "WxH", each in [1, most].
  void size(const std::string& name, int most, int& width, int& height) const;
  /// Names, see splitNames().
  std::vector<std::string> list(const std::string& name) const;

private:
  const Command& Self;
  std::vector<std::string> Positional;
  std::map<std::string, std::vector<std::string>> Values;
};

/// The options that the help of a command shows: its own, then --help.
std::vector<Option> shownOptions(const Command& command);
/// "-o" of "--output"; "" for an option that has no short name.
std::string shortName(const std::string& name);
/// The page that `dgtk COMMAND --help` prints.
std::string helpPage(const Command& command);

/// An integer written in full; UsageError naming `what` otherwise.
int parseInteger(const std::string& text, const std::string& what, int least, int most);

} // namespace dgtk::app

#endif
