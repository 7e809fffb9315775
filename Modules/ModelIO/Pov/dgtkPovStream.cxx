// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovStream.h"

#include "dgtkError.h"

namespace dgtk
{

namespace
{
constexpr int deepestInclude = 150;
}

PovToken PovStream::raw()
{
  if (this->HasPending)
  {
    this->HasPending = false;
    return std::move(this->Pending);
  }
  return this->Files.next();
}

const PovToken& PovStream::peek()
{
  while (!this->HasLook)
  {
    PovToken token = this->raw();
    if (token.kind == PovToken::Kind::Directive && this->Nesting != this->DeferAt && this->Directive)
    {
      this->Directive(token);
    }
    else
    {
      this->Look = std::move(token);
      this->HasLook = true;
    }
  }
  return this->Look;
}

bool PovStream::drop()
{
  const bool opens = this->Look.is('{') || this->Look.is('(');
  const bool closes = this->Look.is('}') || this->Look.is(')');
  this->Nesting += opens ? 1 : closes ? -1 : 0;
  this->HasLook = false;
  return true;
}

PovToken PovStream::take()
{
  this->peek();
  this->drop();
  return std::exchange(this->Look, PovToken());
}

void PovStream::failAt(const PovToken& token, const std::string& what, const std::string& expected) const
{
  this->fail(token.place, what, expected, token.kind == PovToken::Kind::End ? "end of file" : quoted(token.text));
}

void PovStream::expect(char symbol, const char* where)
{
  if (!this->accept(symbol))
  {
    this->failAt(this->peek(), std::string("cannot understand ") + where, quoted(std::string(1, symbol)));
  }
}

bool PovStream::goesOn(char close, const char* where)
{
  const PovToken& token = this->peek();
  if (token.kind == PovToken::Kind::End)
  {
    this->failAt(token, std::string("ends inside ") + where, quoted(std::string(1, close)));
  }
  return !this->accept(close);
}

void PovStream::skip(char open, char close, const std::string& what, const std::function<void(const PovToken&)>& see)
{
  const PovPlace begin = this->peek().place;
  this->expect(open, what.c_str());
  for (int depth = 1; depth > 0;)
  {
    const PovToken token = this->take();
    if (token.kind == PovToken::Kind::End)
    {
      this->fail(begin, what + " is not closed", quoted(std::string(1, close)), "end of file");
    }
    depth += token.is(open) ? 1 : token.is(close) ? -1 : 0;
    if (see)
    {
      see(token);
    }
  }
}

bool PovStream::skipGroup(const std::string& opening)
{
  const PovToken& token = this->peek();
  const char open = token.kind == PovToken::Kind::Symbol ? token.text[0] : ' ';
  if (opening.find(open) == std::string::npos)
  {
    return false;
  }
  this->skip(open, open == '(' ? ')' : open == '[' ? ']' : '}');
  return true;
}

void PovStream::skipRest(const char* where)
{
  while (this->goesOn('}', where))
  {
    if (!this->skipGroup("{"))
    {
      this->take();
    }
  }
}

void PovStream::readValue(const std::function<void()>& read)
{
  const int outer = std::exchange(this->DeferAt, this->Nesting);
  read();
  this->DeferAt = outer;
  if (this->HasLook && this->Look.kind == PovToken::Kind::Directive)
  {
    this->Pending = std::move(this->Look);
    this->HasPending = true;
    this->HasLook = false;
  }
}

void PovStream::skipLine(const PovPlace& place)
{
  do
  {
    this->Pending = this->raw();
  } while (this->Pending.kind != PovToken::Kind::End && this->Pending.place.file == place.file &&
           this->Pending.place.line == place.line);
  this->HasPending = true;
}

PovStream::Level::Level(PovStream& stream)
  : Stream(stream)
{
  if (++stream.Depth > deepestInclude)
  {
    --stream.Depth;
    stream.fail(stream.HasLook ? stream.Look.place : PovPlace{ 0, 1 }, "nests too deeply",
      "at most " + std::to_string(deepestInclude) + " levels");
  }
}

} // namespace dgtk
