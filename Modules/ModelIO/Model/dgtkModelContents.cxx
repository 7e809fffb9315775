// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelContents.h"

#include "dgtkError.h"
#include "dgtkText.h"
#include "dgtkTextLines.h"
#include "dgtkTextureFile.h"
#include "dgtkTexturePixels.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <tuple>

namespace dgtk
{

namespace
{
namespace fs = std::filesystem;

/// A channel of a picture of which another one of `width` x `height` is made: interpolated between the middles of its
/// texels, its border goes on.
double sampled(const Image& image, int channel, int x, int y, int width, int height)
{
  const auto between = [](int at, int size, int from)
  {
    const double place = std::clamp((at + 0.5) * from / size - 0.5, 0.0, from - 1.0);
    const int low = std::min(static_cast<int>(place), std::max(from - 2, 0));
    return std::tuple(low, std::min(low + 1, from - 1), place - low);
  };
  const auto texel = [&](int i, int j) {
    return double(image.rgba[4 * (std::size_t(j) * std::size_t(image.width) + std::size_t(i)) + std::size_t(channel)]);
  };
  if (image.width == width && image.height == height)
  {
    return texel(x, y);
  }
  const auto [left, right, u] = between(x, width, image.width);
  const auto [top, bottom, v] = between(y, height, image.height);
  return (texel(left, top) * (1 - u) + texel(right, top) * u) * (1 - v) +
         (texel(left, bottom) * (1 - u) + texel(right, bottom) * u) * v;
}

/// `own`, or white, with the alpha that a mask has.
std::shared_ptr<Image> maskedImage(
  const Image* own, const Image& mask, const MaterialAlpha& alpha, int width, int height)
{
  const MaskValue usual = mask.hasAlpha ? MaskValue::Alpha : MaskValue::Luminance;
  const MaskValue value = alpha.value == MaskValue::Usual ? usual : alpha.value;
  auto made = std::make_shared<Image>();
  made->width = width;
  made->height = height;
  made->rgba.reserve(std::size_t(4) * std::size_t(width) * std::size_t(height));
  const auto add = [&made](double level) { made->rgba.push_back(static_cast<std::uint8_t>(level + 0.5)); };
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      for (int c = 0; c < 3; ++c)
      {
        add(own == nullptr ? 255 : sampled(*own, c, x, y, width, height));
      }
      const auto of = [&](int c) { return sampled(mask, c, x, y, width, height); };
      const double level = value == MaskValue::Luminance ? 0.2126 * of(0) + 0.7152 * of(1) + 0.0722 * of(2)
                                                         : of(static_cast<int>(value)); // Rec. ITU-R BT.709
      add(alpha.inverse > 0 ? 255 - alpha.inverse * level : level);
    }
  }
  settleAlpha(*made, AlphaRule::Meant);
  return made;
}

/// Some texels, or all, are not there.
bool hasHoles(const Image& image)
{
  std::uint8_t least = 255;
  for (std::size_t i = 3; i < image.rgba.size(); i += 4)
  {
    least = std::min(least, image.rgba[i]);
  }
  return least < 128;
}

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
      this->mask(this->Contents.alpha[i], this->Made.materials[i]);
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
    TextureUse use = TextureUse::Color;
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
      texture.path = this->findInFolder(picture);
      texture.path = texture.path.empty() ? this->Finder.find(picture.name, &tried) : texture.path;
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

  /// Path of a picture that is in the folder of its alternative, as it is written.
  std::string findInFolder(const ModelPicture& picture)
  {
    std::string written = isInFolder(picture.alternative, picture.name) ? picture.alternative : "";
    std::replace(written.begin(), written.end(), '\\', '/');
    const std::string found = this->Finder.find(written);
    return found == (fs::path(this->Made.path).parent_path() / written).lexically_normal() ? found : std::string();
  }

  /// Data are the pictures that no material has for a colour, nor for a mask.
  std::vector<TextureUse> uses() const
  {
    std::vector<TextureUse> uses(this->Contents.pictures.size(), TextureUse::Color);
    const auto set = [&](int texture, TextureUse use)
    {
      if (texture >= 0)
      {
        const std::int32_t same = this->Contents.pictures.at(std::size_t(texture)).same;
        uses.at(std::size_t(same == ModelPicture::own ? texture : same)) = use;
      }
    };
    for (const TextureUse use : { TextureUse::Data, TextureUse::Color })
    {
      for (std::size_t i = 0; i < this->Made.materials.size(); ++i)
      {
        for (const auto texture : materialTextures)
        {
          if (useOf(texture) == use)
          {
            set(this->Made.materials[i].*texture, use);
          }
        }
        set(use == TextureUse::Color ? this->Contents.alpha[i].mask : -1, use);
      }
    }
    for (std::size_t i = 0; i < uses.size(); ++i)
    {
      const std::int32_t same = this->Contents.pictures[i].same;
      uses[i] = same == ModelPicture::own ? uses[i] : uses.at(std::size_t(same));
    }
    return uses;
  }

  /// What is there already is taken from the budget, and what names the same file as another once.
  std::vector<Job> jobs(const std::vector<TextureUse>& uses)
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
        jobs.push_back({ i, { texture.path, picture.type, &picture.bytes }, uses[i], false, {} });
      }
      else if (!texture.path.empty() && this->ByPath.emplace(std::pair(texture.path, uses[i]), nullptr).second)
      {
        jobs.push_back({ i, { texture.path, extensionOf(texture.path), nullptr }, uses[i], false, {} });
      }
    }
    return jobs;
  }

  /// First all sizes are counted, then pixels are made.
  void decode()
  {
    const std::vector<TextureUse> uses = this->uses();
    std::vector<Job> jobs = this->jobs(uses);
    for (Job& job : jobs)
    {
      picture::Answer size;
      job.isPicture = job.source.bytes ? takeTexels(job.source, *this->Store, size, job.problem)
                                       : this->Store->reserve(job.source.path, job.problem);
    }
    for (Job& job : jobs)
    {
      Texture& texture = this->Made.textures[job.texture];
      const bool embedded = job.source.bytes != nullptr;
      if (job.isPicture)
      {
        texture.image = embedded ? decodeTexels(job.source, job.use, AlphaRule::Meant, job.problem)
                                 : this->Store->decode(job.source.path, job.use, job.problem);
      }
      if (!texture.image)
      {
        this->NotDecoded.push_back("texture " + (embedded ? quoted(texture.name) + " in the file" : texture.path) +
                                   " cannot be decoded: " + job.problem);
      }
      if (!embedded)
      {
        this->ByPath[{ texture.path, job.use }] = texture.image;
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
      const auto known = this->ByPath.find({ texture.path, uses[i] });
      const bool isFile = !this->Contents.pictures[i].isInFile();
      texture.image = isFile && known != this->ByPath.end() ? known->second : texture.image;
    }
  }

  /// A picture of what the material shows and of the mask's alpha; without one of its own, of white.
  void mask(const MaterialAlpha& alpha, Material& material)
  {
    const auto named = static_cast<std::size_t>(alpha.mask);
    const Image* const mask = alpha.mask < 0 ? nullptr : this->Made.textures[named].image.get();
    if (mask == nullptr)
    {
      return;
    }
    const auto [known, isNew] =
      this->Masked.try_emplace({ material.texture, alpha.mask, alpha.value, alpha.inverse }, 0);
    if (isNew)
    {
      const std::shared_ptr<const Image> own = this->imageOf(material);
      const std::string name = this->Made.textures[named].name;
      const int width = std::max(mask->width, own ? own->width : 1);
      const int height = std::max(mask->height, own ? own->height : 1);
      this->Store->take(name, width, height, std::uint64_t(4) * std::uint64_t(width) * std::uint64_t(height));
      Texture texture = this->Made.textures[own ? static_cast<std::size_t>(material.texture) : named];
      texture.path.clear(); // it is in no file
      texture.image = maskedImage(own.get(), *mask, alpha, width, height);
      known->second = static_cast<int>(this->Made.textures.size());
      this->Made.textures.push_back(texture);
    }
    material.texture = known->second;
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
    const bool isOpaque = image && !image->hasAlpha && opacity >= cutOff;
    if (!image || isOpaque || (mask && cutOff == 0.5 && opacity == 1))
    {
      return;
    }
    const auto [known, isNew] = this->Remade.try_emplace({ material.texture, cutOff, opacity }, 0);
    if (isNew)
    {
      const auto bytes = std::uint64_t(image->rgba.size());
      const std::string& name = this->Made.textures[static_cast<std::size_t>(material.texture)].name;
      this->Store->take(name, image->width, image->height, bytes);
      auto remade = std::make_shared<Image>(*image);
      for (std::size_t i = 3; i < remade->rgba.size(); i += 4)
      {
        remade->rgba[i] = remade->rgba[i] * opacity / 255 >= cutOff ? 255 : 0;
      }
      if (hasHoles(*remade) && !isCutOut(*remade))
      {
        remade->rgba[3] = 1; // of a file, alpha that is 0 everywhere is taken as absent (AlphaRule::Painted)
      }
      dgtk::settleAlpha(*remade, AlphaRule::Meant);
      Texture texture = this->Made.textures[static_cast<std::size_t>(material.texture)];
      texture.path.clear(); // it is in no file
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
    std::map<std::pair<const Image*, bool>, bool> known;
    for (std::size_t i = 0; i < this->Made.materials.size(); ++i)
    {
      Material& material = this->Made.materials[i];
      const std::shared_ptr<const Image> image = this->imageOf(material);
      const bool mayBeGone = this->Contents.alpha[i].use == AlphaUse::CutOff; // all of it
      const auto [entry, isNew] = known.try_emplace({ image.get(), mayBeGone }, false);
      entry->second = isNew && image ? (mayBeGone ? hasHoles(*image) : isCutOut(*image)) : entry->second;
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
  std::map<std::pair<std::string, TextureUse>, std::shared_ptr<const Image>> ByPath;
  std::map<std::tuple<int, std::int32_t, MaskValue, double>, int> Masked; ///< (texture, mask, what of it, inverse)
  std::map<std::tuple<int, double, double>, int> Remade;                  ///< (texture, cut-off, opacity)
};
} // namespace

bool isInFolder(const std::string& alternative, const std::string& name)
{
  const std::string ending = '/' + name;
  return alternative.size() > ending.size() &&
         alternative.compare(alternative.size() - ending.size(), std::string::npos, ending) == 0;
}

std::shared_ptr<Model> withPictures(ModelContents contents, const ReadOptions& options)
{
  PictureMaker(contents, options).run();
  return contents.model;
}

} // namespace dgtk
