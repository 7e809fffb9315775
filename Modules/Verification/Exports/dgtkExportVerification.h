// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkExportVerification_h
#define dgtkExportVerification_h

#include "dgtkVerification.h"

namespace dgtk
{

/// Reads an export back, by readers that share no code with what wrote it, and compares it with its dataset: every
/// file's hash, every pixel within the rounding that export.json states, cameras, boxes, masks and poses as the
/// format's documents say them. The report does not depend on `threads` (>= 1). Throws InputError when one of the
/// folders does not hold what it should, UsageError when the export was made from another dataset.
DGTKVERIFICATION_EXPORT VerificationReport verifyExport(
  const std::string& dataset, const std::string& folder, int threads);

} // namespace dgtk

#endif
