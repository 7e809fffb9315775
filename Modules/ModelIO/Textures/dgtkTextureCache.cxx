// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkText.h"
#include "dgtkTextureFile.h"
#include "dgtkTexturePixels.h"

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr std::size_t mostTextures = 4096;
}

/// A texture to decode.
struct TextureCache::Job
{
  std::size_t texture = 0;
  picture::Source source;
  bool isPicture = false;
  std::string problem;
};

TextureCache::TextureCache(const std::string& modelPath, const ReadOptions& options)
  : ModelPath(modelPath)
  , Finder(modelPath, options.sceneFolder)
  , Wanted(options.decodeTextures)
  , Store(options.textures || !options.decodeTextures ? options.textures : std::make_shared<TextureStore>())
{
}

int TextureCache::add(
  std::vector<Texture>& textures, const std::string& name, std::string& warning, const std::string& alternative)
{
  const auto known = this->ByName.find(name);
  if (known != this->ByName.end())
  {
    return known->second;
  }
  if (textures.size() >= mostTextures)
  {
    warning = "texture " + quoted(name) + " left out: more than " + std::to_string(mostTextures) + " textures";
    return -1;
  }
  std::string tried;
  std::string path = this->Finder.find(name, &tried);
  if (path.empty() && !alternative.empty())
  {
    path = this->Finder.find(alternative);
    tried += ", and " + quoted(alternative);
  }
  if (path.empty())
  {
    warning = "texture " + quoted(name) + " not found (tried " + tried + ")";
  }
  else if (this->Wanted)
  {
    picture::prepare();
  }
  const int index = static_cast<int>(textures.size());
  textures.push_back({ name, path, nullptr });
  this->ByName[name] = index;
  return index;
}

int TextureCache::addEmbedded(std::vector<Texture>& textures, const std::string& name, const EmbeddedPicture& picture)
{
  const int index = static_cast<int>(textures.size());
  textures.push_back({ name, this->ModelPath, nullptr });
  this->Embedded[index] = picture;
  return index;
}

/// What is there already is taken from the budget, and what names the same file as another once.
std::vector<TextureCache::Job> TextureCache::jobsOf(std::vector<Texture>& textures)
{
  std::vector<Job> jobs;
  for (; this->Decoded < textures.size(); ++this->Decoded)
  {
    Texture& texture = textures[this->Decoded];
    const auto embedded = this->Embedded.find(static_cast<int>(this->Decoded));
    if (texture.image)
    {
      this->Store->take(texture.path, texture.image->width, texture.image->height, texture.image->rgba.size());
    }
    else if (embedded != this->Embedded.end())
    {
      const EmbeddedPicture& picture = embedded->second;
      jobs.push_back({ this->Decoded, { texture.path, picture.extension, picture.bytes }, false, {} });
    }
    else if (!texture.path.empty() && this->ByPath.emplace(texture.path, nullptr).second)
    {
      jobs.push_back({ this->Decoded, { texture.path, extensionOf(texture.path), nullptr }, false, {} });
    }
  }
  return jobs;
}

std::vector<std::string> TextureCache::decode(std::vector<Texture>& textures)
{
  std::vector<std::string> warnings;
  if (!this->Wanted)
  {
    return warnings;
  }
  const std::size_t first = this->Decoded;
  std::vector<Job> jobs = this->jobsOf(textures);
  for (Job& job : jobs)
  {
    job.isPicture = job.source.bytes ? takeTexels(job.source, *this->Store, job.problem)
                                     : this->Store->reserve(job.source.path, job.problem);
  }
  for (Job& job : jobs)
  {
    Texture& texture = textures[job.texture];
    const bool embedded = job.source.bytes != nullptr;
    if (job.isPicture)
    {
      texture.image = embedded ? decodeTexels(job.source, AlphaRule::Meant, job.problem)
                               : this->Store->decode(job.source.path, job.problem);
    }
    if (!texture.image)
    {
      warnings.push_back("texture " + (embedded ? quoted(texture.name) + " in the file" : texture.path) +
                         " cannot be decoded: " + job.problem);
    }
    if (!embedded)
    {
      this->ByPath[texture.path] = texture.image;
    }
  }
  for (std::size_t i = first; i < textures.size(); ++i)
  {
    const auto known = this->ByPath.find(textures[i].path);
    textures[i].image = textures[i].image || known == this->ByPath.end() ? textures[i].image : known->second;
  }
  return warnings;
}

} // namespace dgtk
