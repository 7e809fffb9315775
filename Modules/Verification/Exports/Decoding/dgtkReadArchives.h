// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkReadArchives_h
#define dgtkReadArchives_h

// Private to Verification: files within files.

#include "dgtkExportPixels.h"

#include <cstdint>
#include <functional>
#include <string>

namespace dgtk
{

/// The files of a tar (POSIX ustar), one after another. Throws InputError with the offset for a damaged one and for
/// what is no plain file. Everything that is not contents must be fixed: time, owner and group 0.
void forTarMembers(
  const std::string& path, const std::function<void(const std::string& name, const std::string& bytes)>& visit);

/// The values of a .npy of rows, or of a PNG, gray or codes of a palette, as they stand there; `path` stands in errors.
DecodedPixels decodeNpyBytes(const std::string& path, const std::string& bytes);
DecodedPixels decodeGrayPngBytes(const std::string& path, const std::string& bytes);

} // namespace dgtk

#endif
