// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSampleVerification_h
#define dgtkSampleVerification_h

#include "dgtkVerification.h"

#include <string>

namespace dgtk
{

/// Whether a folder is one of samples: it has a samples.json.
DGTKVERIFICATION_EXPORT bool isSampleFolder(const std::string& folder);

/// Measures what was placed in the samples of a folder anew, on the true meshes, with none of the code that placed it:
/// whether each object lies as deep in others and as high above what holds it as its tolerance lets it. Values are
/// parts of the tolerance. Also whether samples.json agrees with itself and its files. Throws InputError when `folder`
/// has no readable samples.json.
DGTKVERIFICATION_EXPORT VerificationReport verifySamples(const std::string& folder);

} // namespace dgtk

#endif
