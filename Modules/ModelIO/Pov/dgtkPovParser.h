// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPovParser_h
#define dgtkPovParser_h

#include "dgtkPovContents.h"

#include <set>

namespace dgtk
{

/// The subset of POV-Ray's language that says where triangles are and how they look: literals, constant arithmetic,
/// declarations, inclusions and conditions are followed; loops, macros and functions are not. What a mesh depends on
/// is then refused, everything else skipped with a warning.
class PovParser
{
public:
  explicit PovParser(const std::string& path);
  PovContents run();

private:
  /// A float, vector or colour.
  struct Number
  {
    std::array<double, 5> v{};
    int size = 1;
    bool isColor = false;
    int unknown = -1; ///< index into Reasons: it needs evaluation
  };
  struct Macro
  {
    std::string what; ///< a mesh in it, or ""
    std::vector<std::string> sets;
  };
  /// A block being read that holds triangles.
  struct Context
  {
    bool isMesh = false; ///< nothing may be missing; else a group, that may turn out to hold no mesh
    std::string problem; ///< what a group lacks
    PovPlace place;
  };
  struct Modifiers
  {
    Eigen::Affine3d transform = Eigen::Affine3d::Identity();
    PovTexturePointer texture;
    Eigen::Affine3d atTexture = Eigen::Affine3d::Identity();
    bool invisible = false;
  };
  /// Collects triangles; equal vertices become one.
  class MeshMaker;
  /// Shapes of a group in file order; bare triangles between them are one mesh.
  class ShapeList;
  class Guard;

  // tokens: dgtkPovParser.cxx
  PovToken raw();
  const PovToken& peek();
  PovToken take();
  void drop();
  bool accept(char symbol);
  void expect(char symbol, const char* where);
  [[noreturn]] void fail(
    const PovPlace& place, const std::string& what, const std::string& expected = {}, const std::string& found = {})
  {
    this->Tokens.fail(place, what, expected, found);
  }
  [[noreturn]] void failAt(const PovToken& token, const std::string& what, const std::string& expected);
  void warn(const PovPlace& place, const std::string& what);
  /// What cannot be evaluated: refused inside a mesh, kept in mind in a group, a warning elsewhere.
  void problem(const PovPlace& place, const std::string& what);
  /// Skips to the end of a balanced block whose opening symbol is next. True when a mesh stands in it.
  bool skipBalanced(char open, char close);
  void skipOptionalBlock();
  bool holdsMesh(const PovToken& token) const;

  // statements: dgtkPovParser.cxx
  void scene(PovContents& result);
  void finish(PovContents& result);
  bool item(ShapeList& list);
  void skipStatement(const PovToken& word);
  void macroCall(const PovToken& word);

  // directives: dgtkPovDirective.cxx
  void directive(const PovToken& token);
  void declare(const PovToken& token);
  void include(const PovToken& token);
  std::string findInclude(const std::string& name, const PovPlace& from, std::string& tried) const;
  void condition(const PovToken& token);
  void skipBranch(const PovPlace& begin, bool toEnd);
  Macro skipEvaluated(const PovToken& token, const std::string& what);
  void poison(const std::vector<std::string>& names, const PovPlace& place, const std::string& what);
  void message(const PovToken& token);
  void skipLine(const PovPlace& place);
  void defaults();
  void declareColors();
  PovValue value();

  // arithmetic: dgtkPovExpression.cxx
  Number expression();
  Number term();
  Number factor();
  Number primary();
  Number word();
  double component(Number& color);
  Number withComponents(Number color);
  Number colorWord(const PovToken& word);
  Number vectorLiteral();
  Number comparison();
  Number logical();
  Number member(Number value);
  Number unknown(const PovPlace& place, const std::string& what);
  Number combine(const Number& a, const Number& b, char operation);
  double scalar(const Number& number, const PovPlace& place);
  Eigen::Vector3d vector(const char* where);
  Eigen::Vector3d known(const Number& number, const PovPlace& place);

  // appearance: dgtkPovTexture.cxx
  PovTexturePointer texture(const std::string& kind, const PovTexturePointer& base);
  bool textureWord(const PovToken& word, PovTexture& to);
  void pigment(PovTexture& to);
  void colorMap(PovTexture& to, int& colors, Eigen::Vector3d& sum);
  void imageMap(PovTexture& to);
  PovTexturePointer mapEntry(PovTexture& to);
  PovTexturePointer textureMap(PovTexture& to);
  void finishBlock(PovTexture& to);
  bool optionalNumber(Number& to);

  // shapes: dgtkPovShape.cxx, dgtkPovMesh.cxx
  bool isTransform(const PovToken& token) const;
  bool transform(Eigen::Affine3d& total);
  Eigen::Affine3d transformBlock();
  bool modifier(Modifiers& modifiers);
  bool flag(const PovToken& token);
  void apply(PovShape& shape, const Modifiers& modifiers, bool replaceTexture);
  PovShape group(const PovToken& word);
  PovShape object();
  PovShape mesh();
  PovShape mesh2();
  void triangle(bool smooth, MeshMaker& to);
  template <class Item>
  void list(const char* name, Item item);
  void faces(PovMesh& mesh);
  void indices(const char* name, std::vector<std::array<std::uint32_t, 3>>& to);
  std::array<std::uint32_t, 3> indexTriple();
  std::uint32_t index(double value, const PovPlace& place);
  double camera();
  void countInstances(std::size_t more, const PovPlace& place);

  PovTokenizer Tokens;
  PovToken Pending; ///< given back by raw() first
  bool HasPending = false;
  PovToken Look;
  bool HasLook = false;
  int Depth = 0;
  int Nesting = 0;  ///< open braces and parentheses
  int DeferAt = -1; ///< a directive at this nesting ends a declaration's value, and has to wait for it
  int OpenConditions = 0;
  std::map<std::string, PovValue> Names;
  std::map<std::string, Macro> Macros;
  std::vector<std::pair<PovPlace, std::string>> Reasons;
  std::vector<Context> Contexts;
  PovTexturePointer DefaultTexture;
  std::vector<std::string> Warnings;
  bool MapWarned = false;        ///< maps of textures are warned of once
  std::set<std::string> Scenery; ///< statements that are no part of the model
  std::string FirstProblem;
  PovPlace FirstProblemPlace;
  std::size_t Declarations = 0;
  std::size_t Instances = 0;
  double Right = 1;
};

/// Depth of nesting; refuses what would overflow the stack.
class PovParser::Guard
{
public:
  explicit Guard(PovParser& parser)
    : Parser(parser)
  {
    if (++parser.Depth > 150)
    {
      --parser.Depth;
      parser.fail(parser.HasLook ? parser.Look.place : PovPlace{ 0, 1 }, "nests too deeply", "at most 150 levels");
    }
  }
  ~Guard() { --this->Parser.Depth; }
  Guard(const Guard&) = delete;
  Guard& operator=(const Guard&) = delete;

private:
  PovParser& Parser;
};

class PovParser::MeshMaker
{
public:
  MeshMaker()
    : Mesh(std::make_shared<PovMesh>())
  {
  }
  std::uint32_t vertex(const Eigen::Vector3d& position);
  std::int32_t normal(const Eigen::Vector3d& direction);
  std::int32_t uv(const Eigen::Vector2d& uv);
  std::int32_t texture(const PovTexturePointer& texture);
  void add(const PovMesh::Face& face) { this->Mesh->faces.push_back(face); }
  bool empty() const { return this->Mesh->faces.empty(); }
  /// The mesh so far; starts a new one.
  std::shared_ptr<const PovMesh> take();

private:
  std::shared_ptr<PovMesh> Mesh;
  std::map<std::array<double, 3>, std::uint32_t> Known;
  std::map<PovTexturePointer, std::int32_t> KnownTextures;
};

class PovParser::ShapeList
{
public:
  MeshMaker& triangles() { return this->Run; }
  void add(const PovShape& shape)
  {
    this->flush();
    this->Shape.insert(this->Shape.end(), shape.begin(), shape.end());
  }
  PovShape take()
  {
    this->flush();
    return std::move(this->Shape);
  }

private:
  void flush()
  {
    if (!this->Run.empty())
    {
      PovInstance instance;
      instance.mesh = this->Run.take();
      this->Shape.push_back(instance);
    }
  }
  MeshMaker Run;
  PovShape Shape;
};

} // namespace dgtk

#endif
