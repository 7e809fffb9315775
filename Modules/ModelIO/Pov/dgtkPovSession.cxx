// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovSession.h"

#include "dgtkError.h"

namespace dgtk
{

namespace
{
constexpr std::size_t mostInstances = 50'000; ///< and one for every hundred bytes read
constexpr std::size_t mostWarnings = 1000;
const char* const dependsOnIt = ", and a mesh depends on it";
} // namespace

void PovSession::warn(const PovPlace& place, const std::string& what)
{
  const std::string& path = this->stream.files().path(place.file);
  const std::string name = path.substr(path.find_last_of('/') + 1);
  if (this->Warnings.size() < mostWarnings)
  {
    this->Warnings.push_back(name + ':' + std::to_string(place.line) + ": " + what);
  }
}

void PovSession::problem(const PovPlace& place, const std::string& what)
{
  const auto keep = [&](PovProblem& to) { to = to.what.empty() ? PovProblem{ place, what } : to; };
  keep(this->First);
  if (this->Blocks.empty())
  {
    this->warn(place, what + ": left out");
  }
  else if (this->Blocks.back()->isMesh)
  {
    this->stream.fail(place, what + dependsOnIt);
  }
  else
  {
    keep(this->Blocks.back()->problem);
  }
}

const PovValue& PovSession::use(const PovToken& name)
{
  PovValue& value = this->symbols.at(name.text);
  value.used = true;
  this->Instances += value.shape.size();
  const std::size_t most = mostInstances + static_cast<std::size_t>(this->stream.files().bytesRead() / 100);
  if (this->Instances > most)
  {
    this->stream.fail(name.place, "has too many objects", "at most " + std::to_string(most));
  }
  return value;
}

bool PovSession::skipHoldsMesh(char open, char close, const std::string& what)
{
  bool mesh = false;
  this->stream.skip(open, close, what, [&](const PovToken& token) { mesh = mesh || this->symbols.isMesh(token); });
  return mesh;
}

void PovSession::skipStatement(const PovToken& word)
{
  if (this->skipHoldsMesh('{', '}', quoted(word.text)))
  {
    this->stream.fail(word.place, quoted(word.text) + " with a mesh in it cannot be read");
  }
}

void PovSession::skipCall(const PovToken& word)
{
  if (!this->symbols.macro(word))
  {
    this->stream.fail(word.place, "undeclared name " + quoted(word.text));
  }
  const PovSymbols::Macro macro = *this->symbols.macro(word);
  const std::string what = "macro " + quoted(word.text) + " is not evaluated";
  if (!macro.mesh.empty() || (this->stream.peek().is('(') && this->skipHoldsMesh('(', ')', what)))
  {
    this->stream.fail(word.place, what + dependsOnIt);
  }
  this->problem(word.place, what);
  this->symbols.poison(macro.sets, word.place, what);
}

PovSession::Block::Block(PovSession& session, bool mesh)
  : isMesh(mesh)
  , Session(session)
{
  session.Blocks.push_back(this);
}

} // namespace dgtk
