// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovParser.h"

#include "dgtkError.h"

#include <cmath>

namespace dgtk
{

namespace
{
const std::set<std::string> colorWords = { "color", "colour", "rgb", "srgb", "rgbf", "srgbf", "rgbt", "srgbt", "rgbft",
  "srgbft", "red", "green", "blue" };
const std::set<std::string> maps = { "color_map", "colour_map", "pigment_map", "texture_map", "material_map",
  "normal_map" };

void copyPigment(const PovTexture& from, PovTexture& to)
{
  to.color = from.color;
  to.filter = from.filter;
  to.transmit = from.transmit;
  to.hasColor = from.hasColor;
  to.image = from.image;
  to.uvMapping = from.uvMapping;
  to.mapType = from.mapType;
  to.object_from_pattern = from.object_from_pattern;
}

void copyFinish(const PovTexture& from, PovTexture& to)
{
  to.ambient = from.ambient;
  to.diffuse = from.diffuse;
  to.specular = from.specular;
  to.roughness = from.roughness;
  to.phong = from.phong;
  to.phongSize = from.phongSize;
  to.emission = from.emission;
}
} // namespace

/// A value where one may stand: false, and nothing taken, before a word that is none.
bool PovParser::optionalNumber(Number& to)
{
  const PovToken& token = this->peek();
  const bool begins =
    token.kind == PovToken::Kind::Number || token.is('<') || token.is('(') || token.is('-') || token.is('+') ||
    (token.kind == PovToken::Kind::Word && (colorWords.count(token.text) > 0 || this->Names.count(token.text) > 0));
  if (begins)
  {
    to = this->expression();
  }
  return begins && to.unknown < 0;
}

void PovParser::imageMap(PovTexture& to)
{
  this->expect('{', "image_map");
  while (!this->accept('}'))
  {
    const PovToken token = this->take();
    const auto known = this->Names.find(token.text);
    if (token.kind == PovToken::Kind::End)
    {
      this->failAt(token, "ends inside image_map", "'}'");
    }
    if (token.kind == PovToken::Kind::String && to.image.empty())
    {
      to.image = token.text;
    }
    else if (token.kind == PovToken::Kind::Word && known != this->Names.end() &&
             known->second.kind == PovValue::Kind::Text && to.image.empty())
    {
      to.image = known->second.text;
    }
    else if (token.is("map_type"))
    {
      Number type;
      to.mapType = this->optionalNumber(type) && type.v[0] != 0 ? 1 : 0;
    }
    else if (token.is('{'))
    {
      this->failAt(token, "cannot understand image_map", "'}'");
    }
  }
}

/// Adds the colours of `{ [0 color] [1 color] }`.
void PovParser::colorMap(PovTexture&, int& colors, Eigen::Vector3d& sum)
{
  if (!this->accept('{'))
  {
    return;
  }
  int depth = 1;
  while (depth > 0)
  {
    const PovToken& token = this->peek();
    const auto known = this->Names.find(token.text);
    const bool named =
      token.kind == PovToken::Kind::Word && known != this->Names.end() && known->second.kind == PovValue::Kind::Color;
    if (token.kind == PovToken::Kind::End)
    {
      this->failAt(token, "ends inside a map of colours", "'}'");
    }
    if (named || (token.kind == PovToken::Kind::Word && colorWords.count(token.text) > 0))
    {
      const Number color = this->expression();
      if (color.unknown < 0)
      {
        sum += Eigen::Vector3d(color.v[0], color.v[1], color.v[2]);
        ++colors;
      }
      continue;
    }
    depth += token.is('{') ? 1 : token.is('}') ? -1 : 0;
    this->take();
  }
}

void PovParser::pigment(PovTexture& to)
{
  const PovPlace place = this->peek().place;
  this->expect('{', "pigment");
  int colors = 0;
  bool pattern = false;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  while (!this->accept('}'))
  {
    const PovToken token = this->peek();
    const auto known = token.kind == PovToken::Kind::Word ? this->Names.find(token.text) : this->Names.end();
    const PovValue::Kind kind = known != this->Names.end() ? known->second.kind : PovValue::Kind::Other;
    if (this->isTransform(token))
    {
      this->transform(to.object_from_pattern);
    }
    else if (token.kind == PovToken::Kind::Word && (colorWords.count(token.text) > 0 || kind == PovValue::Kind::Color))
    {
      const Number color = this->expression();
      if (color.unknown < 0)
      {
        sum += Eigen::Vector3d(color.v[0], color.v[1], color.v[2]);
        to.filter = color.v[3];
        to.transmit = color.v[4];
        ++colors;
      }
    }
    else if (kind == PovValue::Kind::Texture)
    {
      this->take();
      copyPigment(*known->second.texture, to);
    }
    else if (token.is("image_map"))
    {
      this->take();
      to.image.clear();
      this->imageMap(to);
    }
    else if (token.is("uv_mapping"))
    {
      this->take();
      to.uvMapping = true;
    }
    else if (token.is("quick_color") || token.is("quick_colour"))
    {
      this->take();
      this->expression();
    }
    else if (token.kind == PovToken::Kind::Word && maps.count(token.text) > 0)
    {
      this->take();
      pattern = true;
      this->colorMap(to, colors, sum);
    }
    else if (token.is('{'))
    {
      this->skipBalanced('{', '}');
    }
    else if (token.kind == PovToken::Kind::End)
    {
      this->failAt(token, "ends inside a pigment", "'}'");
    }
    else
    {
      this->take();
      // the language's own words are in lower case
      if (token.kind == PovToken::Kind::Word && known == this->Names.end() && token.text[0] >= 'A' &&
          token.text[0] <= 'Z')
      {
        this->warn(token.place, quoted(token.text) + " is not declared: drawn without");
      }
    }
  }
  if (colors > 0)
  {
    to.color = sum / colors;
    to.hasColor = true;
  }
  if (pattern || colors > 1)
  {
    this->warn(place, "a pattern of colours is drawn in their mean");
  }
}

void PovParser::finishBlock(PovTexture& to)
{
  const std::map<std::string, double PovTexture::*> values = { { "ambient", &PovTexture::ambient },
    { "diffuse", &PovTexture::diffuse }, { "specular", &PovTexture::specular }, { "roughness", &PovTexture::roughness },
    { "phong", &PovTexture::phong }, { "phong_size", &PovTexture::phongSize }, { "emission", &PovTexture::emission } };
  this->expect('{', "finish");
  while (!this->accept('}'))
  {
    const PovToken token = this->take();
    const auto known = token.kind == PovToken::Kind::Word ? this->Names.find(token.text) : this->Names.end();
    const auto value = values.find(token.text);
    if (token.kind == PovToken::Kind::End)
    {
      this->failAt(token, "ends inside a finish", "'}'");
    }
    if (token.kind == PovToken::Kind::Word && value != values.end())
    {
      if (this->peek().is("albedo"))
      {
        this->take();
      }
      Number number;
      if (this->optionalNumber(number))
      {
        to.*(value->second) = number.v[0];
      }
    }
    else if (known != this->Names.end() && known->second.kind == PovValue::Kind::Texture)
    {
      copyFinish(*known->second.texture, to);
    }
    else if (token.kind == PovToken::Kind::Word)
    {
      this->skipOptionalBlock();
    }
  }
}

/// One word of a texture; false when it is none.
bool PovParser::textureWord(const PovToken& word, PovTexture& to)
{
  if (word.is("pigment"))
  {
    this->take();
    this->pigment(to);
  }
  else if (word.is("finish"))
  {
    this->take();
    this->finishBlock(to);
  }
  else if (word.is("uv_mapping"))
  {
    this->take();
    to.uvMapping = true;
  }
  else if (this->isTransform(word))
  {
    this->transform(to.object_from_pattern);
  }
  else
  {
    return false;
  }
  return true;
}

/// What stands behind the number in `[0 texture]`, which is open. Returns the declared texture that it names, if it is
/// no more than that.
PovTexturePointer PovParser::mapEntry(PovTexture& to)
{
  PovTexturePointer same;
  Number value;
  this->optionalNumber(value);
  while (!this->accept(']'))
  {
    const PovToken token = this->peek();
    const auto known = token.kind == PovToken::Kind::Word ? this->Names.find(token.text) : this->Names.end();
    if (token.kind == PovToken::Kind::End)
    {
      this->failAt(token, "ends inside texture_map", "']'");
    }
    if (known != this->Names.end() && known->second.kind == PovValue::Kind::Texture)
    {
      this->take();
      to = *known->second.texture;
      to.name = token.text;
      same = known->second.texture;
    }
    else if (this->textureWord(token, to))
    {
      same.reset();
    }
    else
    {
      this->take();
      this->skipOptionalBlock();
    }
  }
  return same;
}

/// `{ [0 first] [1 second] ... }`: the first texture is drawn everywhere; returned as by mapEntry().
PovTexturePointer PovParser::textureMap(PovTexture& to)
{
  const PovPlace begin = this->peek().place;
  this->expect('{', "texture_map");
  const bool entries = this->accept('[');
  const PovTexturePointer same = entries ? this->mapEntry(to) : nullptr;
  if (!this->MapWarned)
  {
    this->warn(begin, entries ? "a map of textures is drawn in its first one" : "texture_map is not drawn");
  }
  this->MapWarned = true;
  for (int depth = 1; depth > 0;)
  {
    const PovToken token = this->take();
    if (token.kind == PovToken::Kind::End)
    {
      this->failAt(token, "ends inside texture_map", "'}'");
    }
    depth += token.is('{') ? 1 : token.is('}') ? -1 : 0;
  }
  return same;
}

/// The block after `texture`, `pigment`, `finish` or `material`; `base` is what it changes. A block that only names a
/// declared texture is that one.
PovTexturePointer PovParser::texture(const std::string& kind, const PovTexturePointer& base)
{
  const Guard guard(*this);
  auto result = std::make_shared<PovTexture>(base ? *base : *this->DefaultTexture);
  if (kind == "pigment")
  {
    result->image.clear();
    result->hasColor = false;
    this->pigment(*result);
    return result;
  }
  if (kind == "finish")
  {
    this->finishBlock(*result);
    return result;
  }
  PovTexturePointer same;
  this->expect('{', kind.c_str());
  while (!this->accept('}'))
  {
    const PovToken token = this->peek();
    const auto known = token.kind == PovToken::Kind::Word ? this->Names.find(token.text) : this->Names.end();
    if (known != this->Names.end() && known->second.kind == PovValue::Kind::Texture)
    {
      this->take();
      *result = *known->second.texture;
      result->name = token.text;
      same = known->second.texture;
      continue;
    }
    if (token.is("texture_map"))
    {
      this->take();
      same = this->textureMap(*result);
      continue;
    }
    const bool nested = kind == "material" && token.is("texture");
    if (nested)
    {
      this->take();
      *result = *this->texture("texture", base);
    }
    else if (token.kind == PovToken::Kind::End)
    {
      this->failAt(token, "ends inside a " + kind, "'}'");
    }
    else if (!this->textureWord(token, *result))
    {
      this->take();
      if (token.kind == PovToken::Kind::Word && known == this->Names.end() && this->peek().is('}') && !same)
      {
        this->warn(token.place, kind + ' ' + quoted(token.text) + " is not declared: drawn without");
      }
      if (token.kind == PovToken::Kind::Word && maps.count(token.text) > 0)
      {
        this->warn(token.place, token.text + " is not drawn");
      }
      this->skipOptionalBlock();
      continue;
    }
    same.reset();
  }
  if (!same)
  {
    return result;
  }
  // the same texture, named once: all its users share it
  const auto known = this->Names.find(result->name);
  if (known != this->Names.end() && known->second.texture == same && same->name.empty())
  {
    known->second.texture = result;
    return result;
  }
  return same;
}

} // namespace dgtk
