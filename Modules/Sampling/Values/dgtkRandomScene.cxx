// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRandomScene.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkHash.h"
#include "dgtkSceneRandom.h"
#include "dgtkText.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace dgtk
{

namespace fs = std::filesystem;

namespace
{
constexpr std::uint64_t largestFile = std::uint64_t(256) << 20;
constexpr Range seeds{ 0, 0x1p53 - 1, false, false, "a whole number from 0 to 2^53 - 1" };

std::vector<std::string> namesIn(const fs::path& folder, const std::string& pattern)
{
  std::vector<std::string> names;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.empty() ? "." : folder, error))
  {
    const std::string name = entry.path().filename().string();
    if (isLike(name, pattern) && (name[0] != '.' || pattern[0] == '.'))
    {
      names.push_back(name);
    }
  }
  return names;
}

void forgetLines(JsonNode& node)
{
  node.line = 0;
  std::for_each(node.children.begin(), node.children.end(), forgetLines);
}

void findPlaces(
  const JsonNode& node, const std::string& key, const std::string& path, std::vector<RandomScene::Place>& into)
{
  const std::string word = randomWordOf(key, node);
  if (!word.empty())
  {
    into.push_back({ path, word, node.line });
    return;
  }
  if (node.type == JsonNode::Type::String && node.text.size() > 1 && node.text[0] == '$' && node.text[1] != '$')
  {
    into.push_back({ path, node.text, node.line });
  }
  for (std::size_t i = 0; node.type == JsonNode::Type::Object && i + 1 < node.children.size(); i += 2)
  {
    const std::string& name = node.children[i].text;
    findPlaces(node.children[i + 1], name, path.empty() ? name : path + '.' + name, into);
  }
  for (std::size_t i = 0; node.type == JsonNode::Type::Array && i < node.children.size(); ++i)
  {
    findPlaces(node.children[i], {}, path + '[' + std::to_string(i) + ']', into);
  }
}

void findRules(const JsonNode& root, const std::string& list, const std::vector<std::string>& keys,
  std::vector<RandomScene::Place>& into)
{
  const JsonNode* const items = root.find(list);
  for (std::size_t i = 0; items != nullptr && items->type == JsonNode::Type::Array && i < items->children.size(); ++i)
  {
    for (const std::string& key : keys)
    {
      if (const JsonNode* const rule = items->children[i].find(key))
      {
        into.push_back({ list + '[' + std::to_string(i) + "]." + key, key, rule->line });
      }
    }
  }
}
} // namespace

bool isLike(const std::string& name, const std::string& pattern)
{
  std::size_t n = 0;
  std::size_t p = 0;
  std::size_t star = std::string::npos; // the last one, and what it covers up to
  std::size_t covered = 0;
  while (n < name.size())
  {
    if (p < pattern.size() && pattern[p] == '*')
    {
      star = p++;
      covered = n;
    }
    else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n]))
    {
      ++p;
      ++n;
    }
    else if (star != std::string::npos)
    {
      p = star + 1;
      n = ++covered;
    }
    else
    {
      return false;
    }
  }
  return std::all_of(pattern.begin() + std::ptrdiff_t(p), pattern.end(), [](char c) { return c == '*'; });
}

std::vector<std::string> filesLike(const std::string& pattern, const std::string& folder)
{
  std::vector<std::string> found{ "" };
  for (const fs::path& part : fs::path(pattern))
  {
    std::vector<std::string> longer;
    for (const std::string& before : found)
    {
      const std::string word = part.string();
      const bool isPattern = word.find_first_of("*?") != std::string::npos;
      const fs::path holder = fs::path(folder) / before;
      for (const std::string& name : isPattern ? namesIn(holder, word) : std::vector<std::string>{ word })
      {
        longer.push_back((fs::path(before) / name).string());
      }
    }
    found = std::move(longer);
  }
  const auto isNoFile = [&folder](const std::string& path)
  {
    std::error_code error;
    return !fs::is_regular_file(fs::path(folder) / path, error);
  };
  found.erase(std::remove_if(found.begin(), found.end(), isNoFile), found.end());
  std::sort(found.begin(), found.end());
  return found;
}

std::shared_ptr<const RandomScene> RandomScene::read(const std::string& path)
{
  const std::string extension = extensionOf(path);
  if (extension != "json")
  {
    throw InputError(
      path, "is no scene that can be random", "a name in .json", extension.empty() ? "none" : '.' + extension);
  }
  return std::shared_ptr<const RandomScene>(
    new RandomScene(path, fs::path(path).parent_path().string(), readFile(path, largestFile)));
}

std::shared_ptr<const RandomScene> RandomScene::ofText(const std::string& json, const std::string& folder)
{
  return std::shared_ptr<const RandomScene>(new RandomScene({}, folder, json));
}

RandomScene::RandomScene(const std::string& file, const std::string& folder, const std::string& contents)
  : Document(parseJson(file.empty() ? "scene" : file, contents))
  , File(file)
  , Folder(folder)
{
  if (file.empty())
  {
    forgetLines(this->Document.root);
  }
  this->Sha256 = dgtk::Sha256::of(contents);
  const JsonCursor root(this->Document);
  root.memberCount();
  this->Seed = root.has("seed") ? std::uint64_t(root["seed"].wholeNumber(seeds)) : 0;
  this->Stratify = root.has("stratify") && root["stratify"].boolean();
  this->Up = root.has("upAxis") && root["upAxis"].oneOf({ "y", "z" }) == 1 ? UpAxis::Z : UpAxis::Y;
}

const std::vector<std::string>& RandomScene::files(const std::string& pattern) const
{
  const std::lock_guard<std::mutex> guard(this->Lock);
  const auto known = this->Found.find(pattern);
  return known != this->Found.end() ? known->second
                                    : this->Found.emplace(pattern, filesLike(pattern, this->Folder)).first->second;
}

std::map<std::string, std::vector<std::string>> RandomScene::foundFiles() const
{
  const std::lock_guard<std::mutex> guard(this->Lock);
  return this->Found;
}

std::vector<RandomScene::Place> RandomScene::places() const
{
  std::vector<Place> all;
  findPlaces(this->Document.root, {}, {}, all);
  findRules(this->Document.root, "objects", randomObjectKeys(), all);
  findRules(this->Document.root, "cameras", randomCameraKeys(), all);
  std::stable_sort(all.begin(), all.end(), [](const Place& a, const Place& b) { return a.line < b.line; });
  return all;
}

} // namespace dgtk
