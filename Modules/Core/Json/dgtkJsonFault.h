// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkJsonFault_h
#define dgtkJsonFault_h

#include "dgtkCoreModule.h"
#include "dgtkError.h"

#include <string>

namespace dgtk
{

/// The refusal of a file for what nlohmann's exception says of it, in words of ours; without a line, that of the
/// message, if it has one.
DGTKCORE_EXPORT InputError jsonFault(const std::string& file, long line, const std::string& message);

} // namespace dgtk

#endif
