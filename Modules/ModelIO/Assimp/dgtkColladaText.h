// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkColladaText_h
#define dgtkColladaText_h

#include "dgtkAssimpStream.h"

#include <string>
#include <vector>

namespace dgtk::import
{

struct ColladaText
{
  std::string text;
  std::string problem; ///< why the file is refused, or ""
  std::vector<std::string> warnings;
};

/// The weight of pictures that say how much is not there.
constexpr int inverseWeight = -1;

/// The XML as the importer takes it for what it means: without white space around the texts between its tags and
/// without the unit of length, with a name of its own for each node, axes of length 1, the texture coordinates that
/// materials bind as the first ones, and what samplers say in the elements of pictures (the guide's page on models says
/// why).
ColladaText colladaText(const std::string& xml);

/// Gives the nodes the names of the file back.
void restoreNames(Scene& scene);

} // namespace dgtk::import

#endif
