// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkColladaText_h
#define dgtkColladaText_h

#include <string>

namespace dgtk::import
{

/// The XML without white space at the beginning and the end of what elements hold. XML Schema has it collapsed in all
/// lists of numbers, names and addresses of Collada; the importer refuses colours that begin with it, and takes it for
/// a part of names.
std::string trimmed(std::string xml);

} // namespace dgtk::import

#endif
