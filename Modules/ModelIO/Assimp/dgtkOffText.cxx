// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkOffText.h"

#include <sstream>
#include <vector>

namespace dgtk::import
{

namespace
{
/// The words of the next line that has some, without comments; none at the end.
std::vector<std::string> nextWords(std::istream& in)
{
  std::vector<std::string> words;
  for (std::string line; words.empty() && std::getline(in, line);)
  {
    std::istringstream rest(line.substr(0, line.find('#')));
    for (std::string word; rest >> word;)
    {
      words.push_back(word);
    }
  }
  return words;
}

std::size_t numberOf(const std::string& word)
{
  std::size_t number = 0;
  std::istringstream(word) >> number;
  return number;
}
} // namespace

bool facesHaveColors(const std::string& text)
{
  std::istringstream in(text);
  std::vector<std::string> words = nextWords(in);
  const bool isNamed = !words.empty() && words[0].find("OFF") != std::string::npos;
  const bool hasDimension = isNamed && words[0].find('n') != std::string::npos;
  if (isNamed)
  {
    words.erase(words.begin());
  }
  for (int line = words.empty() ? 0 : 1; line < (hasDimension ? 2 : 1); ++line)
  {
    words = nextWords(in);
  }
  const std::size_t vertices = words.size() > 1 ? numberOf(words[0]) : 0;
  const std::size_t faces = words.size() > 1 ? numberOf(words[1]) : 0;
  for (std::size_t i = 0; i < vertices && !words.empty(); ++i)
  {
    words = nextWords(in);
  }
  for (std::size_t i = 0; i < faces && !words.empty(); ++i)
  {
    words = nextWords(in);
    if (!words.empty() && words.size() > numberOf(words[0]) + 1)
    {
      return true;
    }
  }
  return false;
}

} // namespace dgtk::import
