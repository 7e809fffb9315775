// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkModelFolder.h"
#include "dgtkPovShapes.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace dgtk
{

namespace
{
/// Where an included file lies, or "": beside the including file, beside the scene, then in the folders of the
/// environment's POVINC (separated by ':'). What lies neither below the scene's folder nor below one of these is
/// refused; datasets keep the meshes of all cameras in ../../pov.
std::string findInclude(const PovTokenizer& files, const std::string& written, const PovPlace& from)
{
  namespace fs = std::filesystem;
  std::string name = written;
  std::replace(name.begin(), name.end(), '\\', '/');
  const std::string beside = folderOfFile(files.path(0));
  std::vector<std::string> own = { beside, beside + "/../../pov" };
  const char* library = std::getenv("POVINC");
  std::istringstream rest(library ? library : "");
  for (std::string folder; std::getline(rest, folder, ':');)
  {
    own.push_back(folder);
  }
  std::vector<std::string> folders = own;
  folders.insert(folders.begin(), folderOfFile(files.path(from.file)));
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
    files.fail(from, "#include " + quoted(written) + " lies outside of the scene's folder and POVINC");
  }
  return {};
}

/// Statements and directives of a scene.
class PovParser
{
public:
  explicit PovParser(const std::string& path)
    : Session(path)
    , Stream(Session.stream)
    , Appearance(Session)
    , Shapes(Session, Appearance)
  {
    this->Stream.setFollow([this](const PovToken& token) { this->directive(token); });
  }
  PovContents run();

private:
  void directive(const PovToken& token);
  void declare(const PovToken& token);
  PovValue value();
  void include(const PovToken& token);
  void condition(const PovToken& token);
  void endOfBranch(const PovToken& token);
  void skipBranch(const PovPlace& begin, bool toEnd);
  void skipEvaluated(const PovToken& token, const std::string& what);
  PovToken skipped(const PovPlace& place, const std::string& begin, int& depth);
  PovSymbols::Macro skipToEnd(const PovToken& begin, const std::string& what);
  void macro(const PovToken& token);
  void undef(const PovToken&) { this->Session.symbols.undeclare(this->Stream.take().text); }
  void setDefault(const PovToken&) { this->Appearance.readDefault(); }
  void loop(const PovToken& token) { this->skipEvaluated(token, "#" + token.text + " is not evaluated"); }
  void nothing(const PovToken&) {}
  void version(const PovToken& token);
  void message(const PovToken& token);
  void error(const PovToken& token);
  void file(const PovToken& token);
  PovShape scene();
  void checkDrawn(const PovShape& shape) const;

  PovSession Session;
  PovStream& Stream;
  PovAppearance Appearance;
  PovShapes Shapes;
  int OpenConditions = 0;
};

void PovParser::directive(const PovToken& token)
{
  using Follow = void (PovParser::*)(const PovToken&);
  static const std::map<std::string, Follow> follow = { { "declare", &PovParser::declare },
    { "local", &PovParser::declare }, { "undef", &PovParser::undef }, { "include", &PovParser::include },
    { "default", &PovParser::setDefault }, { "version", &PovParser::version }, { "macro", &PovParser::macro },
    { "if", &PovParser::condition }, { "ifdef", &PovParser::condition }, { "ifndef", &PovParser::condition },
    { "else", &PovParser::endOfBranch }, { "elseif", &PovParser::endOfBranch }, { "end", &PovParser::endOfBranch },
    { "while", &PovParser::loop }, { "for", &PovParser::loop }, { "switch", &PovParser::loop },
    { "break", &PovParser::nothing }, { "case", &PovParser::nothing }, { "range", &PovParser::nothing },
    { "error", &PovParser::error }, { "warning", &PovParser::message }, { "debug", &PovParser::message },
    { "render", &PovParser::message }, { "statistics", &PovParser::message }, { "fopen", &PovParser::file },
    { "fclose", &PovParser::file }, { "read", &PovParser::file }, { "write", &PovParser::file } };
  const PovStream::Level level(this->Stream);
  const auto found = follow.find(token.text);
  if (found == follow.end())
  {
    this->Stream.failAt(token, "unknown directive", "#declare, #include, #if, ...");
  }
  (this->*found->second)(token);
}

void PovParser::error(const PovToken& token)
{
  const PovToken& text = this->Stream.peek();
  this->Stream.fail(token.place, "#error " + (text.kind == PovToken::Kind::String ? quoted(text.text) : ""));
}

void PovParser::file(const PovToken& token)
{
  this->Session.problem(token.place, "#" + token.text + " is not evaluated");
  this->Stream.skipLine(token.place);
}

void PovParser::version(const PovToken&)
{
  while (this->Stream.peek().kind == PovToken::Kind::Word && !this->Stream.peek().is("version"))
  {
    this->Stream.take();
  }
  this->Session.evaluator.expression();
  this->Stream.accept(';');
}

void PovParser::message(const PovToken&)
{
  if (this->Stream.peek().kind == PovToken::Kind::String)
  {
    this->Stream.take();
  }
  else
  {
    this->Session.evaluator.expression();
  }
}

void PovParser::macro(const PovToken& token)
{
  const PovToken name = this->Stream.raw();
  this->Session.symbols.declareMacro(name.text, this->skipToEnd(token, ""));
}

/// What cannot be evaluated, up to its #end; names that it may set are not known any more.
void PovParser::skipEvaluated(const PovToken& token, const std::string& what)
{
  const PovSymbols::Macro inside = this->skipToEnd(token, what);
  this->Session.problem(token.place, what);
  this->Session.symbols.poison(inside.sets, token.place, what);
}

/// The next token of what is skipped behind `begin`; `depth` counts what an #end closes.
PovToken PovParser::skipped(const PovPlace& place, const std::string& begin, int& depth)
{
  static const std::set<std::string> opening = { "if", "ifdef", "ifndef", "while", "for", "switch", "macro" };
  PovToken token = this->Stream.raw();
  if (token.kind == PovToken::Kind::End)
  {
    this->Stream.fail(place, "#" + begin + " is not closed", "#end", "end of file");
  }
  if (token.kind == PovToken::Kind::Directive)
  {
    depth += opening.count(token.text) > 0 ? 1 : token.text == "end" ? -1 : 0;
  }
  return token;
}

/// Skips to the #end of a loop or macro. A mesh in a loop is refused; a macro's is noted for when it is called.
PovSymbols::Macro PovParser::skipToEnd(const PovToken& begin, const std::string& what)
{
  PovSymbols::Macro result;
  const bool isMacro = begin.text == "macro";
  std::string declares;
  for (int depth = 1; depth > 0;)
  {
    const PovToken token = this->skipped(begin.place, begin.text, depth);
    const std::string directive = token.kind == PovToken::Kind::Directive ? token.text : std::string();
    const bool mesh = this->Session.symbols.isMesh(token) || directive == "include";
    if (mesh && !isMacro)
    {
      this->Stream.fail(begin.place, what + ", and a mesh depends on it (" + quoted(token.text) + ", line " +
                                       std::to_string(token.place.line) + ')');
    }
    result.mesh = mesh && result.mesh.empty() ? token.text : result.mesh;
    if (token.kind == PovToken::Kind::Word && (declares == "declare" || (declares == "local" && !isMacro)))
    {
      result.sets.push_back(token.text);
    }
    declares = directive;
  }
  return result;
}

/// Skips the branch of a condition that is not taken: to its #end, or to an #else that is.
void PovParser::skipBranch(const PovPlace& begin, bool toEnd)
{
  for (int depth = 1; depth > 0;)
  {
    PovToken token = this->skipped(begin, "if", depth);
    if (token.kind != PovToken::Kind::Directive || depth != 1 || toEnd)
    {
      continue;
    }
    if (token.text == "else")
    {
      ++this->OpenConditions;
      return;
    }
    if (token.text == "elseif")
    {
      token.text = "if";
      this->condition(token);
      return;
    }
  }
}

void PovParser::endOfBranch(const PovToken& token)
{
  if (this->OpenConditions == 0)
  {
    this->Stream.fail(token.place, "#" + token.text + " without #if");
  }
  --this->OpenConditions;
  if (token.text != "end")
  {
    this->skipBranch(token.place, true);
  }
}

void PovParser::condition(const PovToken& token)
{
  PovNumber holds;
  this->Stream.expect('(', "a condition");
  if (token.text == "if")
  {
    holds = this->Session.evaluator.logical();
  }
  else
  {
    holds.v[0] = this->Session.symbols.has(this->Stream.take().text) == (token.text == "ifdef") ? 1 : 0;
    this->Stream.skipGroup("[");
  }
  this->Stream.expect(')', "a condition");
  if (holds.unknown)
  {
    this->skipEvaluated(token, "#if is not evaluated: " + holds.unknown->what);
  }
  else if (holds.v[0] != 0)
  {
    ++this->OpenConditions;
  }
  else
  {
    this->skipBranch(token.place, false);
  }
}

void PovParser::include(const PovToken& token)
{
  const PovToken name = this->Stream.take();
  const PovValue* named = this->Session.symbols.find(name, PovValue::Kind::Text);
  if (!named && name.kind != PovToken::Kind::String)
  {
    this->Stream.failAt(name, "#include names no file", "a file name in quotes");
  }
  const std::string written = named ? named->text : name.text;
  const std::string path = findInclude(this->Stream.files(), written, token.place);
  if (!path.empty())
  {
    this->Stream.files().include(path, token.place);
    return;
  }
  if (written == "colors.inc")
  {
    this->Session.symbols.declareColors();
  }
  const std::string what = "#include " + quoted(written) +
                           " not found (beside the including file, beside the scene, POVINC" +
                           (std::getenv("POVINC") ? ")" : " (not set))");
  this->Session.isOutside() ? this->Session.warn(token.place, what) : this->Session.problem(token.place, what);
}

/// The right-hand side of a declaration.
PovValue PovParser::value()
{
  PovValue value;
  const PovToken token = this->Stream.peek();
  const PovValue* known = this->Session.symbols.find(token);
  if (token.kind == PovToken::Kind::String)
  {
    value.kind = PovValue::Kind::Text;
    value.text = this->Stream.take().text;
  }
  else if (PovAppearance::begins(token))
  {
    value.kind = PovValue::Kind::Texture;
    do // layers: the last one is on top
    {
      value.texture = this->Appearance.texture(this->Stream.take().text, nullptr);
    } while (this->Stream.peek().is("texture"));
  }
  else if (this->Stream.accept("transform"))
  {
    value.kind = PovValue::Kind::Transform;
    value.transform = this->Session.evaluator.transformBlock();
  }
  else if (this->Stream.accept("camera"))
  {
    value.kind = PovValue::Kind::Camera;
    value.right = this->Shapes.camera();
  }
  else if (known && known->kind != PovValue::Kind::Number)
  {
    value = this->Session.use(this->Stream.take());
  }
  else if (PovShapes::isOther(token))
  {
    this->Stream.take();
    this->Stream.skipBlock();
    value.kind = PovValue::Kind::Other;
    value.text = token.text + " is not made of triangles";
  }
  else
  {
    PovShapeMaker maker;
    const bool isShape = this->Shapes.item(maker);
    value.kind = isShape ? PovValue::Kind::Shape : PovValue::Kind::Number;
    value.shape = maker.take();
    value.number = isShape ? PovNumber() : this->Session.evaluator.logical();
  }
  return value;
}

void PovParser::declare(const PovToken& directive)
{
  const PovToken name = this->Stream.take();
  if (name.kind != PovToken::Kind::Word)
  {
    this->Stream.failAt(name, "cannot understand #" + directive.text, "a name");
  }
  this->Stream.skipGroup("[");
  this->Stream.expect('=', "a declaration");
  PovValue value;
  this->Stream.readValue(
    [&]
    {
      value = this->value();
      this->Stream.accept(';');
    });
  for (PovInstance& instance : value.shape)
  {
    instance.name = instance.name.empty() ? name.text : instance.name;
  }
  this->Session.symbols.declare(name.text, std::move(value));
}

PovShape PovParser::scene()
{
  PovShapeMaker all;
  while (this->Stream.peek().kind != PovToken::Kind::End)
  {
    if (this->Shapes.item(all) || this->Stream.accept(';'))
    {
      continue;
    }
    const PovToken token = this->Stream.take();
    if (token.kind != PovToken::Kind::Word)
    {
      this->Stream.failAt(token, "cannot be understood here", "an object or a declaration");
    }
    this->Session.skipCall(token);
  }
  return all.take();
}

void PovParser::checkDrawn(const PovShape& shape) const
{
  const bool drawn =
    std::any_of(shape.begin(), shape.end(), [](const PovInstance& instance) { return !instance.mesh->faces.empty(); });
  const PovProblem& first = this->Session.firstProblem();
  if (!drawn && first.what.empty())
  {
    this->Stream.fail({ 0, 0 }, "has no mesh", "mesh, mesh2 or triangle", "none");
  }
  if (!drawn)
  {
    this->Stream.fail(first.place, first.what + ", and the file has no mesh");
  }
}

PovContents PovParser::run()
{
  PovContents result;
  result.shape = this->scene();
  if (result.shape.empty())
  {
    // a file of declarations only is drawn as if each mesh that no other one uses stood in the scene
    result.shape = this->Session.symbols.unused();
  }
  this->checkDrawn(result.shape);
  result.rightHanded = this->Shapes.right() < 0;
  result.defaultTexture = this->Appearance.defaultTexture();
  result.warnings = this->Session.takeWarnings();
  std::string scenery;
  for (const std::string& name : this->Shapes.scenery())
  {
    scenery += (scenery.empty() ? "no part of the model, left out: " : ", ") + name;
  }
  if (!scenery.empty())
  {
    result.warnings.push_back(scenery);
  }
  result.bytesRead = this->Stream.files().bytesRead();
  result.files = this->Stream.files().paths();
  return result;
}
} // namespace

PovContents readPovContents(const std::string& path) { return PovParser(path).run(); }

} // namespace dgtk
