// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovSymbols.h"

#include <algorithm>

namespace dgtk
{

std::string PovValue::whyNot(const std::string& otherwise) const
{
  const std::string why = this->number.unknown        ? this->number.unknown->what
                          : this->kind == Kind::Other ? this->text
                                                      : "";
  return why.empty() ? otherwise : why;
}

const PovValue* PovSymbols::find(const PovToken& token, std::optional<PovValue::Kind> kind) const
{
  const auto found = token.kind == PovToken::Kind::Word ? this->Values.find(token.text) : this->Values.end();
  return found != this->Values.end() && (!kind || found->second.kind == *kind) ? &found->second : nullptr;
}

const PovSymbols::Macro* PovSymbols::macro(const PovToken& token) const
{
  const auto found = token.kind == PovToken::Kind::Word ? this->Macros.find(token.text) : this->Macros.end();
  return found != this->Macros.end() ? &found->second : nullptr;
}

void PovSymbols::declare(const std::string& name, PovValue value)
{
  value.used = false;
  value.order = ++this->Declarations;
  if (value.texture && value.texture->name.empty())
  {
    value.texture = std::make_shared<PovTexture>(PovTexture{ value.texture->pigment, value.texture->finish, name });
  }
  this->Values[name] = std::move(value);
}

void PovSymbols::poison(const std::vector<std::string>& names, const PovPlace& place, const std::string& what)
{
  PovValue value;
  value.number.unknown = std::make_shared<PovProblem>(PovProblem{ place, what });
  for (const std::string& name : names)
  {
    this->Values[name] = value;
  }
}

void PovSymbols::declareColors()
{
  std::map<std::string, std::array<double, 3>> colors = { { "Red", { 1, 0, 0 } }, { "Green", { 0, 1, 0 } },
    { "Blue", { 0, 0, 1 } }, { "Yellow", { 1, 1, 0 } }, { "Cyan", { 0, 1, 1 } }, { "Magenta", { 1, 0, 1 } },
    { "White", { 1, 1, 1 } }, { "Black", { 0, 0, 0 } } };
  for (int percent = 5; percent <= 95; percent += 5)
  {
    const std::string digits = (percent < 10 ? "0" : "") + std::to_string(percent);
    const double grey = percent / 100.0;
    colors["Gray" + digits] = colors["Grey" + digits] = { grey, grey, grey };
  }
  for (const auto& [name, rgb] : colors)
  {
    PovValue value;
    value.number = { { rgb[0], rgb[1], rgb[2] }, 5, true, nullptr };
    this->Values.emplace(name, value);
  }
}

bool PovSymbols::isMesh(const PovToken& token) const
{
  static const std::set<std::string> words = { "mesh", "mesh2", "triangle", "smooth_triangle" };
  const PovValue* shape = this->find(token, PovValue::Kind::Shape);
  const Macro* called = this->macro(token);
  return token.isOneOf(words) || (shape && !shape->shape.empty()) || (called && !called->mesh.empty());
}

PovShape PovSymbols::unused() const
{
  std::vector<const PovValue*> declared;
  for (const auto& [name, value] : this->Values)
  {
    if (value.kind == PovValue::Kind::Shape && !value.used)
    {
      declared.push_back(&value);
    }
  }
  std::sort(declared.begin(), declared.end(), [](const PovValue* a, const PovValue* b) { return a->order < b->order; });
  PovShape shape;
  for (const PovValue* value : declared)
  {
    shape.insert(shape.end(), value->shape.begin(), value->shape.end());
  }
  return shape;
}

} // namespace dgtk
