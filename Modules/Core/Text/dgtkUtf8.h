// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkUtf8_h
#define dgtkUtf8_h

#include "dgtkCoreModule.h"

#include <string>

// File names are bytes; JSON and people want UTF-8. See "Names that are not UTF-8" in Documentation/Formats/dataset.md.

namespace dgtk
{

/// Whether a text is valid UTF-8.
DGTKCORE_EXPORT bool isUtf8(const std::string& text);

/// UTF-8 that stands for any bytes: a byte B that belongs to no character is U+EF00 + B (U+EF80 to U+EFFF), and so is
/// each byte of a character of that range. All else stays as it is.
DGTKCORE_EXPORT std::string utf8FromBytes(const std::string& bytes);

/// The inverse.
DGTKCORE_EXPORT std::string bytesFromUtf8(const std::string& text);

/// One line for people: control characters, and bytes that belong to no character, as \xE4; all else as it is.
DGTKCORE_EXPORT std::string printable(const std::string& text);

} // namespace dgtk

#endif
