// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPovEvaluator_h
#define dgtkPovEvaluator_h

#include "dgtkPovFunctions.h"
#include "dgtkPovStream.h"
#include "dgtkPovSymbols.h"

namespace dgtk
{

/// Constant arithmetic and transforms: literals, declared names, colours, + - * /, POV-Ray's own functions of floats
/// and vectors and, in parentheses, comparisons and choices. What is no constant (a function of the scene's, an
/// undeclared name, a division by zero) is a number that is not known, and says why. Throws InputError for what is no
/// expression.
class PovEvaluator
{
public:
  PovEvaluator(PovStream& stream, const PovSymbols& symbols)
    : Stream(stream)
    , Symbols(symbols)
  {
  }
  /// A value as it stands in a scene.
  PovNumber expression();
  /// A value as it stands in parentheses or a declaration: also `a < b`, `a & b`, `a ? b : c`.
  PovNumber logical();
  /// A value where one may stand: false, with nothing taken, before a word that is none, and when it is not known.
  bool optional(PovNumber& to);

  /// Of an expression that has to be known. A float is a vector that has it in all components.
  double scalar();
  Eigen::Vector3d vector(const char* where);

  /// Reads the transform that comes next, after those of `total`: POV-Ray applies them in the order written. False,
  /// with nothing taken, when none comes.
  bool transform(Eigen::Affine3d& total);
  /// What stands behind `transform`: a name, or a block of transforms.
  Eigen::Affine3d transformBlock();

  /// Whether a token begins a colour: `rgb`, `color`, `red`, ... or the name of one.
  bool beginsColor(const PovToken& token) const;

private:
  PovNumber term();
  PovNumber factor();
  PovNumber member(PovNumber value);
  PovNumber primary();
  PovNumber vectorLiteral();
  PovNumber word();
  /// Behind the name and its parenthesis.
  PovNumber call(const PovToken& name, const PovFunction& function);
  PovNumber undeclared(const PovToken& word);
  PovNumber colorWord(const PovToken& word);
  PovNumber withComponents(PovNumber color);
  void component(const PovToken& word, PovNumber& color);
  PovNumber comparison();
  Eigen::Affine3d matrix();
  Eigen::Affine3d namedTransform();
  Eigen::Vector3d known(const PovNumber& number, const PovPlace& place) const;

  PovStream& Stream;
  const PovSymbols& Symbols;
};

} // namespace dgtk

#endif
