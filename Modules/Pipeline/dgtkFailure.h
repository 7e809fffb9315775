// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFailure_h
#define dgtkFailure_h

// Private to Pipeline.

#include "dgtkError.h"

#include <new>
#include <string>

namespace dgtk
{

/// What went wrong last, for classes that do not throw.
struct Failure
{
  std::string message; ///< one line; empty: nothing
  int code = 0;        ///< as ExitCode

  explicit operator bool() const { return !this->message.empty(); }
  void clear() { *this = {}; }
  /// In a handler: of the exception that is handled.
  void take()
  {
    this->code = static_cast<int>(ExitCode::Machine);
    try
    {
      throw;
    }
    catch (const Error& error)
    {
      this->message = error.what();
      this->code = static_cast<int>(error.code());
    }
    catch (const std::bad_alloc&)
    {
      this->message = "not enough memory";
    }
    catch (const std::exception& error)
    {
      this->message = error.what();
    }
  }
};

} // namespace dgtk

#endif
