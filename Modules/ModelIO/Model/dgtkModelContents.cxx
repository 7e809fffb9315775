// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelContents.h"

#include "dgtkError.h"
#include "dgtkText.h"
#include "dgtkTextLines.h"
#include "dgtkTextureFile.h"
#include "dgtkTexturePixels.h"

#include <map>
#include <tuple>

namespace dgtk
{

namespace
{
/// Makes the textures of a model of what it names, each file decoded once.
class PictureMaker
{
public:
  PictureMaker(ModelContents& contents, const ReadOptions& options)
    : Contents(contents)
    , Made(*contents.model)
    , Finder(contents.model->path, options.sceneFolder)
    , Wanted(options.decodeTextures)
    , Store(options.textures || !Wanted ? options.textures : std::make_shared<TextureStore>())
    , NotFound(contents.pictures.size())
  {
  }

  void run()
  {
    for (std::size_t i = 0; i < this->Contents.pictures.size(); ++i)
    {
      this->find(i);
    }
    if (this->Wanted)
    {
      this->decode();
    }
    for (std::size_t i = 0; i < this->Made.materials.size(); ++i)
    {
      this->settleAlpha(this->Contents.alpha[i], this->Made.materials[i]);
    }
    this->settleCutOuts();
    this->say();
  }

private:
  /// A picture to decode.
  struct Job
  {
    std::size_t texture = 0;
    picture::Source source;
    bool isPicture = false;
    std::string problem;
  };

  void find(std::size_t index)
  {
    const ModelPicture& picture = this->Contents.pictures[index];
    Texture texture;
    texture.name = picture.name;
    texture.wrap = picture.wrap;
    if (picture.isInFile())
    {
      texture.path = this->Made.path;
    }
    else
    {
      std::string tried;
      texture.path = this->Finder.find(picture.name, &tried);
      if (texture.path.empty() && !picture.unescaped.empty())
      {
        texture.name = picture.unescaped;
        texture.path = this->Finder.find(picture.unescaped, &tried);
      }
      if (texture.path.empty() && !picture.alternative.empty())
      {
        texture.path = this->Finder.find(picture.alternative);
        tried += ", and " + quoted(picture.alternative);
      }
      if (texture.path.empty())
      {
        this->NotFound[index] = "texture " + quoted(texture.name) + " not found (tried " + tried + ")";
      }
    }
    this->Made.textures.push_back(texture);
  }

  /// What is there already is taken from the budget, and what names the same file as another once.
  std::vector<Job> jobs()
  {
    std::vector<Job> jobs;
    for (std::size_t i = 0; i < this->Made.textures.size(); ++i)
    {
      Texture& texture = this->Made.textures[i];
      ModelPicture& picture = this->Contents.pictures[i];
      if (picture.same != ModelPicture::own)
      {
        continue;
      }
      if (picture.width > 0)
      {
        auto image = std::make_shared<Image>();
        image->width = picture.width;
        image->height = picture.height;
        image->rgba = std::move(picture.bytes);
        dgtk::settleAlpha(*image, AlphaRule::Meant);
        this->Store->take(texture.path, image->width, image->height, image->rgba.size());
        texture.image = image;
      }
      else if (picture.isInFile())
      {
        jobs.push_back({ i, { texture.path, picture.type, &picture.bytes }, false, {} });
      }
      else if (!texture.path.empty() && this->ByPath.emplace(texture.path, nullptr).second)
      {
        jobs.push_back({ i, { texture.path, extensionOf(texture.path), nullptr }, false, {} });
      }
    }
    return jobs;
  }

  /// First all sizes are counted, then pixels are made.
  void decode()
  {
    std::vector<Job> jobs = this->jobs();
    for (Job& job : jobs)
    {
      job.isPicture = job.source.bytes ? takeTexels(job.source, *this->Store, job.problem)
                                       : this->Store->reserve(job.source.path, job.problem);
    }
    for (Job& job : jobs)
    {
      Texture& texture = this->Made.textures[job.texture];
      const bool embedded = job.source.bytes != nullptr;
      if (job.isPicture)
      {
        texture.image = embedded ? decodeTexels(job.source, AlphaRule::Meant, job.problem)
                                 : this->Store->decode(job.source.path, job.problem);
      }
      if (!texture.image)
      {
        this->NotDecoded.push_back("texture " + (embedded ? quoted(texture.name) + " in the file" : texture.path) +
                                   " cannot be decoded: " + job.problem);
      }
      if (!embedded)
      {
        this->ByPath[texture.path] = texture.image;
      }
    }
    for (std::size_t i = 0; i < this->Made.textures.size(); ++i)
    {
      Texture& texture = this->Made.textures[i];
      const std::int32_t same = this->Contents.pictures[i].same;
      if (same != ModelPicture::own)
      {
        texture.image = this->Made.textures[static_cast<std::size_t>(same)].image;
        continue;
      }
      const auto known = this->ByPath.find(texture.path);
      const bool isFile = !this->Contents.pictures[i].isInFile();
      texture.image = isFile && known != this->ByPath.end() ? known->second : texture.image;
    }
  }

  /// Model has one cut-off, 0.5, and no other use of alpha: a picture that means something else by it is remade.
  void settleAlpha(const MaterialAlpha& alpha, Material& material)
  {
    if (alpha.use == AlphaUse::Holes)
    {
      return;
    }
    const bool mask = alpha.use == AlphaUse::CutOff;
    const double cutOff = mask ? alpha.cutOff : 0;
    const double opacity = mask ? material.opacity : 1;
    material.opacity = 1;
    const std::shared_ptr<const Image> image = this->imageOf(material);
    if (!image || !image->hasAlpha || (mask && cutOff == 0.5 && opacity == 1))
    {
      return;
    }
    const auto [known, isNew] = this->Remade.try_emplace({ material.texture, cutOff, opacity }, 0);
    if (isNew)
    {
      auto remade = std::make_shared<Image>(*image);
      for (std::size_t i = 3; i < remade->rgba.size(); i += 4)
      {
        remade->rgba[i] = remade->rgba[i] * opacity / 255 >= cutOff ? 255 : 0;
      }
      dgtk::settleAlpha(*remade, AlphaRule::Meant);
      Texture texture = this->Made.textures[static_cast<std::size_t>(material.texture)];
      texture.image = remade;
      known->second = static_cast<int>(this->Made.textures.size());
      this->Made.textures.push_back(texture);
    }
    material.texture = known->second;
  }

  std::shared_ptr<const Image> imageOf(const Material& material) const
  {
    return material.texture < 0 ? nullptr : this->Made.textures[static_cast<std::size_t>(material.texture)].image;
  }

  void settleCutOuts()
  {
    std::map<const Image*, bool> known;
    for (Material& material : this->Made.materials)
    {
      const std::shared_ptr<const Image> image = this->imageOf(material);
      const auto [entry, isNew] = known.try_emplace(image.get(), false);
      entry->second = isNew && image ? isCutOut(*image) : entry->second;
      material.cutOut = entry->second;
    }
    for (Texture& texture : this->Made.textures)
    {
      texture.name = validUtf8(texture.name);
    }
  }

  void say()
  {
    std::size_t more = this->Contents.moreNotes;
    std::vector<std::string>& lines = this->Made.warnings;
    const auto add = [&](const std::string& line)
    {
      if (!line.empty() && lines.size() < mostModelWarnings)
      {
        lines.push_back(validUtf8(line));
      }
      else if (!line.empty())
      {
        ++more;
      }
    };
    for (const ModelNote& note : this->Contents.notes)
    {
      add(note.picture >= 0 ? this->NotFound[static_cast<std::size_t>(note.picture)] : note.text);
      for (std::size_t i = 0; note.picture == ModelNote::ofDecoding && i < this->NotDecoded.size(); ++i)
      {
        add(this->NotDecoded[i]);
      }
    }
    if (more > 0)
    {
      lines.push_back("and " + std::to_string(more) + (more == 1 ? " more warning" : " more warnings"));
    }
  }

  ModelContents& Contents;
  Model& Made;
  TextureFinder Finder;
  bool Wanted;
  std::shared_ptr<TextureStore> Store;
  std::vector<std::string> NotFound; ///< a line a picture, "" for those that were found
  std::vector<std::string> NotDecoded;
  std::map<std::string, std::shared_ptr<const Image>> ByPath;
  std::map<std::tuple<int, double, double>, int> Remade; ///< (texture, cut-off, opacity)
};
} // namespace

std::shared_ptr<Model> withPictures(ModelContents contents, const ReadOptions& options)
{
  PictureMaker(contents, options).run();
  return contents.model;
}

} // namespace dgtk
