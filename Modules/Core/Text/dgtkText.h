// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkText_h
#define dgtkText_h

#include "dgtkCoreModule.h"

#include <string>
#include <vector>

// Small texts, the same whatever the locale.

namespace dgtk
{

/// A to Z in lower case; all else as it is.
DGTKCORE_EXPORT std::string lower(std::string text);

/// Extension of a file's name in lower case, without dot.
DGTKCORE_EXPORT std::string extensionOf(const std::string& path);

DGTKCORE_EXPORT std::string joined(const std::vector<std::string>& words, const char* separator = ", ");

/// Shortest text that reads back to the same double; "inf", "-inf" and "nan" for what is not a number.
DGTKCORE_EXPORT std::string shortest(double value);

/// The same without an exponent from 1e-6 to 1e15.
DGTKCORE_EXPORT std::string plainNumber(double value);

/// The candidate with the smallest edit distance, the first of these, whatever the case of letters; "" when none is
/// near: more than two letters, and more than half of them, must be changed.
DGTKCORE_EXPORT std::string nearest(const std::string& word, const std::vector<std::string>& candidates);

} // namespace dgtk

#endif
