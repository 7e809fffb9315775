// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkUniqueNames_h
#define dgtkUniqueNames_h

#include "dgtkDocumentModule.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace dgtk
{

/// Names that must differ. A name takes logarithmic time, however many have its stem.
class DGTKDOCUMENT_EXPORT UniqueNames
{
public:
  void add(const std::string& name) { ++this->Holders[name]; }
  bool holds(const std::string& name) const { return this->Holders.count(name) != 0; }
  /// One of the holders of `name` gets the next free one by its number: Light1 for Light0, tree-2 for tree, oak005 for
  /// oak004. The only holder keeps it. Returns the new name.
  std::string rename(const std::string& name);

private:
  using Numbers = std::map<int, int>;
  static int firstFree(Numbers& after, int number);

  std::map<std::string, std::size_t> Holders;
  std::map<std::string, Numbers> After; ///< of a stem: a number that is taken, and a higher one up to which all are
};

/// `name`, or where it is taken the next free one.
DGTKDOCUMENT_EXPORT std::string uniqueName(const std::vector<std::string>& taken, const std::string& name);

} // namespace dgtk

#endif
