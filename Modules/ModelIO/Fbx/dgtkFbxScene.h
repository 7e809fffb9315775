// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFbxScene_h
#define dgtkFbxScene_h

#include "dgtkFbxDocument.h"

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace dgtk::import
{

/// An object of the file, and what is connected to it. Index 0 is the scene itself, which holds the topmost models.
struct FbxObject
{
  const FbxElement* element = nullptr;  ///< null for the scene
  const FbxElement* defaults = nullptr; ///< what properties of its class have when the object does not say; may be null
  std::string name;
  std::string kind; ///< "Mesh", "Skin", "BlendShapeChannel", ...: the class within its element's
  struct Link
  {
    std::size_t object;
    std::string property; ///< of the other end that it drives, or ""
  };
  std::vector<Link> children; ///< what is connected to it, in the file's order
  std::vector<Link> parents;

  bool is(std::string_view type) const { return this->element != nullptr && this->element->name == type; }
  bool is(std::string_view type, std::string_view itsKind) const { return this->is(type) && this->kind == itsKind; }

  /// Whether the object itself, and not only its class, has a property.
  bool says(std::string_view wanted) const;
  /// The element of a property, its values from index 4 on; null where neither the object nor its class has it.
  const FbxElement* property(std::string_view wanted) const;
  double number(std::string_view wanted, double otherwise) const;
  std::int64_t integer(std::string_view wanted, std::int64_t otherwise) const;
  std::string text(std::string_view wanted) const;
  std::array<double, 3> vector(std::string_view wanted, const std::array<double, 3>& otherwise) const;
};

/// The objects of a file of version 7 and how they are connected. The document lives as long as this.
class FbxScene
{
public:
  explicit FbxScene(const FbxElement& document);

  const std::vector<FbxObject>& objects() const { return this->Objects; }
  const FbxObject& object(std::size_t index) const { return this->Objects[index]; }
  /// Those connected to an object that are of a type, in the file's order.
  std::vector<std::size_t> childrenOf(std::size_t object, std::string_view type) const;
  /// Units of the file's times in a second.
  double ticks() const { return this->Ticks; }
  /// First and last time of the take of an animation stack's name; null where the file has none.
  const std::array<double, 2>* take(const std::string& name) const
  {
    const auto found = this->Takes.find(name);
    return found == this->Takes.end() ? nullptr : &found->second;
  }

private:
  std::vector<FbxObject> Objects;
  double Ticks;
  std::map<std::string, std::array<double, 2>> Takes;
};

} // namespace dgtk::import

#endif
