// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkColladaText_h
#define dgtkColladaText_h

#include <string>

namespace dgtk::import
{

/// The XML without white space around the texts between its tags, and without the unit of length.
/// XML Schema has that space collapsed in all lists of numbers, names and addresses of Collada; the importer refuses
/// colours that begin with it, and takes it for a part of names. By the unit it would scale, in single precision.
std::string colladaText(const std::string& xml);

} // namespace dgtk::import

#endif
