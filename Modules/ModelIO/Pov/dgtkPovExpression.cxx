// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovParser.h"

#include "dgtkError.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr std::size_t mostReasons = 1000;
constexpr double pi = 3.14159265358979323846;

/// Names that POV-Ray itself gives a value; those of the command line have its defaults.
const std::map<std::string, double> constants = { { "pi", pi }, { "tau", 2 * pi }, { "true", 1 }, { "false", 0 },
  { "yes", 1 }, { "no", 0 }, { "on", 1 }, { "off", 0 }, { "clock", 0 }, { "clock_delta", 1 }, { "clock_on", 0 },
  { "frame_number", 1 }, { "initial_frame", 1 }, { "final_frame", 1 }, { "initial_clock", 0 }, { "final_clock", 0 },
  { "image_width", 160 }, { "image_height", 120 }, { "version", 3.7 }, { "unix", 1 } };
const std::map<std::string, std::size_t> members = { { "x", 0 }, { "y", 1 }, { "z", 2 }, { "t", 3 }, { "u", 0 },
  { "v", 1 }, { "red", 0 }, { "green", 1 }, { "blue", 2 }, { "filter", 3 }, { "transmit", 4 } };
/// Components that each colour word's vector has, in order: r, g, b, then filter or transmit.
const std::map<std::string, int> colorWords = { { "color", 0 }, { "colour", 0 }, { "rgb", 3 }, { "srgb", 3 },
  { "rgbf", 4 }, { "srgbf", 4 }, { "rgbt", -4 }, { "srgbt", -4 }, { "rgbft", 5 }, { "srgbft", 5 }, { "red", 0 },
  { "green", 0 }, { "blue", 0 }, { "filter", 0 }, { "transmit", 0 } };

/// A number used as a vector has it in all components.
std::array<double, 5> promoted(const std::array<double, 5>& v, int size, int to)
{
  std::array<double, 5> result = v;
  for (int i = size; size == 1 && i < to; ++i)
  {
    result[static_cast<std::size_t>(i)] = v[0];
  }
  return result;
}
} // namespace

PovParser::Number PovParser::unknown(const PovPlace& place, const std::string& what)
{
  Number number;
  number.unknown = static_cast<int>(this->Reasons.size());
  if (this->Reasons.size() < mostReasons)
  {
    this->Reasons.emplace_back(place, what);
  }
  else
  {
    // only the last is ever told of that many
    number.unknown = static_cast<int>(mostReasons) - 1;
    this->Reasons.back() = { place, what };
  }
  return number;
}

PovParser::Number PovParser::combine(const Number& a, const Number& b, char operation)
{
  if (a.unknown >= 0 || b.unknown >= 0)
  {
    return a.unknown >= 0 ? a : b;
  }
  Number result;
  result.size = std::max(a.size, b.size);
  result.isColor = a.isColor || b.isColor;
  const std::array<double, 5> left = promoted(a.v, a.size, result.size);
  const std::array<double, 5> right = promoted(b.v, b.size, result.size);
  for (std::size_t i = 0; i < static_cast<std::size_t>(result.size); ++i)
  {
    const double x = left[i];
    const double y = right[i];
    switch (operation)
    {
      case '+':
        result.v[i] = x + y;
        break;
      case '-':
        result.v[i] = x - y;
        break;
      case '*':
        result.v[i] = x * y;
        break;
      case '/':
        result.v[i] = x / y;
        break;
      case '<':
        result.v[i] = x < y;
        break;
      case '>':
        result.v[i] = x > y;
        break;
      case '=':
        result.v[i] = x == y;
        break;
      case '&':
        result.v[i] = x != 0 && y != 0;
        break;
      default:
        result.v[i] = x != 0 || y != 0;
        break;
    }
  }
  return result;
}

PovParser::Number PovParser::expression()
{
  const Guard guard(*this);
  Number value = this->term();
  while (this->peek().is('+') || this->peek().is('-'))
  {
    const char operation = this->take().text[0];
    value = this->combine(value, this->term(), operation);
  }
  return value;
}

PovParser::Number PovParser::term()
{
  Number value = this->factor();
  while (this->peek().is('*') || this->peek().is('/'))
  {
    const PovToken operation = this->take();
    const Number right = this->factor();
    if (operation.is('/') && right.unknown < 0 && right.size == 1 && right.v[0] == 0)
    {
      value = this->unknown(operation.place, "division by zero");
      continue;
    }
    value = this->combine(value, right, operation.text[0]);
  }
  return value;
}

PovParser::Number PovParser::factor()
{
  std::string signs;
  while (this->peek().is('-') || this->peek().is('+') || this->peek().is('!'))
  {
    signs += this->take().text[0];
  }
  Number value = this->member(this->primary());
  for (auto sign = signs.rbegin(); sign != signs.rend(); ++sign)
  {
    for (std::size_t i = 0; i < static_cast<std::size_t>(value.size); ++i)
    {
      double& v = value.v[i];
      v = *sign == '-' ? -v : *sign == '!' ? double(v == 0) : v;
    }
  }
  return value;
}

PovParser::Number PovParser::member(Number value)
{
  while (this->peek().is('.'))
  {
    this->take();
    const PovToken name = this->take();
    const auto found = members.find(name.text);
    if (name.kind != PovToken::Kind::Word || found == members.end())
    {
      this->failAt(name, "cannot understand the component of a vector", "x, y, z, red, ...");
    }
    if (value.unknown < 0)
    {
      const double component = promoted(value.v, value.size, 5)[found->second];
      value = {};
      value.v[0] = component;
    }
  }
  return value;
}

PovParser::Number PovParser::primary()
{
  const PovToken& token = this->peek();
  if (token.kind == PovToken::Kind::Number)
  {
    Number value;
    value.v[0] = this->take().number;
    return value;
  }
  if (token.is('<'))
  {
    return this->vectorLiteral();
  }
  if (token.is('('))
  {
    this->take();
    const Number value = this->logical();
    this->expect(')', "an expression");
    return value;
  }
  if (token.kind == PovToken::Kind::Word)
  {
    return this->word();
  }
  this->failAt(token, "cannot understand a value", "a number or vector");
}

PovParser::Number PovParser::vectorLiteral()
{
  const Guard guard(*this);
  const PovPlace place = this->take().place;
  Number value;
  value.size = 0;
  int missing = -1;
  while (!this->accept('>'))
  {
    if (value.size == 5)
    {
      this->failAt(this->peek(), "vector is too long", "at most five components");
    }
    const Number component = this->expression();
    missing = component.unknown >= 0 ? component.unknown : missing;
    value.v[static_cast<std::size_t>(value.size++)] = component.v[0];
    this->accept(',');
  }
  if (value.size < 2)
  {
    this->fail(place, "vector is too short", "two to five components", std::to_string(value.size));
  }
  value.unknown = missing;
  return value;
}

/// The value of one component; `color` becomes unknown with it.
double PovParser::component(Number& color)
{
  const Number component = this->factor();
  color.unknown = component.unknown >= 0 ? component.unknown : color.unknown;
  return component.v[0];
}

/// A colour and what is said of its components behind it: `red 1 green 0.5 blue 0`, `rgb 1 transmit 0.5`.
PovParser::Number PovParser::withComponents(Number color)
{
  for (PovToken next = this->peek();
       next.kind == PovToken::Kind::Word && next.text.size() >= 3 && members.count(next.text) > 0; next = this->peek())
  {
    this->take();
    color.v[members.at(next.text)] = this->component(color);
  }
  return color;
}

PovParser::Number PovParser::colorWord(const PovToken& word)
{
  Number color;
  if (members.count(word.text) > 0)
  {
    color.v[members.at(word.text)] = this->component(color);
    color.size = 5;
    color.isColor = true;
    return this->withComponents(color);
  }
  const int components = colorWords.at(word.text);
  color = this->expression();
  if (color.unknown >= 0 || color.isColor)
  {
    return color;
  }
  const int count = components == 0 ? std::max(color.size, 3) : std::abs(components);
  color.v = promoted(color.v, color.size, count);
  std::fill(color.v.begin() + count, color.v.end(), 0.0);
  if (components == -4)
  {
    std::swap(color.v[3], color.v[4]);
  }
  color.size = 5;
  color.isColor = true;
  return this->withComponents(color);
}

PovParser::Number PovParser::word()
{
  const Guard guard(*this);
  const PovToken word = this->take();
  Number value;
  const auto name = this->Names.find(word.text);
  if (name != this->Names.end() && (name->second.isNumeric() || name->second.kind == PovValue::Kind::Unknown))
  {
    if (name->second.kind == PovValue::Kind::Unknown)
    {
      value = this->unknown(name->second.place, name->second.text);
    }
    else
    {
      value.v = name->second.number;
      value.size = name->second.size;
      value.isColor = name->second.kind == PovValue::Kind::Color;
      value = value.isColor ? this->withComponents(value) : value;
    }
  }
  else if (colorWords.count(word.text) > 0)
  {
    return this->colorWord(word);
  }
  else if (constants.count(word.text) > 0)
  {
    value.v[0] = constants.at(word.text);
  }
  else if (word.text.size() == 1 && members.count(word.text) > 0)
  {
    // u and v are x and y of a vector of two, t the fourth of four
    value.size = word.text == "u" || word.text == "v" ? 2 : word.text == "t" ? 4 : 3;
    value.v[members.at(word.text)] = 1;
  }
  else
  {
    const bool call = this->peek().is('(');
    value = this->unknown(word.place, name != this->Names.end() ? quoted(word.text) + " is not a number"
                                      : call ? "function or macro " + quoted(word.text) + " is not evaluated"
                                             : "undeclared name " + quoted(word.text));
    if (this->peek().is('{'))
    {
      this->skipBalanced('{', '}');
    }
  }
  while (value.unknown >= 0 && (this->peek().is('(') || this->peek().is('[')))
  {
    this->skipBalanced(this->peek().text[0], this->peek().is('(') ? ')' : ']');
    this->skipOptionalBlock();
  }
  return value;
}

PovParser::Number PovParser::comparison()
{
  Number value = this->expression();
  while (this->peek().is('<') || this->peek().is('>') || this->peek().is('=') || this->peek().is('!'))
  {
    const char first = this->take().text[0];
    const bool orEqual = first != '=' && this->accept('=');
    const Number right = this->expression();
    Number result = this->combine(value, right, first == '!' ? '=' : first);
    if (result.unknown < 0 && first == '!')
    {
      result.v[0] = result.v[0] == 0;
    }
    else if (result.unknown < 0 && orEqual)
    {
      result.v[0] = result.v[0] != 0 || this->combine(value, right, '=').v[0] != 0;
    }
    value = result;
  }
  return value;
}

PovParser::Number PovParser::logical()
{
  const Guard guard(*this);
  Number value = this->comparison();
  while (this->peek().is('&') || this->peek().is('|') || this->peek().is('?'))
  {
    const PovToken operation = this->take();
    const Number right = operation.is('?') ? this->logical() : this->comparison();
    if (!operation.is('?'))
    {
      value = this->combine(value, right, operation.text[0]);
      continue;
    }
    this->expect(':', "a choice");
    const Number otherwise = this->logical();
    value = value.unknown >= 0 ? value : value.v[0] != 0 ? right : otherwise;
  }
  return value;
}

Eigen::Vector3d PovParser::known(const Number& number, const PovPlace& place)
{
  if (number.unknown >= 0)
  {
    const auto& [where, what] = this->Reasons[static_cast<std::size_t>(number.unknown)];
    this->fail(where, what + ", and a mesh depends on it (line " + std::to_string(place.line) + ')');
  }
  const std::array<double, 5> v = promoted(number.v, number.size, 3);
  return { v[0], v[1], v[2] };
}

double PovParser::scalar(const Number& number, const PovPlace& place) { return this->known(number, place)[0]; }

Eigen::Vector3d PovParser::vector(const char* where)
{
  const PovToken& first = this->peek();
  if (first.kind == PovToken::Kind::End || first.is('}'))
  {
    this->failAt(first, std::string("ends inside ") + where, "a vector");
  }
  const PovPlace place = first.place;
  return this->known(this->expression(), place);
}

} // namespace dgtk
