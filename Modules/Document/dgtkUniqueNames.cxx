// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkUniqueNames.h"

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr std::size_t mostDigits = 8; // of a number that is counted on
} // namespace

int UniqueNames::firstFree(Numbers& after, int number)
{
  int free = number;
  for (auto at = after.find(free); at != after.end(); at = after.find(free))
  {
    free = at->second;
  }
  // The next who comes this way goes there at once.
  for (auto at = after.find(number); at != after.end(); at = after.find(number))
  {
    number = at->second;
    at->second = free;
  }
  return free;
}

std::string UniqueNames::rename(const std::string& name)
{
  std::size_t& holders = this->Holders[name];
  if (holders <= 1)
  {
    holders = 1;
    return name;
  }
  --holders;
  // Light0 becomes Light1, tree-2 becomes tree-3, tree becomes tree-2: the names that .scene files imply.
  const std::size_t last = name.find_last_not_of("0123456789");
  const std::size_t digits = name.size() - (last == std::string::npos ? 0 : last + 1);
  const bool counted = digits > 0 && digits <= mostDigits;
  const std::string stem = counted ? name.substr(0, name.size() - digits) : name + '-';
  const std::size_t width = counted && name[name.size() - digits] == '0' ? digits : 1; // with zeros in front
  Numbers& after = this->After[stem + std::string(width - 1, '0')];
  for (int number = counted ? std::stoi(name.substr(name.size() - digits)) + 1 : 2;;)
  {
    number = firstFree(after, number);
    after[number] = number + 1;
    const std::string shown = std::to_string(number);
    std::string text = stem + std::string(width - std::min(width, shown.size()), '0') + shown;
    if (this->Holders.emplace(text, 1).second)
    {
      return text;
    }
  }
}

std::string uniqueName(const std::vector<std::string>& taken, const std::string& name)
{
  UniqueNames names;
  for (const std::string& other : taken)
  {
    names.add(other);
  }
  names.add(name);
  return names.rename(name);
}

} // namespace dgtk
