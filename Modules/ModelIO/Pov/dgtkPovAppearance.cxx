// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovAppearance.h"

#include "dgtkError.h"

#include <numeric>

namespace dgtk
{

namespace
{
const std::set<std::string> maps = { "color_map", "colour_map", "pigment_map", "texture_map", "material_map",
  "normal_map" };
const std::map<std::string, double PovFinish::*> finishWords = { { "ambient", &PovFinish::ambient },
  { "diffuse", &PovFinish::diffuse }, { "specular", &PovFinish::specular }, { "roughness", &PovFinish::roughness },
  { "phong", &PovFinish::phong }, { "phong_size", &PovFinish::phongSize }, { "emission", &PovFinish::emission } };

/// Says nothing about where triangles are or how they look; a block or an on / off may follow.
bool readPlain(PovStream& stream)
{
  static const std::set<std::string> words = { "normal", "interior", "interior_texture", "photons", "radiosity",
    "no_shadow", "no_reflection", "no_radiosity", "double_illuminate", "hollow", "sturm", "hierarchy", "split_union",
    "bounded_by", "open", "solid", "uv_mapping", "cutaway_textures", "global_lights", "evaluate" };
  static const std::set<std::string> states = { "on", "off", "true", "false", "yes", "no" };
  if (!stream.peek().isOneOf(words))
  {
    return false;
  }
  stream.take();
  stream.skipBlock();
  if (stream.peek().isOneOf(states) || stream.peek().kind == PovToken::Kind::Number)
  {
    stream.take();
  }
  return true;
}
} // namespace

bool PovAppearance::begins(const PovToken& token)
{
  return token.is("texture") || token.is("pigment") || token.is("finish") || token.is("material");
}

void PovAppearance::imageMap(PovPigment& to)
{
  to.image.clear();
  this->Stream.expect('{', "image_map");
  while (this->Stream.goesOn('}', "image_map"))
  {
    const PovToken token = this->Stream.take();
    const PovValue* text = this->Session.symbols.find(token, PovValue::Kind::Text);
    if ((token.kind == PovToken::Kind::String || text) && to.image.empty())
    {
      to.image = text ? text->text : token.text;
    }
    else if (token.is("map_type"))
    {
      PovNumber type;
      to.mapType = this->Session.evaluator.optional(type) && type.v[0] != 0 ? 1 : 0;
    }
    else if (token.is('{'))
    {
      this->Stream.failAt(token, "cannot understand image_map", "'}'");
    }
  }
}

/// Adds the colours of `{ [0 color] [1 color] }`.
void PovAppearance::colorMap(Colors& colors)
{
  for (int depth = this->Stream.accept('{') ? 1 : 0; depth > 0;)
  {
    const PovToken& token = this->Stream.peek();
    if (token.kind == PovToken::Kind::End)
    {
      this->Stream.failAt(token, "ends inside a map of colours", "'}'");
    }
    if (this->Session.evaluator.beginsColor(token))
    {
      const PovNumber color = this->Session.evaluator.expression();
      if (!color.unknown)
      {
        colors.push_back(color.rgb());
      }
      continue;
    }
    depth += token.is('{') ? 1 : token.is('}') ? -1 : 0;
    this->Stream.take();
  }
}

/// What follows a word of a pigment; false when it is none that counts.
bool PovAppearance::pigmentWord(const PovToken& word, PovPigment& to)
{
  if (const PovValue* texture = this->Session.symbols.find(word, PovValue::Kind::Texture))
  {
    to = texture->texture->pigment;
  }
  else if (word.is("image_map"))
  {
    this->imageMap(to);
  }
  else if (word.is("quick_color") || word.is("quick_colour"))
  {
    this->Session.evaluator.expression();
  }
  else
  {
    to.uvMapping = to.uvMapping || word.is("uv_mapping");
    return word.is("uv_mapping");
  }
  return true;
}

void PovAppearance::pigment(PovPigment& to)
{
  const PovPlace place = this->Stream.peek().place;
  Colors colors;
  bool pattern = false;
  bool hasImage = false;
  this->Stream.expect('{', "pigment");
  while (this->Stream.goesOn('}', "a pigment"))
  {
    const PovToken token = this->Stream.peek();
    if (this->Session.evaluator.transform(to.object_from_pattern) || this->Stream.skipGroup("{"))
    {
      continue;
    }
    if (this->Session.evaluator.beginsColor(token))
    {
      const PovNumber color = this->Session.evaluator.expression();
      if (!color.unknown)
      {
        colors.push_back(color.rgb());
        to.filter = color.v[3];
        to.transmit = color.v[4];
      }
      continue;
    }
    this->Stream.take();
    hasImage = hasImage || token.is("image_map");
    if (token.isOneOf(maps))
    {
      pattern = true;
      this->colorMap(colors);
    }
    else if (!this->pigmentWord(token, to) && token.kind == PovToken::Kind::Word &&
             !this->Session.symbols.find(token) && token.text[0] >= 'A' &&
             token.text[0] <= 'Z') // the language's own words are in lower case
    {
      this->Session.warn(token.place, quoted(token.text) + " is not declared: drawn without");
    }
  }
  if (!colors.empty())
  {
    to.color = std::accumulate(colors.begin(), colors.end(), Eigen::Vector3d(0, 0, 0)) / double(colors.size());
    to.hasColor = true;
    to.image = hasImage ? to.image : std::string(); // that of a declared one is painted over
  }
  if (pattern || colors.size() > 1)
  {
    this->Session.warn(place, "a pattern of colours is drawn in their mean");
  }
}

void PovAppearance::finish(PovFinish& to)
{
  this->Stream.expect('{', "finish");
  while (this->Stream.goesOn('}', "a finish"))
  {
    const PovToken token = this->Stream.take();
    const auto value = finishWords.find(token.text);
    if (token.kind == PovToken::Kind::Word && value != finishWords.end())
    {
      this->Stream.accept("albedo");
      PovNumber number;
      if (this->Session.evaluator.optional(number))
      {
        to.*(value->second) = number.v[0];
      }
    }
    else if (const PovValue* texture = this->Session.symbols.find(token, PovValue::Kind::Texture))
    {
      to = texture->texture->finish;
    }
    else if (token.kind == PovToken::Kind::Word)
    {
      this->Stream.skipBlock();
    }
  }
}

/// A declared texture by its name; null, and nothing taken, before anything else.
PovTexturePointer PovAppearance::declared(PovTexture& to)
{
  const PovValue* named = this->Session.symbols.find(this->Stream.peek(), PovValue::Kind::Texture);
  if (!named)
  {
    return nullptr;
  }
  to = *named->texture;
  to.name = this->Stream.take().text;
  return named->texture;
}

/// One part of a texture; false, and nothing taken, before anything else.
bool PovAppearance::part(PovTexture& to)
{
  if (this->Stream.accept("pigment"))
  {
    this->pigment(to.pigment);
  }
  else if (this->Stream.accept("finish"))
  {
    this->finish(to.finish);
  }
  else if (this->Stream.accept("uv_mapping"))
  {
    to.pigment.uvMapping = true;
  }
  else
  {
    return this->Session.evaluator.transform(to.pigment.object_from_pattern);
  }
  return true;
}

/// `{ [0 first] [1 second] ... }`: the first texture is drawn everywhere; returned as by body().
PovTexturePointer PovAppearance::textureMap(PovTexture& to)
{
  const PovPlace begin = this->Stream.peek().place;
  this->Stream.expect('{', "texture_map");
  const bool entries = this->Stream.accept('[');
  PovNumber value;
  if (entries)
  {
    this->Session.evaluator.optional(value);
  }
  PovTexturePointer same = entries ? this->body(']', "texture_map", nullptr, to) : nullptr;
  if (!this->MapWarned)
  {
    this->Session.warn(begin, entries ? "a map of textures is drawn in its first one" : "texture_map is not drawn");
  }
  this->MapWarned = true;
  this->Stream.skipRest("texture_map");
  return same;
}

void PovAppearance::otherWord(const std::string& kind, bool isLast)
{
  const PovToken token = this->Stream.take();
  if (token.kind == PovToken::Kind::Word && !this->Session.symbols.find(token) && this->Stream.peek().is('}') && isLast)
  {
    this->Session.warn(token.place, kind + ' ' + quoted(token.text) + " is not declared: drawn without");
  }
  if (token.isOneOf(maps))
  {
    this->Session.warn(token.place, token.text + " is not drawn");
  }
  this->Stream.skipBlock();
}

/// What stands in a texture, a material, or an entry of a map, which is open. Returns the declared texture that it
/// names, if it is no more than that.
PovTexturePointer PovAppearance::body(
  char close, const std::string& kind, const PovTexturePointer& base, PovTexture& to)
{
  PovTexturePointer same;
  const std::string where = "a " + kind;
  while (this->Stream.goesOn(close, where.c_str()))
  {
    if (const PovTexturePointer named = this->declared(to))
    {
      same = named;
    }
    else if (this->Stream.accept("texture_map"))
    {
      same = this->textureMap(to);
    }
    else if (kind == "material" && this->Stream.accept("texture"))
    {
      to = *this->texture("texture", base);
      same.reset();
    }
    else if (this->part(to))
    {
      same.reset();
    }
    else
    {
      this->otherWord(kind, !same);
    }
  }
  return same;
}

PovTexturePointer PovAppearance::texture(const std::string& kind, const PovTexturePointer& base)
{
  const PovStream::Level level(this->Stream);
  auto result = std::make_shared<PovTexture>(base ? *base : *this->Default);
  PovTexturePointer same;
  if (kind == "pigment")
  {
    result->pigment.image.clear();
    result->pigment.hasColor = false;
    this->pigment(result->pigment);
  }
  else if (kind == "finish")
  {
    this->finish(result->finish);
  }
  else
  {
    this->Stream.expect('{', kind.c_str());
    same = this->body('}', kind, base, *result);
  }
  return same ? same : result;
}

bool PovAppearance::modifier(PovModifiers& to)
{
  if (this->Session.evaluator.transform(to.transform) || readPlain(this->Stream) || this->Stream.accept("inverse"))
  {
    return true;
  }
  const PovToken token = this->Stream.peek();
  if (begins(token))
  {
    this->Stream.take();
    const bool whole = token.is("texture") || token.is("material");
    to.texture = this->texture(token.text, whole ? nullptr : to.texture);
    to.atTexture = to.transform;
  }
  else if (this->Stream.accept("no_image"))
  {
    to.invisible = true;
  }
  else if (this->Stream.accept("inside_vector"))
  {
    this->Session.evaluator.expression();
  }
  else if (this->Stream.accept("clipped_by"))
  {
    this->Stream.skipBlock();
    this->Session.problem(token.place, "clipped_by is not evaluated");
  }
  else
  {
    return false;
  }
  return true;
}

void PovModifiers::apply(PovShape& shape, bool replaceTexture) const
{
  if (this->invisible)
  {
    shape.clear();
  }
  for (PovInstance& instance : shape)
  {
    if (this->texture && (replaceTexture || !instance.texture))
    {
      instance.texture = this->texture;
      instance.texture_from_mesh = this->atTexture * instance.scene_from_mesh;
    }
    instance.scene_from_mesh = this->transform * instance.scene_from_mesh;
  }
}

void PovAppearance::readDefault()
{
  this->Stream.expect('{', "#default");
  while (this->Stream.goesOn('}', "#default"))
  {
    const PovToken word = this->Stream.take();
    if (begins(word) && !word.is("material"))
    {
      this->Default = this->texture(word.text, this->Default);
    }
    else if (word.kind != PovToken::Kind::Word)
    {
      this->Stream.failAt(word, "cannot understand #default", "texture, pigment or finish");
    }
    this->Stream.skipBlock();
  }
}

} // namespace dgtk
