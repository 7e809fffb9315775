// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovEvaluator.h"

#include "dgtkError.h"
#include "dgtkPortableMath.h"
#include "dgtkPovFunctions.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
/// Names that POV-Ray itself gives a value; those of the command line have its defaults.
const std::map<std::string, double> constants = { { "pi", pi }, { "tau", 2 * pi }, { "true", 1 }, { "false", 0 },
  { "yes", 1 }, { "no", 0 }, { "on", 1 }, { "off", 0 }, { "clock", 0 }, { "clock_delta", 1 }, { "clock_on", 0 },
  { "frame_number", 1 }, { "initial_frame", 1 }, { "final_frame", 1 }, { "initial_clock", 0 }, { "final_clock", 0 },
  { "image_width", 160 }, { "image_height", 120 }, { "version", 3.7 }, { "unix", 1 } };
const std::map<std::string, std::size_t> members = { { "x", 0 }, { "y", 1 }, { "z", 2 }, { "t", 3 }, { "u", 0 },
  { "v", 1 }, { "red", 0 }, { "green", 1 }, { "blue", 2 }, { "filter", 3 }, { "transmit", 4 } };
/// Components that each colour word's vector has, in order: r, g, b, then filter or (negative) transmit; 0: as many as
/// there are.
const std::map<std::string, int> colorWords = { { "color", 0 }, { "colour", 0 }, { "rgb", 3 }, { "srgb", 3 },
  { "rgbf", 4 }, { "srgbf", 4 }, { "rgbt", -4 }, { "srgbt", -4 }, { "rgbft", 5 }, { "srgbft", 5 } };
const std::map<std::string, double (*)(double, double)> operations = { { "+",
                                                                         [](double x, double y) { return x + y; } },
  { "-", [](double x, double y) { return x - y; } }, { "*", [](double x, double y) { return x * y; } },
  { "/", [](double x, double y) { return x / y; } }, { "<", [](double x, double y) { return double(x < y); } },
  { "<=", [](double x, double y) { return double(x <= y); } },
  { ">", [](double x, double y) { return double(x > y); } },
  { ">=", [](double x, double y) { return double(x >= y); } },
  { "=", [](double x, double y) { return double(x == y); } },
  { "!=", [](double x, double y) { return double(x != y); } },
  { "&", [](double x, double y) { return double(x != 0 && y != 0); } },
  { "|", [](double x, double y) { return double(x != 0 || y != 0); } } };

bool isColorMember(const PovToken& token)
{
  return token.kind == PovToken::Kind::Word && token.text.size() >= 3 && members.count(token.text) > 0;
}

PovNumber unknown(const PovPlace& place, const std::string& what)
{
  PovNumber number;
  number.unknown = std::make_shared<PovProblem>(PovProblem{ place, what });
  return number;
}

PovNumber combine(const PovNumber& a, const PovNumber& b, const std::string& operation)
{
  if (a.unknown || b.unknown)
  {
    return a.unknown ? a : b;
  }
  PovNumber result;
  result.size = std::max(a.size, b.size);
  result.isColor = a.isColor || b.isColor;
  const std::array<double, 5> left = promoted(a, result.size);
  const std::array<double, 5> right = promoted(b, result.size);
  std::transform(left.begin(), left.begin() + result.size, right.begin(), result.v.begin(), operations.at(operation));
  return result;
}

} // namespace

PovNumber PovEvaluator::expression()
{
  const PovStream::Level level(this->Stream);
  PovNumber value = this->term();
  while (this->Stream.peek().is('+') || this->Stream.peek().is('-'))
  {
    const std::string operation = this->Stream.take().text;
    value = combine(value, this->term(), operation);
  }
  return value;
}

PovNumber PovEvaluator::term()
{
  PovNumber value = this->factor();
  while (this->Stream.peek().is('*') || this->Stream.peek().is('/'))
  {
    const PovToken operation = this->Stream.take();
    const PovNumber right = this->factor();
    const bool never = operation.is('/') && !right.unknown && right.size == 1 && right.v[0] == 0;
    value = never ? unknown(operation.place, "division by zero") : combine(value, right, operation.text);
  }
  return value;
}

PovNumber PovEvaluator::factor()
{
  std::string signs;
  while (this->Stream.peek().is('-') || this->Stream.peek().is('+') || this->Stream.peek().is('!'))
  {
    signs += this->Stream.take().text[0];
  }
  PovNumber value = this->member(this->primary());
  for (auto sign = signs.rbegin(); sign != signs.rend(); ++sign)
  {
    std::for_each_n(
      value.v.begin(), value.size, [sign](double& v) { v = *sign == '-'   ? -v
                                                           : *sign == '!' ? double(v == 0)
                                                                          : v; });
  }
  return value;
}

PovNumber PovEvaluator::member(PovNumber value)
{
  while (this->Stream.accept('.'))
  {
    const PovToken name = this->Stream.take();
    const auto found = members.find(name.text);
    if (name.kind != PovToken::Kind::Word || found == members.end())
    {
      this->Stream.failAt(name, "cannot understand the component of a vector", "x, y, z, red, ...");
    }
    if (!value.unknown)
    {
      const double component = promoted(value, 5)[found->second];
      value = {};
      value.v[0] = component;
    }
  }
  return value;
}

PovNumber PovEvaluator::primary()
{
  const PovToken& token = this->Stream.peek();
  PovNumber value;
  if (token.kind == PovToken::Kind::Number)
  {
    value.v[0] = this->Stream.take().number;
  }
  else if (token.is('<'))
  {
    value = this->vectorLiteral();
  }
  else if (this->Stream.accept('('))
  {
    value = this->logical();
    this->Stream.expect(')', "an expression");
  }
  else if (token.kind == PovToken::Kind::Word)
  {
    value = this->word();
  }
  else
  {
    this->Stream.failAt(token, "cannot understand a value", "a number or vector");
  }
  return value;
}

PovNumber PovEvaluator::vectorLiteral()
{
  const PovStream::Level level(this->Stream);
  const PovPlace place = this->Stream.take().place;
  PovNumber value;
  value.size = 0;
  while (!this->Stream.accept('>'))
  {
    if (value.size == 5)
    {
      this->Stream.failAt(this->Stream.peek(), "vector is too long", "at most five components");
    }
    const PovNumber component = this->expression();
    value.unknown = component.unknown ? component.unknown : value.unknown;
    value.v[static_cast<std::size_t>(value.size++)] = component.v[0];
    this->Stream.accept(',');
  }
  if (value.size < 2)
  {
    this->Stream.fail(place, "vector is too short", "two to five components", std::to_string(value.size));
  }
  return value;
}

/// The value of one component; `color` is not known if it is not.
void PovEvaluator::component(const PovToken& word, PovNumber& color)
{
  const PovNumber component = this->factor();
  color.unknown = component.unknown ? component.unknown : color.unknown;
  color.v[members.at(word.text)] = component.v[0];
}

/// A colour and what is said of its components behind it: `red 1 green 0.5 blue 0`, `rgb 1 transmit 0.5`.
PovNumber PovEvaluator::withComponents(PovNumber color)
{
  color.size = 5;
  color.isColor = true;
  while (isColorMember(this->Stream.peek()))
  {
    this->component(this->Stream.take(), color);
  }
  return color;
}

PovNumber PovEvaluator::colorWord(const PovToken& word)
{
  const int components = colorWords.at(word.text);
  PovNumber color = this->expression();
  if (color.unknown || color.isColor)
  {
    return color;
  }
  const int count = components == 0 ? std::max(color.size, 3) : std::abs(components);
  color.v = promoted(color, count);
  std::fill(color.v.begin() + count, color.v.end(), 0.0);
  if (components < 0)
  {
    std::swap(color.v[3], color.v[4]);
  }
  return this->withComponents(color);
}

bool PovEvaluator::beginsColor(const PovToken& token) const
{
  const PovValue* named = this->Symbols.find(token, PovValue::Kind::Number);
  const bool isWord = token.kind == PovToken::Kind::Word && colorWords.count(token.text) > 0;
  return isWord || (isColorMember(token) && members.at(token.text) < 3) || (named && named->number.isKnownColor());
}

PovNumber PovEvaluator::undeclared(const PovToken& word)
{
  static const std::set<std::string> computed = { "array", "function", "spline" };
  const std::string name = quoted(word.text);
  return unknown(word.place, word.isOneOf(computed)        ? word.text + " is not evaluated"
                             : this->Symbols.find(word)    ? name + " is not a number"
                             : this->Stream.peek().is('(') ? "function or macro " + name + " is not evaluated"
                                                           : "undeclared name " + name);
}

PovNumber PovEvaluator::call(const PovToken& name, const PovFunction& function)
{
  std::vector<PovNumber> arguments;
  PovNumber value;
  for (bool isOpen = !this->Stream.accept(')'); isOpen; isOpen = !this->Stream.accept(')'))
  {
    if (!arguments.empty())
    {
      this->Stream.expect(',', "a function");
    }
    arguments.push_back(this->logical());
    value.unknown = value.unknown ? value.unknown : arguments.back().unknown;
  }
  if (arguments.size() < function.fewest || arguments.size() > function.most)
  {
    this->Stream.fail(name.place, "function " + quoted(name.text) + " has a wrong number of arguments",
      std::to_string(function.fewest), std::to_string(arguments.size()));
  }
  if (value.unknown)
  {
    return value;
  }
  value = function.value(arguments);
  const bool isGood =
    std::all_of(value.v.begin(), value.v.begin() + value.size, [](double v) { return std::isfinite(v); });
  return isGood ? value : unknown(name.place, "function " + quoted(name.text) + " has no value here");
}

PovNumber PovEvaluator::word()
{
  const PovStream::Level level(this->Stream);
  const PovToken word = this->Stream.take();
  PovNumber value;
  if (const PovValue* named = this->Symbols.find(word, PovValue::Kind::Number))
  {
    value = named->number.isKnownColor() ? this->withComponents(named->number) : named->number;
  }
  else if (colorWords.count(word.text) > 0)
  {
    return this->colorWord(word);
  }
  else if (isColorMember(word))
  {
    this->component(word, value);
    return this->withComponents(value);
  }
  else if (const PovFunction* function = povFunction(word.text); function && this->Stream.accept('('))
  {
    return this->call(word, *function);
  }
  else if (constants.count(word.text) > 0)
  {
    value.v[0] = constants.at(word.text);
  }
  else if (members.count(word.text) > 0)
  {
    // u and v are x and y of a vector of two, t the fourth of four
    value.size = word.text == "u" || word.text == "v" ? 2 : word.text == "t" ? 4 : 3;
    value.v[members.at(word.text)] = 1;
  }
  else
  {
    value = this->undeclared(word);
  }
  while (value.unknown && this->Stream.skipGroup())
  {
  }
  return value;
}

PovNumber PovEvaluator::comparison()
{
  PovNumber value = this->expression();
  const auto follows = [this](char symbol) { return this->Stream.peek().is(symbol); };
  while (follows('<') || follows('>') || follows('=') || follows('!'))
  {
    std::string operation = this->Stream.take().text;
    const bool orEqual = operation != "=" && this->Stream.accept('=');
    operation = operation == "!" || orEqual ? operation + "=" : operation;
    value = combine(value, this->expression(), operation);
  }
  return value;
}

PovNumber PovEvaluator::logical()
{
  const PovStream::Level level(this->Stream);
  PovNumber value = this->comparison();
  while (this->Stream.peek().is('&') || this->Stream.peek().is('|') || this->Stream.peek().is('?'))
  {
    const std::string operation = this->Stream.take().text;
    if (operation != "?")
    {
      value = combine(value, this->comparison(), operation);
      continue;
    }
    const PovNumber then = this->logical();
    this->Stream.expect(':', "a choice");
    const PovNumber otherwise = this->logical();
    value = value.unknown ? value : value.v[0] != 0 ? then : otherwise;
  }
  return value;
}

bool PovEvaluator::optional(PovNumber& to)
{
  const PovToken& token = this->Stream.peek();
  const bool begins = token.kind == PovToken::Kind::Number || token.is('<') || token.is('(') || token.is('-') ||
                      token.is('+') || this->beginsColor(token) || this->Symbols.find(token);
  if (begins)
  {
    to = this->expression();
  }
  return begins && !to.unknown;
}

Eigen::Vector3d PovEvaluator::known(const PovNumber& number, const PovPlace& place) const
{
  if (number.unknown)
  {
    this->Stream.fail(number.unknown->place,
      number.unknown->what + ", and a mesh depends on it (line " + std::to_string(place.line) + ')');
  }
  const std::array<double, 5> v = promoted(number, 3);
  return { v[0], v[1], v[2] };
}

double PovEvaluator::scalar()
{
  const PovPlace place = this->Stream.peek().place;
  return this->known(this->expression(), place)[0];
}

Eigen::Vector3d PovEvaluator::vector(const char* where)
{
  const PovToken& first = this->Stream.peek();
  if (first.kind == PovToken::Kind::End || first.is('}'))
  {
    this->Stream.failAt(first, std::string("ends inside ") + where, "a vector");
  }
  const PovPlace place = first.place;
  return this->known(this->expression(), place);
}

/// Rows of a matrix that multiplies row vectors from the right.
Eigen::Affine3d PovEvaluator::matrix()
{
  Eigen::Affine3d matrix = Eigen::Affine3d::Identity();
  this->Stream.expect('<', "a matrix");
  for (int i = 0; i < 12; ++i)
  {
    matrix(i % 3, i / 3) = this->scalar();
    this->Stream.accept(',');
  }
  this->Stream.expect('>', "a matrix");
  return matrix;
}

Eigen::Affine3d PovEvaluator::namedTransform()
{
  const PovToken name = this->Stream.take();
  const PovValue* named = this->Symbols.find(name, PovValue::Kind::Transform);
  if (!named)
  {
    this->Stream.failAt(name, "transform needs evaluation", "a declared transform");
  }
  return named->transform;
}

bool PovEvaluator::transform(Eigen::Affine3d& total)
{
  static const std::set<std::string> words = { "translate", "rotate", "scale", "matrix", "transform" };
  if (!this->Stream.peek().isOneOf(words))
  {
    return false;
  }
  const PovToken word = this->Stream.take();
  Eigen::Affine3d next = Eigen::Affine3d::Identity();
  if (word.is("transform"))
  {
    next = this->transformBlock();
  }
  else if (word.is("matrix"))
  {
    next = this->matrix();
  }
  else
  {
    const Eigen::Vector3d v = this->vector(word.text.c_str());
    if (word.is("translate"))
    {
      next.translation() = v;
    }
    else if (word.is("scale"))
    {
      next.linear().diagonal() = (v.array() == 0).select(1, v); // as POV-Ray does
    }
    else
    {
      next.linear() = povRotation(v);
    }
  }
  total = next * total;
  return true;
}

Eigen::Affine3d PovEvaluator::transformBlock()
{
  const PovStream::Level level(this->Stream);
  if (!this->Stream.accept('{'))
  {
    return this->namedTransform();
  }
  Eigen::Affine3d total = Eigen::Affine3d::Identity();
  bool inverse = false;
  while (!this->Stream.accept('}'))
  {
    if (this->Stream.accept("inverse"))
    {
      inverse = true;
    }
    else if (!this->transform(total))
    {
      total = this->namedTransform() * total;
    }
  }
  return inverse && total.linear().determinant() != 0 ? total.inverse() : total;
}

} // namespace dgtk
