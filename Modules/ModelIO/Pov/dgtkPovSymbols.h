// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPovSymbols_h
#define dgtkPovSymbols_h

#include "dgtkPovContents.h"
#include "dgtkPovTokenizer.h"

#include <map>
#include <optional>

namespace dgtk
{

/// What cannot be evaluated, and where it stands.
struct PovProblem
{
  PovPlace place;
  std::string what; ///< "" is none
};

/// A float, vector or colour.
struct PovNumber
{
  std::array<double, 5> v{}; ///< colour: r, g, b, filter, transmit
  int size = 1;
  bool isColor = false;
  std::shared_ptr<const PovProblem> unknown; ///< why it needs evaluation that is not done here, or null

  bool isKnownColor() const { return this->isColor && !this->unknown; }
  Eigen::Vector3d rgb() const { return { this->v[0], this->v[1], this->v[2] }; }
};

/// A value of the language.
struct PovValue
{
  enum class Kind : std::uint8_t
  {
    Number,
    Text,
    Texture, ///< texture, pigment, finish, material
    Transform,
    Shape, ///< meshes; may be empty
    Camera,
    Other ///< anything without a surface of triangles: primitives, lights, ...
  };
  Kind kind = Kind::Number;
  PovNumber number;
  std::string text; ///< Text; Other: why it is not drawn
  PovTexturePointer texture;
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  PovShape shape;
  double right = 1; ///< Camera: sign of the x of `right`
  bool used = false;
  std::size_t order = 0; ///< of declaration

  /// Why it is no object.
  std::string whyNot(const std::string& otherwise) const;
};

/// What the names of a scene stand for.
class PovSymbols
{
public:
  /// What it would do, were it evaluated.
  struct Macro
  {
    std::string mesh;              ///< the word in it that is or draws a mesh, or ""
    std::vector<std::string> sets; ///< names
  };

  /// Of a word that is declared (as that kind); else null.
  const PovValue* find(const PovToken& token, std::optional<PovValue::Kind> kind = {}) const;
  PovValue& at(const std::string& name) { return this->Values.at(name); }
  const Macro* macro(const PovToken& token) const;
  /// Whether there is a value or a macro of that name.
  bool has(const std::string& name) const { return this->Values.count(name) > 0 || this->Macros.count(name) > 0; }

  /// A texture that has no name yet gets that one.
  void declare(const std::string& name, PovValue value);
  void declareMacro(const std::string& name, const Macro& macro) { this->Macros[name] = macro; }
  void undeclare(const std::string& name) { this->Values.erase(name); }
  /// Names that something would set that is not evaluated.
  void poison(const std::vector<std::string>& names, const PovPlace& place, const std::string& what);
  /// The library's colours of the same names, for scenes whose colors.inc is not at hand.
  void declareColors();

  /// Whether a token begins or stands for a mesh.
  bool isMesh(const PovToken& token) const;
  /// Declared meshes that nothing uses, in the order of their declaration.
  PovShape unused() const;

private:
  std::map<std::string, PovValue> Values;
  std::map<std::string, Macro> Macros;
  std::size_t Declarations = 0;
};

} // namespace dgtk

#endif
