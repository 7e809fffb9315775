// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSampleRule.h"

namespace dgtk
{

SampleRefused::SampleRefused(const std::string& path, const std::string& why, int attempts)
  : Error(ExitCode::Input, path + ": " + why)
  , Path(path)
  , Why(why)
  , Attempts(attempts)
{
}

SampleStopped::SampleStopped()
  : AgainError("stopped")
{
}

} // namespace dgtk
