// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovShapes.h"

#include "dgtkError.h"

namespace dgtk
{

namespace
{
using WordSet = std::set<std::string>;

const WordSet groupWords = { "union", "difference", "intersection", "merge", "light_group" };
/// Shapes that are not made of triangles.
const WordSet primitiveWords = { "bicubic_patch", "blob", "box", "cone", "cubic", "cylinder", "disc", "height_field",
  "isosurface", "julia_fractal", "lathe", "lemon", "ovus", "parametric", "plane", "poly", "polygon", "polynomial",
  "prism", "quadric", "quartic", "sor", "sphere", "sphere_sweep", "superellipsoid", "text", "torus" };
/// Statements about everything but shapes.
const WordSet sceneryWords = { "atmosphere", "background", "fog", "global_settings", "light_source", "looks_like",
  "media", "photons", "radiosity", "rainbow", "sky_sphere", "interior", "density", "atmospheric_media" };
/// Other values that a name may stand for.
const WordSet valueWords = { "normal", "color_map", "colour_map", "pigment_map", "normal_map", "texture_map",
  "slope_map" };
} // namespace

bool PovShapes::isOther(const PovToken& token)
{
  return token.isOneOf(primitiveWords) || token.isOneOf(sceneryWords) || token.isOneOf(valueWords);
}

bool PovShapes::item(PovShapeMaker& to)
{
  const PovToken word = this->Stream.peek();
  const PovStream::Level level(this->Stream);
  if (this->Stream.accept("triangle") || this->Stream.accept("smooth_triangle"))
  {
    this->Meshes.triangle(word.is("smooth_triangle"), to);
  }
  else if (word.is("mesh") || word.is("mesh2") || word.is("object") || word.isOneOf(groupWords))
  {
    this->Stream.take();
    to.add(word.is("mesh")     ? this->Meshes.mesh()
           : word.is("mesh2")  ? this->Meshes.mesh2()
           : word.is("object") ? this->object()
                               : this->group(word));
  }
  else if (word.isOneOf(primitiveWords))
  {
    this->Stream.take();
    this->Session.skipStatement(word);
    this->Session.problem(word.place, word.text + " is not made of triangles");
  }
  else if (this->Stream.accept("camera"))
  {
    this->Right = this->camera();
    this->Scenery.insert(word.text);
  }
  else if (word.isOneOf(sceneryWords))
  {
    this->Stream.take();
    this->Session.skipStatement(word);
    this->Scenery.insert(word.text);
  }
  else
  {
    return false;
  }
  return true;
}

/// A union, or what cannot be evaluated but may hold no mesh at all.
PovShape PovShapes::group(const PovToken& word)
{
  const PovStream::Level level(this->Stream);
  this->Stream.expect('{', word.text.c_str());
  PovShapeMaker members;
  PovModifiers modifiers;
  PovProblem lacking;
  {
    const PovSession::Block block(this->Session, false);
    if (!word.is("union") && !word.is("light_group"))
    {
      this->Session.problem(word.place, word.text + " is not evaluated");
    }
    while (!this->Stream.accept('}'))
    {
      if (!this->item(members) && !this->Appearance.modifier(modifiers))
      {
        members.add(this->named("a " + word.text));
      }
    }
    lacking = block.problem;
  }
  PovShape shape = members.take();
  if (!lacking.what.empty() && !shape.empty())
  {
    this->Stream.fail(lacking.place, lacking.what + ", and it stands in one object with a mesh");
  }
  if (!lacking.what.empty())
  {
    this->Session.problem(lacking.place, lacking.what);
  }
  modifiers.apply(shape, false);
  return shape;
}

/// The shape that a name stands for; empty when it has none.
PovShape PovShapes::named(const std::string& where)
{
  const PovToken name = this->Stream.take();
  if (name.kind != PovToken::Kind::Word)
  {
    this->Stream.failAt(name, "cannot be understood in " + where, "an object or '}'");
  }
  const PovValue* value = this->Session.symbols.find(name);
  if (value && value->kind == PovValue::Kind::Shape)
  {
    return this->Session.use(name).shape;
  }
  if (value)
  {
    this->Session.problem(name.place, value->whyNot(quoted(name.text) + " is not made of triangles"));
  }
  else
  {
    this->Session.skipCall(name);
  }
  return {};
}

PovShape PovShapes::object()
{
  const PovStream::Level level(this->Stream);
  this->Stream.expect('{', "object");
  const bool named = this->Session.symbols.find(this->Stream.peek(), PovValue::Kind::Shape);
  PovShapeMaker maker;
  PovShape shape = this->item(maker) ? maker.take() : this->named("an object");
  const PovSession::Block block(this->Session, !shape.empty());
  if (shape.empty())
  {
    this->Stream.skipRest("an object"); // what is done to something that is not drawn need not be known
    return {};
  }
  const bool single = named && shape.size() == 1;
  PovModifiers modifiers;
  while (!this->Stream.accept('}'))
  {
    const PovToken token = this->Stream.peek();
    if (this->Appearance.modifier(modifiers))
    {
      continue;
    }
    if (token.kind != PovToken::Kind::Word)
    {
      this->Stream.failAt(token, "cannot be understood in an object", "a modifier or '}'");
    }
    this->Session.skipCall(this->Stream.take());
  }
  modifiers.apply(shape, single);
  return shape;
}

double PovShapes::camera()
{
  double right = 1;
  const auto see = [&](const PovToken& token)
  {
    if (const PovValue* named = this->Session.symbols.find(token, PovValue::Kind::Camera))
    {
      right = named->right;
    }
    if (token.is("right"))
    {
      const PovNumber value = this->Session.evaluator.expression();
      if (value.unknown)
      {
        this->Session.warn(token.place, "camera's right is not evaluated: taken as positive");
      }
      right = !value.unknown && value.v[0] < 0 ? -1 : 1;
    }
  };
  this->Stream.skip('{', '}', "camera", see);
  return right;
}

} // namespace dgtk
