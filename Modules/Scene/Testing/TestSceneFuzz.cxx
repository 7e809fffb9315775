// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneSamples.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

using namespace dgtk;
using namespace dgtk::test;

namespace
{
constexpr int mutants = 2000;

std::string mutated(std::string text, std::mt19937& random)
{
  const std::string pieces[] = { "-", "nan", "1e999", "99999999999", "[", "]", "{", "}", "<", ">", "\"", ",", "\n", ":",
    std::string(1, '\0'), "\xff", "0", "/*", "//", "glObject_AC:", "\"objects\"", "1e-400", "\\u0000", "[[[[[[[[" };
  const auto below = [&random](std::size_t n) { return n == 0 ? 0 : random() % n; };
  for (std::size_t change = 0, changes = 1 + below(4); change < changes; ++change)
  {
    const std::size_t at = below(text.size() + 1);
    const std::size_t length = below(std::min<std::size_t>(text.size() - at, 40) + 1);
    switch (below(6))
    {
      case 0:
        text.resize(at);
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, pieces[below(std::size(pieces))]);
        break;
      case 3:
        text.insert(at, text.substr(below(text.size() + 1), 1 + below(200)));
        break;
      default:
        if (at < text.size())
        {
          const bool digit = text[at] >= '0' && text[at] <= '9';
          text[at] = digit ? char('0' + below(10)) : static_cast<char>(random());
        }
    }
  }
  return text;
}

/// Every mutant is a scene that can be written and read again, or an InputError of one line that names the file.
void tryMutants(const std::string& name, const std::vector<std::string>& seeds)
{
  std::mt19937 random(20061);
  const TemporaryFolder folder;
  int accepted = 0;
  std::set<std::string> messages;
  for (int i = 0; i < mutants; ++i)
  {
    const std::string text = mutated(seeds[std::size_t(i) % seeds.size()], random);
    try
    {
      const SceneDescription scene = readText(folder, name, text);
      ++accepted;
      const std::string json = toJson(scene, folder.path());
      EXPECT_EQ(toJson(readText(folder, "again.json", json), folder.path()), json);
    }
    catch (const InputError& error)
    {
      const std::string message = error.what();
      EXPECT_EQ(message.find(folder.path(name)), 0u) << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      messages.insert(message.substr(0, message.find("found")));
    }
  }
  EXPECT_GT(accepted, 10);
  EXPECT_GT(messages.size(), 20u);
}
} // namespace

TEST(SceneFuzz, MutatedThesisScenes) { tryMutants("a.scene", { thesisExample, richThesisScene }); }

TEST(SceneFuzz, MutatedJson)
{
  const TemporaryFolder folder;
  tryMutants("a.json", { richJson, toJson(readText(folder, "b.scene", richThesisScene), folder.path()) });
}
