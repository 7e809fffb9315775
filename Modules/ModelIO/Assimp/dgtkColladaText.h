// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkColladaText_h
#define dgtkColladaText_h

#include <string>

namespace dgtk::import
{

/// The XML as the importer takes it for what it means: without white space around the texts between its tags, and
/// without the unit of length (the guide's page on models says why).
std::string colladaText(const std::string& xml);

} // namespace dgtk::import

#endif
