// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovParser.h"

#include "dgtkError.h"

#include <algorithm>

namespace dgtk
{

namespace
{
using Words = std::set<std::string>;

const Words meshWords = { "mesh", "mesh2", "triangle", "smooth_triangle" };
const Words groupWords = { "union", "difference", "intersection", "merge", "light_group" };
/// Shapes that are not made of triangles.
const Words primitiveWords = { "bicubic_patch", "blob", "box", "cone", "cubic", "cylinder", "disc", "height_field",
  "isosurface", "julia_fractal", "lathe", "lemon", "ovus", "parametric", "plane", "poly", "polygon", "polynomial",
  "prism", "quadric", "quartic", "sor", "sphere", "sphere_sweep", "superellipsoid", "text", "torus" };
/// Statements about everything but shapes.
const Words sceneryWords = { "atmosphere", "background", "fog", "global_settings", "light_source", "looks_like",
  "media", "photons", "radiosity", "rainbow", "sky_sphere", "interior", "density", "atmospheric_media" };
constexpr std::size_t mostInstances = 50'000; ///< and one for every hundred bytes read
} // namespace

PovParser::PovParser(const std::string& path)
  : Tokens(path)
  , DefaultTexture(std::make_shared<PovTexture>())
{
}

PovToken PovParser::raw()
{
  if (this->HasPending)
  {
    this->HasPending = false;
    return this->Pending;
  }
  return this->Tokens.next();
}

const PovToken& PovParser::peek()
{
  while (!this->HasLook)
  {
    PovToken token = this->raw();
    if (token.kind == PovToken::Kind::Directive && this->Nesting != this->DeferAt)
    {
      this->directive(token);
    }
    else
    {
      this->Look = std::move(token);
      this->HasLook = true;
    }
  }
  return this->Look;
}

void PovParser::drop()
{
  const bool opens = this->Look.is('{') || this->Look.is('(');
  const bool closes = this->Look.is('}') || this->Look.is(')');
  this->Nesting += opens ? 1 : closes ? -1 : 0;
  this->HasLook = false;
}

PovToken PovParser::take()
{
  this->peek();
  this->drop();
  return std::move(this->Look);
}

bool PovParser::accept(char symbol)
{
  if (!this->peek().is(symbol))
  {
    return false;
  }
  this->drop();
  return true;
}

void PovParser::failAt(const PovToken& token, const std::string& what, const std::string& expected)
{
  this->fail(token.place, what, expected, token.kind == PovToken::Kind::End ? "end of file" : quoted(token.text));
}

void PovParser::expect(char symbol, const char* where)
{
  if (!this->accept(symbol))
  {
    this->failAt(this->peek(), std::string("cannot understand ") + where, quoted(std::string(1, symbol)));
  }
}

void PovParser::warn(const PovPlace& place, const std::string& what)
{
  const std::string& path = this->Tokens.path(place.file);
  const std::string name = path.substr(path.find_last_of('/') + 1);
  if (this->Warnings.size() < 1000)
  {
    this->Warnings.push_back(name + ':' + std::to_string(place.line) + ": " + what);
  }
}

void PovParser::problem(const PovPlace& place, const std::string& what)
{
  if (this->FirstProblem.empty())
  {
    this->FirstProblem = what;
    this->FirstProblemPlace = place;
  }
  if (this->Contexts.empty())
  {
    this->warn(place, what + ": left out");
    return;
  }
  Context& context = this->Contexts.back();
  if (context.isMesh)
  {
    this->fail(place, what + ", and a mesh depends on it");
  }
  if (context.problem.empty())
  {
    context.problem = what;
    context.place = place;
  }
}

bool PovParser::holdsMesh(const PovToken& token) const
{
  if (token.kind != PovToken::Kind::Word)
  {
    return false;
  }
  if (meshWords.count(token.text) > 0)
  {
    return true;
  }
  const auto name = this->Names.find(token.text);
  if (name != this->Names.end() && name->second.kind == PovValue::Kind::Shape && !name->second.shape.empty())
  {
    return true;
  }
  const auto macro = this->Macros.find(token.text);
  return macro != this->Macros.end() && !macro->second.what.empty();
}

bool PovParser::skipBalanced(char open, char close)
{
  const PovPlace begin = this->peek().place;
  bool mesh = false;
  int depth = 0;
  do
  {
    const PovToken token = this->take();
    if (token.kind == PovToken::Kind::End)
    {
      this->fail(begin, "block is not closed", quoted(std::string(1, close)), "end of file");
    }
    depth += token.is(open) ? 1 : token.is(close) ? -1 : 0;
    mesh = mesh || this->holdsMesh(token);
  } while (depth > 0);
  return mesh;
}

void PovParser::skipOptionalBlock()
{
  if (this->peek().is('{'))
  {
    this->skipBalanced('{', '}');
  }
}

/// A statement that makes no triangles. A mesh inside it would be lost: refused.
void PovParser::skipStatement(const PovToken& word)
{
  if (!this->peek().is('{'))
  {
    this->failAt(this->peek(), "cannot understand " + quoted(word.text), "'{'");
  }
  if (this->skipBalanced('{', '}'))
  {
    this->fail(word.place, quoted(word.text) + " with a mesh in it cannot be read");
  }
}

void PovParser::macroCall(const PovToken& word)
{
  const auto macro = this->Macros.find(word.text);
  const bool isMacro = macro != this->Macros.end();
  const std::string what =
    isMacro ? "macro " + quoted(word.text) + " is not evaluated" : "undeclared name " + quoted(word.text);
  if (!isMacro || !macro->second.what.empty())
  {
    this->fail(word.place, what + (isMacro ? ", and a mesh depends on it" : ""));
  }
  if (this->peek().is('(') && this->skipBalanced('(', ')'))
  {
    this->fail(word.place, what + ", and a mesh depends on it");
  }
  this->problem(word.place, what);
  this->poison(macro->second.sets, word.place, what);
}

void PovParser::countInstances(std::size_t more, const PovPlace& place)
{
  this->Instances += more;
  const std::size_t most = mostInstances + static_cast<std::size_t>(this->Tokens.bytesRead() / 100);
  if (this->Instances > most)
  {
    this->fail(place, "has too many objects", "at most " + std::to_string(most));
  }
}

/// One object of the scene or of a group. False when the next token does not begin one.
bool PovParser::item(ShapeList& to)
{
  const PovToken word = this->peek();
  if (word.kind != PovToken::Kind::Word)
  {
    return false;
  }
  const Guard guard(*this);
  const auto begins = [&](const char* text) { return word.text == text; };
  if (begins("triangle") || begins("smooth_triangle"))
  {
    this->take();
    this->triangle(begins("smooth_triangle"), to.triangles());
  }
  else if (begins("mesh") || begins("mesh2") || begins("object") || groupWords.count(word.text) > 0)
  {
    this->take();
    to.add(begins("mesh")     ? this->mesh()
           : begins("mesh2")  ? this->mesh2()
           : begins("object") ? this->object()
                              : this->group(word));
  }
  else if (primitiveWords.count(word.text) > 0)
  {
    this->take();
    this->skipStatement(word);
    this->problem(word.place, word.text + " is not made of triangles");
  }
  else if (begins("camera"))
  {
    this->take();
    this->Right = this->camera();
    this->Scenery.insert(word.text);
  }
  else if (sceneryWords.count(word.text) > 0)
  {
    this->take();
    this->skipStatement(word);
    this->Scenery.insert(word.text);
  }
  else
  {
    return false;
  }
  return true;
}

void PovParser::scene(PovContents& result)
{
  ShapeList all;
  while (this->peek().kind != PovToken::Kind::End)
  {
    if (this->item(all) || this->accept(';'))
    {
      continue;
    }
    const PovToken token = this->take();
    if (token.kind != PovToken::Kind::Word)
    {
      this->failAt(token, "cannot be understood here", "an object or a declaration");
    }
    this->macroCall(token);
  }
  result.shape = all.take();
}

/// A file of declarations only is drawn as if each mesh that no other one uses stood in the scene.
void PovParser::finish(PovContents& result)
{
  if (result.shape.empty())
  {
    std::vector<const PovValue*> declared;
    for (const auto& [name, value] : this->Names)
    {
      if (value.kind == PovValue::Kind::Shape && !value.used)
      {
        declared.push_back(&value);
      }
    }
    std::sort(
      declared.begin(), declared.end(), [](const PovValue* a, const PovValue* b) { return a->order < b->order; });
    for (const PovValue* value : declared)
    {
      result.shape.insert(result.shape.end(), value->shape.begin(), value->shape.end());
    }
  }
  const bool drawn = std::any_of(result.shape.begin(), result.shape.end(),
    [](const PovInstance& instance) { return !instance.mesh->faces.empty(); });
  if (!drawn)
  {
    if (!this->FirstProblem.empty())
    {
      this->fail(this->FirstProblemPlace, this->FirstProblem + ", and the file has no mesh");
    }
    this->fail({ 0, 0 }, "has no mesh", "mesh, mesh2 or triangle", "none");
  }
}

PovContents PovParser::run()
{
  PovContents result;
  this->scene(result);
  this->finish(result);
  result.rightHanded = this->Right < 0;
  result.defaultTexture = this->DefaultTexture;
  result.warnings = std::move(this->Warnings);
  if (!this->Scenery.empty())
  {
    std::string names;
    for (const std::string& name : this->Scenery)
    {
      names += (names.empty() ? "" : ", ") + name;
    }
    result.warnings.push_back("no part of the model, left out: " + names);
  }
  result.bytesRead = this->Tokens.bytesRead();
  result.files = this->Tokens.paths();
  return result;
}

PovContents readPovContents(const std::string& path) { return PovParser(path).run(); }

} // namespace dgtk
