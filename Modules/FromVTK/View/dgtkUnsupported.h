// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkUnsupported_h
#define dgtkUnsupported_h

#include "dgtkError.h"
#include "dgtkText.h"

#include <algorithm>
#include <string>
#include <vector>

namespace dgtk
{

/// What of a VTK scene is no surface, or cannot be honoured: all of it is told at once.
class Unsupported
{
public:
  void add(const std::string& what)
  {
    if (std::find(this->Lines.begin(), this->Lines.end(), what) == this->Lines.end())
    {
      this->Lines.push_back(what);
    }
  }
  const std::vector<std::string>& lines() const { return this->Lines; }

  /// Throws InputError when there is something.
  void refuse() const
  {
    if (!this->Lines.empty())
    {
      throw InputError("VTK scene", "has what is no surface, or cannot be honoured: " + joined(this->Lines));
    }
  }

private:
  std::vector<std::string> Lines;
};

} // namespace dgtk

#endif
