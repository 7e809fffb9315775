// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovParser.h"

#include "dgtkError.h"

#include <cmath>

namespace dgtk
{

namespace
{
const std::set<std::string> transformWords = { "translate", "rotate", "scale", "matrix", "transform" };
/// Modifiers of an object that say nothing about where its triangles are or how they look; a block or an on / off may
/// follow.
const std::set<std::string> plainModifiers = { "normal", "interior", "interior_texture", "photons", "radiosity",
  "no_shadow", "no_reflection", "no_radiosity", "double_illuminate", "hollow", "sturm", "hierarchy", "split_union",
  "bounded_by", "open", "solid", "uv_mapping", "cutaway_textures", "global_lights", "evaluate" };

/// Rotation by degrees about an axis; exact for quarter turns.
Eigen::Matrix3d rotation(double degrees, int axis)
{
  const double turns = std::remainder(degrees, 360.0) / 90;
  double c = std::cos(turns * 1.57079632679489661923);
  double s = std::sin(turns * 1.57079632679489661923);
  if (turns == std::nearbyint(turns))
  {
    c = std::nearbyint(c);
    s = std::nearbyint(s);
  }
  const int y = (axis + 1) % 3;
  const int z = (axis + 2) % 3;
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  matrix(y, y) = c;
  matrix(y, z) = -s;
  matrix(z, y) = s;
  matrix(z, z) = c;
  return matrix;
}
} // namespace

bool PovParser::isTransform(const PovToken& token) const
{
  return token.kind == PovToken::Kind::Word && transformWords.count(token.text) > 0;
}

/// The transform that comes next, after those of `total`: POV-Ray applies them in the order written.
bool PovParser::transform(Eigen::Affine3d& total)
{
  const PovToken word = this->peek();
  if (!this->isTransform(word))
  {
    return false;
  }
  this->take();
  Eigen::Affine3d next = Eigen::Affine3d::Identity();
  if (word.is("transform"))
  {
    next = this->transformBlock();
  }
  else if (word.is("matrix"))
  {
    // rows of a matrix that multiplies row vectors from the right
    const PovPlace place = this->peek().place;
    this->expect('<', "a matrix");
    for (int i = 0; i < 12; ++i)
    {
      next(i % 3, i / 3) = this->scalar(this->expression(), place);
      this->accept(',');
    }
    this->expect('>', "a matrix");
  }
  else
  {
    const Eigen::Vector3d v = this->vector(word.text.c_str());
    if (word.is("translate"))
    {
      next.translation() = v;
    }
    else if (word.is("scale"))
    {
      for (int i = 0; i < 3; ++i)
      {
        next(i, i) = v[i] == 0 ? 1 : v[i]; // as POV-Ray does
      }
    }
    else
    {
      next.linear() = rotation(v[2], 2) * rotation(v[1], 1) * rotation(v[0], 0);
    }
  }
  total = next * total;
  return true;
}

/// After `transform`: a name, or a block of transforms.
Eigen::Affine3d PovParser::transformBlock()
{
  const Guard guard(*this);
  const auto named = [this]
  {
    const PovToken name = this->take();
    const auto known = this->Names.find(name.text);
    if (known == this->Names.end() || known->second.kind != PovValue::Kind::Transform)
    {
      this->failAt(name, "transform needs evaluation", "a declared transform");
    }
    return known->second.transform;
  };
  if (!this->accept('{'))
  {
    return named();
  }
  Eigen::Affine3d total = Eigen::Affine3d::Identity();
  bool inverse = false;
  while (!this->accept('}'))
  {
    if (this->transform(total))
    {
      continue;
    }
    if (this->peek().is("inverse"))
    {
      this->take();
      inverse = true;
      continue;
    }
    total = named() * total;
  }
  return inverse && total.linear().determinant() != 0 ? total.inverse() : total;
}

bool PovParser::flag(const PovToken& token)
{
  if (token.kind != PovToken::Kind::Word || plainModifiers.count(token.text) == 0)
  {
    return false;
  }
  this->take();
  this->skipOptionalBlock();
  const PovToken& next = this->peek();
  if (next.is("on") || next.is("off") || next.is("true") || next.is("false") || next.is("yes") || next.is("no") ||
      next.kind == PovToken::Kind::Number)
  {
    this->take();
  }
  return true;
}

bool PovParser::modifier(Modifiers& to)
{
  const PovToken token = this->peek();
  if (this->transform(to.transform) || this->flag(token))
  {
    return true;
  }
  if (token.is("texture") || token.is("pigment") || token.is("finish") || token.is("material"))
  {
    this->take();
    const bool whole = token.is("texture") || token.is("material");
    to.texture = this->texture(token.text, whole ? nullptr : to.texture);
    to.atTexture = to.transform;
  }
  else if (token.is("no_image"))
  {
    this->take();
    to.invisible = true;
  }
  else if (token.is("inside_vector"))
  {
    this->take();
    this->expression();
  }
  else if (token.is("clipped_by"))
  {
    this->take();
    this->skipOptionalBlock();
    this->problem(token.place, "clipped_by is not evaluated");
  }
  else if (token.is("inverse"))
  {
    this->take();
  }
  else
  {
    return false;
  }
  return true;
}

void PovParser::apply(PovShape& shape, const Modifiers& modifiers, bool replaceTexture)
{
  if (modifiers.invisible)
  {
    shape.clear();
    return;
  }
  for (PovInstance& instance : shape)
  {
    if (modifiers.texture && (replaceTexture || !instance.texture))
    {
      instance.texture = modifiers.texture;
      instance.texture_from_mesh = modifiers.atTexture * instance.scene_from_mesh;
    }
    instance.scene_from_mesh = modifiers.transform * instance.scene_from_mesh;
  }
}

/// union, or what cannot be evaluated but may hold no mesh at all.
PovShape PovParser::group(const PovToken& word)
{
  const Guard guard(*this);
  this->expect('{', word.text.c_str());
  this->Contexts.emplace_back();
  if (!word.is("union") && !word.is("light_group"))
  {
    this->problem(word.place, word.text + " is not evaluated");
  }
  ShapeList list;
  Modifiers modifiers;
  bool lacking = false;
  while (!this->accept('}'))
  {
    if (this->item(list) || this->modifier(modifiers))
    {
      continue;
    }
    const PovToken token = this->take();
    const auto known = this->Names.find(token.text);
    if (token.kind != PovToken::Kind::Word)
    {
      this->failAt(token, "cannot be understood in a " + word.text, "an object or '}'");
    }
    if (known != this->Names.end() && known->second.kind == PovValue::Kind::Shape)
    {
      known->second.used = true;
      this->countInstances(known->second.shape.size(), token.place);
      list.add(known->second.shape);
    }
    else if (known != this->Names.end())
    {
      this->problem(
        token.place, known->second.text.empty() ? quoted(token.text) + " is no object" : known->second.text);
    }
    else
    {
      this->macroCall(token);
    }
  }
  PovShape shape = list.take();
  const Context context = this->Contexts.back();
  this->Contexts.pop_back();
  lacking = !context.problem.empty();
  if (lacking && !shape.empty())
  {
    this->fail(context.place, context.problem + ", and it stands in one object with a mesh");
  }
  if (lacking)
  {
    this->problem(context.place, context.problem);
  }
  this->apply(shape, modifiers, false);
  return shape;
}

PovShape PovParser::object()
{
  const Guard guard(*this);
  this->expect('{', "object");
  ShapeList list;
  PovShape shape;
  Modifiers modifiers;
  bool single = false;
  const PovToken first = this->peek();
  if (!this->item(list))
  {
    this->take();
    const auto known = first.kind == PovToken::Kind::Word ? this->Names.find(first.text) : this->Names.end();
    if (known == this->Names.end())
    {
      if (first.kind != PovToken::Kind::Word)
      {
        this->failAt(first, "cannot understand an object", "a name or a shape");
      }
      this->macroCall(first);
    }
    else if (known->second.kind == PovValue::Kind::Shape)
    {
      known->second.used = true;
      shape = known->second.shape;
      this->countInstances(shape.size(), first.place);
      single = shape.size() == 1;
    }
    else
    {
      this->problem(first.place,
        known->second.text.empty() ? quoted(first.text) + " is not made of triangles" : known->second.text);
    }
  }
  else
  {
    shape = list.take();
  }
  // what is done to something that is not drawn need not be known
  const bool drawn = !shape.empty();
  this->Contexts.emplace_back();
  this->Contexts.back().isMesh = drawn;
  while (!this->accept('}'))
  {
    const PovToken token = this->peek();
    if (drawn ? this->modifier(modifiers) : token.kind != PovToken::Kind::End)
    {
      if (!drawn && !token.is('{'))
      {
        this->take();
      }
      else if (!drawn)
      {
        this->skipBalanced('{', '}');
      }
      continue;
    }
    if (token.kind == PovToken::Kind::Word)
    {
      this->take();
      this->macroCall(token);
      continue;
    }
    this->failAt(token, "cannot be understood in an object", "a modifier or '}'");
  }
  this->Contexts.pop_back();
  this->apply(shape, modifiers, single);
  return shape;
}

/// Sign of the x of a camera's `right`.
double PovParser::camera()
{
  const PovPlace begin = this->peek().place;
  double right = 1;
  this->expect('{', "camera");
  for (int depth = 1; depth > 0;)
  {
    const PovToken token = this->take();
    if (token.kind == PovToken::Kind::End)
    {
      this->fail(begin, "camera is not closed", "'}'", "end of file");
    }
    depth += token.is('{') ? 1 : token.is('}') ? -1 : 0;
    const auto known = token.kind == PovToken::Kind::Word ? this->Names.find(token.text) : this->Names.end();
    if (known != this->Names.end() && known->second.kind == PovValue::Kind::Camera)
    {
      right = known->second.right;
    }
    if (token.is("right"))
    {
      const Number value = this->expression();
      if (value.unknown >= 0)
      {
        this->warn(token.place, "camera's right is not evaluated: taken as positive");
      }
      right = value.unknown < 0 && value.v[0] < 0 ? -1 : 1;
    }
  }
  return right;
}

} // namespace dgtk
