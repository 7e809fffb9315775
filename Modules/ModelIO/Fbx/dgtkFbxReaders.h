// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFbxReaders_h
#define dgtkFbxReaders_h

#include "dgtkFbxDocument.h"

#include <stdexcept>

namespace dgtk::import
{

/// Bytes before the first element of a binary file.
constexpr std::size_t fbxHeaderBytes = 27;
constexpr int deepestFbxElement = 64;

/// Counts what the elements take.
class FbxBudget
{
public:
  explicit FbxBudget(std::uint64_t bytes)
    : Left(bytes)
  {
  }
  void take(std::uint64_t bytes)
  {
    if (bytes > this->Left)
    {
      throw std::runtime_error("asks for more memory than a file of its size may");
    }
    this->Left -= bytes;
  }

private:
  std::uint64_t Left;
};

/// The elements of a file of either kind, as children of one without a name.
FbxElement readFbxBinary(const std::string& bytes, std::uint64_t budget);
FbxElement readFbxText(const std::string& text, std::uint64_t budget);

} // namespace dgtk::import

#endif
