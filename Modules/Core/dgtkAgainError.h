// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkAgainError_h
#define dgtkAgainError_h

#include "dgtkError.h"

namespace dgtk
{

/// Exit status of what may be tried again as it is (EX_TEMPFAIL of sysexits.h), beside those of ExitCode.
constexpr ExitCode againCode = ExitCode(75);

/// Interrupted, or out of a resource that passes: a lock that another process has, a disk that is full. The same
/// request, which goes on where this one stopped, may succeed.
class AgainError : public Error
{
public:
  explicit AgainError(const std::string& message)
    : Error(againCode, message)
  {
  }
};

} // namespace dgtk

#endif
