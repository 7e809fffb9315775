// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPovSession_h
#define dgtkPovSession_h

#include "dgtkPovEvaluator.h"

namespace dgtk
{

/// A scene while it is read: where the reader stands, what is declared, and what becomes of what cannot be evaluated.
class PovSession
{
public:
  class Block;

  explicit PovSession(const std::string& path)
    : stream(path)
    , evaluator(stream, symbols)
  {
  }
  PovSession(const PovSession&) = delete;

  PovStream stream;
  PovSymbols symbols;
  PovEvaluator evaluator;

  void warn(const PovPlace& place, const std::string& what);
  /// What cannot be evaluated: refused inside a mesh, kept in mind in a group, a warning elsewhere.
  void problem(const PovPlace& place, const std::string& what);
  const PovProblem& firstProblem() const { return this->First; }
  bool isOutside() const { return this->Blocks.empty(); } ///< of all blocks that hold triangles
  std::vector<std::string> takeWarnings() { return std::move(this->Warnings); }

  /// The value of a declared name, which stands in the scene once more.
  const PovValue& use(const PovToken& name);
  /// A statement that makes no triangles. A mesh inside it would be lost: refused.
  void skipStatement(const PovToken& word);
  /// A word that should be a macro, which is not evaluated.
  void skipCall(const PovToken& word);

private:
  bool skipHoldsMesh(char open, char close, const std::string& what);

  std::vector<Block*> Blocks;
  std::vector<std::string> Warnings;
  PovProblem First;
  std::size_t Instances = 0;
};

/// A block that holds triangles, while it is read: a mesh, of which nothing may be missing, or a group, which may turn
/// out to hold no mesh.
class PovSession::Block
{
public:
  Block(PovSession& session, bool isMesh);
  ~Block() { this->Session.Blocks.pop_back(); }
  Block(const Block&) = delete;

  const bool isMesh;
  PovProblem problem; ///< what a group lacks first

private:
  PovSession& Session;
};

} // namespace dgtk

#endif
