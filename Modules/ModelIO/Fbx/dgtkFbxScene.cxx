// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFbxScene.h"

#include <algorithm>

namespace dgtk::import
{

namespace
{
const FbxElement none;

const FbxElement& orNone(const FbxElement* element) { return element != nullptr ? *element : none; }

/// "Cube" of "Model::Cube" (text) or of "Cube\0\1Model" (binary).
std::string plainName(const std::string& name)
{
  const std::size_t binary = name.find(std::string_view("\0\1", 2));
  if (binary != std::string::npos)
  {
    return name.substr(0, binary);
  }
  const std::size_t text = name.find("::");
  return text == std::string::npos ? name : name.substr(text + 2);
}

/// Units of time of a second: those of version 7, or of 8, of which a file of either may say that it has them.
double ticksOf(const FbxElement& document)
{
  const FbxElement& header = orNone(document.find("FBXHeaderExtension"));
  const bool isNew = orNone(header.find("FBXVersion")).integer(0, 0) >= 8000;
  const FbxElement* definition = orNone(header.find("OtherFlags")).find("TCDefinition");
  const bool counts = definition != nullptr && orNone(header.find("FBXHeaderVersion")).integer(0, 0) >= 1004;
  constexpr std::int64_t ofVersion7 = 127;
  const bool isOld = counts ? definition->integer(0, ofVersion7) == ofVersion7 : !isNew;
  return isOld ? 46186158000. : 141120000.;
}

const FbxElement* propertyOf(const FbxElement* element, std::string_view wanted)
{
  const FbxElement* list = element != nullptr ? element->find("Properties70") : nullptr;
  if (list == nullptr)
  {
    return nullptr;
  }
  // of two of one name the later counts
  const auto found = std::find_if(
    list->children.rbegin(), list->children.rend(), [wanted](const FbxElement& p) { return p.text(0) == wanted; });
  return found == list->children.rend() ? nullptr : &*found;
}
} // namespace

bool FbxObject::says(std::string_view wanted) const { return propertyOf(this->element, wanted) != nullptr; }

const FbxElement* FbxObject::property(std::string_view wanted) const
{
  const FbxElement* own = propertyOf(this->element, wanted);
  return own != nullptr ? own : propertyOf(this->defaults, wanted);
}

double FbxObject::number(std::string_view wanted, double otherwise) const
{
  return orNone(this->property(wanted)).number(4, otherwise);
}

std::int64_t FbxObject::integer(std::string_view wanted, std::int64_t otherwise) const
{
  return orNone(this->property(wanted)).integer(4, otherwise);
}

std::string FbxObject::text(std::string_view wanted) const { return orNone(this->property(wanted)).text(4); }

std::array<double, 3> FbxObject::vector(std::string_view wanted, const std::array<double, 3>& otherwise) const
{
  const FbxElement& found = orNone(this->property(wanted));
  return { found.number(4, otherwise[0]), found.number(5, otherwise[1]), found.number(6, otherwise[2]) };
}

FbxScene::FbxScene(const FbxElement& document)
  : Objects(1)
  , Ticks(ticksOf(document))
{
  std::map<std::string, const FbxElement*> defaults;
  for (const FbxElement& type : orNone(document.find("Definitions")).children)
  {
    if (type.name == "ObjectType")
    {
      defaults[type.text(0)] = type.find("PropertyTemplate");
    }
  }
  std::map<std::int64_t, std::size_t> byId{ { 0, 0 } };
  for (const FbxElement& element : orNone(document.find("Objects")).children)
  {
    FbxObject object;
    object.element = &element;
    const auto known = defaults.find(element.name);
    object.defaults = known == defaults.end() ? nullptr : known->second;
    object.name = plainName(element.text(1));
    object.kind = element.text(2);
    byId.emplace(element.integer(0, 0), this->Objects.size()); // of two of one number the first counts
    this->Objects.push_back(std::move(object));
  }
  for (const FbxElement& take : orNone(document.find("Takes")).children)
  {
    const std::vector<double> times = take.numbers("LocalTime");
    if (times.size() == 2)
    {
      this->Takes[take.text(0)] = { times[0], times[1] };
    }
  }
  for (const FbxElement& connection : orNone(document.find("Connections")).children)
  {
    const auto child = byId.find(connection.integer(1, -1));
    const auto parent = byId.find(connection.integer(2, -1));
    if (child != byId.end() && parent != byId.end() && child->second != 0)
    {
      this->Objects[parent->second].children.push_back({ child->second, connection.text(3) });
      this->Objects[child->second].parents.push_back({ parent->second, connection.text(3) });
    }
  }
}

std::vector<std::size_t> FbxScene::childrenOf(std::size_t object, std::string_view type) const
{
  std::vector<std::size_t> found;
  for (const FbxObject::Link& link : this->Objects[object].children)
  {
    if (this->Objects[link.object].is(type))
    {
      found.push_back(link.object);
    }
  }
  return found;
}

} // namespace dgtk::import
