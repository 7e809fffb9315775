// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkOffText_h
#define dgtkOffText_h

#include <string>

namespace dgtk::import
{

/// Whether faces of an OFF file have colours, which Assimp does not read.
bool facesHaveColors(const std::string& text);

} // namespace dgtk::import

#endif
