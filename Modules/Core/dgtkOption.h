// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkOption_h
#define dgtkOption_h

#include "dgtkCoreModule.h"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dgtk
{

/// What was chosen, as texts by the options' names. An option that is not among them has its default.
using OptionValues = std::map<std::string, std::string>;

/// An option: the row that the command line's parser and help, the keywords of Python, the fields of the editor, the
/// manifest and the list of options are made from.
struct DGTKCORE_EXPORT OptionRow
{
  enum class Kind
  {
    Switch,  ///< "on", "off"
    Integer, ///< least to most
    Choice,  ///< one of choices
    Names,   ///< separated by commas, of choices if there are any; "\," is a comma in a name
    Size,    ///< "WxH", each 1 to most
    Numbers  ///< count real numbers above leastNumber, separated by commas
  };
  Kind kind = Kind::Switch;
  std::string name;     ///< words joined by '_': "points_step"
  std::string value;    ///< what stands for its value in a help: "N"; "" for a switch
  std::string fallback; ///< the default; "" for none
  std::string help;     ///< one line, with the unit
  int least = 0;
  int most = 0;
  std::vector<std::string> choices = {};
  std::size_t count = 0;
  double leastNumber = 0;

  /// The text as it stands in a manifest. Throws UsageError, "points_step: expected ...", for one that is no value of
  /// the option.
  std::string normal(const std::string& given) const;
  /// What was chosen, or the default.
  std::string text(const OptionValues& values) const;
  bool isDefault(const OptionValues& values) const { return this->text(values) == this->fallback; }
};

struct DGTKCORE_EXPORT SwitchOption : OptionRow
{
  SwitchOption(const std::string& named, const std::string& says);
  bool of(const OptionValues& values) const;
};

struct DGTKCORE_EXPORT IntegerOption : OptionRow
{
  /// Without a default it has no value where it is not given.
  IntegerOption(const std::string& named, std::optional<int> usual, int from, int to, const std::string& says);
  std::optional<int> given(const OptionValues& values) const;
  int of(const OptionValues& values) const { return this->given(values).value_or(0); }
};

struct DGTKCORE_EXPORT ChoiceOption : OptionRow
{
  /// The first of the words is the default.
  ChoiceOption(const std::string& named, const std::vector<std::string>& words, const std::string& says);
  ChoiceOption(const std::string& named, const std::string& standsFor, const std::vector<std::string>& words,
    const std::string& says);
  std::string of(const OptionValues& values) const { return this->text(values); }
};

struct DGTKCORE_EXPORT NamesOption : OptionRow
{
  /// The first of the words, if there are any, is the default.
  NamesOption(const std::string& named, const std::string& standsFor, const std::string& says,
    const std::vector<std::string>& words = {});
  NamesOption(
    const std::string& named, const std::string& standsFor, const std::string& usual, const std::string& says);
  std::vector<std::string> of(const OptionValues& values) const;
};

struct DGTKCORE_EXPORT SizeOption : OptionRow
{
  SizeOption(const std::string& named, int usualWidth, int usualHeight, int to, const std::string& says);
  int width(const OptionValues& values) const;
  int height(const OptionValues& values) const;
};

struct DGTKCORE_EXPORT NumbersOption : OptionRow
{
  NumbersOption(
    const std::string& named, const std::string& standsFor, std::size_t number, double above, const std::string& says);
  /// None where it is not given.
  std::vector<double> of(const OptionValues& values) const;
};

/// A list of names as one text, and back. An empty text is no names; throws UsageError, which begins with `what`, for
/// an empty name.
DGTKCORE_EXPORT std::string joinedNames(const std::vector<std::string>& names);
DGTKCORE_EXPORT std::vector<std::string> splitNames(const std::string& text, const std::string& what);

} // namespace dgtk

#endif
