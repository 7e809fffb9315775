// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovParser.h"

#include "dgtkError.h"
#include "dgtkModelFolder.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

namespace dgtk
{

namespace
{
const std::set<std::string> opening = { "if", "ifdef", "ifndef", "while", "for", "switch", "macro" };
/// Other objects that a name may stand for.
const std::set<std::string> otherWords = { "light_source", "sphere", "box", "plane", "cone", "cylinder", "torus",
  "disc", "blob", "lathe", "prism", "sor", "text", "height_field", "superellipsoid", "isosurface", "parametric",
  "normal", "interior", "media", "density", "fog", "sky_sphere", "rainbow", "color_map", "colour_map", "pigment_map",
  "normal_map", "texture_map", "slope_map", "sphere_sweep", "bicubic_patch", "polygon", "quadric", "cubic", "quartic",
  "poly", "julia_fractal", "background", "spline", "array", "function", "ovus", "lemon", "radiosity", "photons" };
} // namespace

void PovParser::directive(const PovToken& token)
{
  const Guard guard(*this);
  const std::string& name = token.text;
  if (name == "declare" || name == "local")
  {
    this->declare(token);
  }
  else if (name == "include")
  {
    this->include(token);
  }
  else if (name == "if" || name == "ifdef" || name == "ifndef")
  {
    this->condition(token);
  }
  else if (name == "else" || name == "elseif" || name == "end")
  {
    if (this->OpenConditions == 0)
    {
      this->fail(token.place, "#" + name + " without #if");
    }
    --this->OpenConditions;
    if (name != "end")
    {
      this->skipBranch(token.place, true);
    }
  }
  else if (name == "while" || name == "for" || name == "switch")
  {
    const Macro inside = this->skipEvaluated(token, "#" + name + " is not evaluated");
    this->problem(token.place, "#" + name + " is not evaluated");
    this->poison(inside.sets, token.place, "#" + name + " is not evaluated");
  }
  else if (name == "macro")
  {
    const PovToken word = this->raw();
    this->Macros[word.text] = this->skipEvaluated(token, "");
  }
  else if (name == "version")
  {
    while (this->peek().kind == PovToken::Kind::Word && this->peek().text != "version")
    {
      this->take();
    }
    this->expression();
    this->accept(';');
  }
  else if (name == "default")
  {
    this->defaults();
  }
  else if (name == "undef")
  {
    this->Names.erase(this->take().text);
  }
  else
  {
    this->message(token);
  }
}

void PovParser::message(const PovToken& token)
{
  const std::string& name = token.text;
  if (name == "error")
  {
    const PovToken text = this->peek();
    this->fail(token.place, "#error " + (text.kind == PovToken::Kind::String ? quoted(text.text) : std::string()));
  }
  if (name == "debug" || name == "warning" || name == "render" || name == "statistics")
  {
    if (this->peek().kind == PovToken::Kind::String)
    {
      this->take();
    }
    else
    {
      this->expression();
    }
  }
  else if (name == "fopen" || name == "fclose" || name == "read" || name == "write")
  {
    this->problem(token.place, "#" + name + " is not evaluated");
    this->skipLine(token.place);
  }
  else if (name != "break" && name != "case" && name != "range")
  {
    this->failAt(token, "unknown directive", "#declare, #include, #if, ...");
  }
}

void PovParser::skipLine(const PovPlace& place)
{
  PovToken token = this->raw();
  while (token.kind != PovToken::Kind::End && token.place.file == place.file && token.place.line == place.line)
  {
    token = this->raw();
  }
  this->Pending = std::move(token);
  this->HasPending = true;
}

void PovParser::poison(const std::vector<std::string>& names, const PovPlace& place, const std::string& what)
{
  for (const std::string& name : names)
  {
    PovValue value;
    value.place = place;
    value.text = what;
    this->Names[name] = value;
  }
}

/// Skips to the #end of a loop or macro. A mesh in a loop is refused; a macro's is noted for when it is called.
PovParser::Macro PovParser::skipEvaluated(const PovToken& begin, const std::string& what)
{
  Macro result;
  const bool isMacro = begin.text == "macro";
  int depth = 1;
  std::string declares;
  while (depth > 0)
  {
    const PovToken token = this->raw();
    if (token.kind == PovToken::Kind::End)
    {
      this->fail(begin.place, "#" + begin.text + " is not closed", "#end", "end of file");
    }
    if (token.kind == PovToken::Kind::Directive)
    {
      depth += opening.count(token.text) > 0 ? 1 : token.text == "end" ? -1 : 0;
    }
    const bool mesh = this->holdsMesh(token) || (token.kind == PovToken::Kind::Directive && token.text == "include");
    if (mesh && !isMacro)
    {
      this->fail(begin.place, what + ", and a mesh depends on it (" + quoted(token.text) + ", line " +
                                std::to_string(token.place.line) + ')');
    }
    result.what = mesh && result.what.empty() ? token.text : result.what;
    if (token.kind == PovToken::Kind::Word && (declares == "declare" || (declares == "local" && !isMacro)))
    {
      result.sets.push_back(token.text);
    }
    declares = token.kind == PovToken::Kind::Directive ? token.text : std::string();
  }
  return result;
}

/// Skips the branch of a condition that is not taken: to its #end, or to an #else that is.
void PovParser::skipBranch(const PovPlace& begin, bool toEnd)
{
  int depth = 1;
  while (depth > 0)
  {
    const PovToken token = this->raw();
    if (token.kind == PovToken::Kind::End)
    {
      this->fail(begin, "#if is not closed", "#end", "end of file");
    }
    if (token.kind != PovToken::Kind::Directive)
    {
      continue;
    }
    depth += opening.count(token.text) > 0 ? 1 : token.text == "end" ? -1 : 0;
    if (depth == 1 && !toEnd && token.text == "else")
    {
      ++this->OpenConditions;
      return;
    }
    if (depth == 1 && !toEnd && token.text == "elseif")
    {
      PovToken again = token;
      again.text = "if";
      this->condition(again);
      return;
    }
  }
}

void PovParser::condition(const PovToken& token)
{
  bool holds = false;
  if (token.text == "if")
  {
    this->expect('(', "a condition");
    const Number value = this->logical();
    this->expect(')', "a condition");
    if (value.unknown >= 0)
    {
      const std::string what = "#if is not evaluated: " + this->Reasons[static_cast<std::size_t>(value.unknown)].second;
      const Macro inside = this->skipEvaluated(token, what);
      this->problem(token.place, what);
      this->poison(inside.sets, token.place, what);
      return;
    }
    holds = value.v[0] != 0;
  }
  else
  {
    this->expect('(', "a condition");
    const std::string name = this->take().text;
    holds = (this->Names.count(name) > 0 || this->Macros.count(name) > 0) == (token.text == "ifdef");
    if (this->peek().is('['))
    {
      this->skipBalanced('[', ']');
    }
    this->expect(')', "a condition");
  }
  if (holds)
  {
    ++this->OpenConditions;
    return;
  }
  this->skipBranch(token.place, false);
}

/// Library colours of the same names, for scenes whose colors.inc is not at hand.
void PovParser::declareColors()
{
  const auto color = [this](const std::string& name, double r, double g, double b)
  {
    if (this->Names.count(name) == 0)
    {
      PovValue value;
      value.kind = PovValue::Kind::Color;
      value.number = { r, g, b, 0, 0 };
      value.size = 5;
      this->Names[name] = value;
    }
  };
  color("Red", 1, 0, 0), color("Green", 0, 1, 0), color("Blue", 0, 0, 1), color("Yellow", 1, 1, 0);
  color("Cyan", 0, 1, 1), color("Magenta", 1, 0, 1), color("White", 1, 1, 1), color("Black", 0, 0, 0);
  for (int percent = 5; percent <= 95; percent += 5)
  {
    for (const char* grey : { "Gray", "Grey" })
    {
      const std::string digits = (percent < 10 ? "0" : "") + std::to_string(percent);
      color(grey + digits, percent / 100.0, percent / 100.0, percent / 100.0);
    }
  }
}

/// Beside the including file, beside the scene, then in the folders of the environment's POVINC (separated by ':').
/// What lies neither below the scene's folder nor below one of these is refused; datasets keep the meshes of all
/// cameras in ../../pov.
std::string PovParser::findInclude(const std::string& written, const PovPlace& from, std::string& tried) const
{
  namespace fs = std::filesystem;
  std::string name = written;
  for (char& c : name)
  {
    c = c == '\\' ? '/' : c;
  }
  const std::string beside = folderOfFile(this->Tokens.path(0));
  std::vector<std::string> own = { beside, beside + "/../../pov" };
  const char* library = std::getenv("POVINC");
  std::string rest = library ? library : "";
  while (!rest.empty())
  {
    const std::size_t end = std::min(rest.find(':'), rest.size());
    own.push_back(rest.substr(0, end));
    rest.erase(0, end + 1);
  }
  tried = std::string("beside the including file, beside the scene, POVINC") + (library ? "" : " (not set)");
  std::vector<std::string> folders = own;
  folders.insert(folders.begin(), folderOfFile(this->Tokens.path(from.file)));
  bool outside = false;
  for (const std::string& folder : folders)
  {
    std::error_code code;
    const fs::path path = fs::path(folder) / name;
    if (name.size() < 4096 && fs::is_regular_file(path, code))
    {
      std::string found = path.lexically_normal().string();
      if (std::any_of(own.begin(), own.end(), [&found](const std::string& root) { return liesBeneath(found, root); }))
      {
        return found;
      }
      outside = true;
    }
  }
  if (outside)
  {
    this->Tokens.fail(from, "#include " + dgtk::quoted(written) + " lies outside of the scene's folder and POVINC");
  }
  return {};
}

void PovParser::include(const PovToken& token)
{
  const PovToken name = this->take();
  std::string written = name.text;
  const auto known = this->Names.find(name.text);
  if (name.kind == PovToken::Kind::Word && known != this->Names.end() && known->second.kind == PovValue::Kind::Text)
  {
    written = known->second.text;
  }
  else if (name.kind != PovToken::Kind::String)
  {
    this->failAt(name, "#include names no file", "a file name in quotes");
  }
  std::string tried;
  const std::string path = this->findInclude(written, token.place, tried);
  if (!path.empty())
  {
    this->Tokens.include(path, token.place);
    return;
  }
  if (written == "colors.inc")
  {
    this->declareColors();
  }
  const std::string what = "#include " + dgtk::quoted(written) + " not found (" + tried + ")";
  if (this->Contexts.empty())
  {
    this->warn(token.place, what);
    return;
  }
  this->problem(token.place, what);
}

void PovParser::defaults()
{
  this->expect('{', "#default");
  while (!this->accept('}'))
  {
    const PovToken word = this->take();
    if (word.is("texture") || word.is("pigment") || word.is("finish"))
    {
      this->DefaultTexture = this->texture(word.text, this->DefaultTexture);
    }
    else if (word.kind == PovToken::Kind::Word)
    {
      this->skipOptionalBlock();
    }
    else
    {
      this->failAt(word, "cannot understand #default", "texture, pigment or finish");
    }
  }
}

/// The right-hand side of a declaration.
PovValue PovParser::value()
{
  PovValue value;
  const PovToken token = this->peek();
  value.place = token.place;
  const auto known = token.kind == PovToken::Kind::Word ? this->Names.find(token.text) : this->Names.end();
  if (token.kind == PovToken::Kind::String)
  {
    value.kind = PovValue::Kind::Text;
    value.text = this->take().text;
  }
  else if (token.is("texture") || token.is("pigment") || token.is("finish") || token.is("material"))
  {
    this->take();
    value.kind = PovValue::Kind::Texture;
    value.texture = this->texture(token.text, this->DefaultTexture);
    while (this->peek().is("texture")) // layers: the last one is on top
    {
      this->take();
      value.texture = this->texture("texture", this->DefaultTexture);
    }
  }
  else if (token.is("transform"))
  {
    this->take();
    value.kind = PovValue::Kind::Transform;
    value.transform = this->transformBlock();
  }
  else if (token.is("camera"))
  {
    this->take();
    value.kind = PovValue::Kind::Camera;
    value.right = this->camera();
  }
  else if (known != this->Names.end() && !known->second.isNumeric() && known->second.kind != PovValue::Kind::Unknown)
  {
    known->second.used = true;
    this->countInstances(known->second.shape.size(), token.place);
    value = known->second;
    this->take();
  }
  else if (token.kind == PovToken::Kind::Word && otherWords.count(token.text) > 0)
  {
    this->take();
    while (this->peek().is('(') || this->peek().is('['))
    {
      this->skipBalanced(this->peek().text[0], this->peek().is('(') ? ')' : ']');
    }
    this->skipOptionalBlock();
    const bool numeric = token.is("array") || token.is("function") || token.is("spline");
    value.kind = numeric ? PovValue::Kind::Unknown : PovValue::Kind::Other;
    value.text = token.text + (numeric ? " is not evaluated" : " is not made of triangles");
  }
  else
  {
    ShapeList list;
    if (this->item(list))
    {
      value.kind = PovValue::Kind::Shape;
      value.shape = list.take();
      return value;
    }
    const Number number = this->logical();
    value.kind = number.unknown >= 0 ? PovValue::Kind::Unknown
                 : number.isColor    ? PovValue::Kind::Color
                                     : PovValue::Kind::Number;
    value.number = number.v;
    value.size = number.size;
    value.text = number.unknown >= 0 ? this->Reasons[static_cast<std::size_t>(number.unknown)].second : "";
  }
  return value;
}

void PovParser::declare(const PovToken& directive)
{
  const PovToken name = this->take();
  if (name.kind != PovToken::Kind::Word)
  {
    this->failAt(name, "cannot understand #" + directive.text, "a name");
  }
  if (this->peek().is('['))
  {
    this->skipBalanced('[', ']');
  }
  this->expect('=', "a declaration");
  const int outer = this->DeferAt;
  this->DeferAt = this->Nesting;
  PovValue value = this->value();
  value.used = false;
  value.order = ++this->Declarations;
  for (PovInstance& instance : value.shape)
  {
    instance.name = instance.name.empty() ? name.text : instance.name;
  }
  this->accept(';');
  this->Names[name.text] = std::move(value);
  this->DeferAt = outer;
  if (this->HasLook && this->Look.kind == PovToken::Kind::Directive)
  {
    this->Pending = std::move(this->Look);
    this->HasPending = true;
    this->HasLook = false;
  }
}

} // namespace dgtk
