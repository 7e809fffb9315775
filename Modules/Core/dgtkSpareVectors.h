// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSpareVectors_h
#define dgtkSpareVectors_h

#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

namespace dgtk
{

/// Vectors of the size that was asked for last, which nobody needs any more, for those who need one: fresh memory is
/// cleared by the system, once more by the vector, and costs as much as what is then written into it. Others are not
/// kept. Thread-safe.
template <typename T>
class SpareVectors
{
public:
  /// A vector of `size`, with whatever it held, or an empty one, where there is none.
  std::vector<T> take(std::size_t size)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    if (size != this->Size)
    {
      this->Spare.clear();
      this->Size = size;
    }
    if (this->Spare.empty())
    {
      return {};
    }
    std::vector<T> last = std::move(this->Spare.back());
    this->Spare.pop_back();
    return last;
  }
  void give(std::vector<T> spare)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    if (!spare.empty() && spare.size() == this->Size)
    {
      this->Spare.push_back(std::move(spare));
    }
  }

private:
  std::mutex Mutex;
  std::size_t Size = 0;
  std::vector<std::vector<T>> Spare;
};

} // namespace dgtk

#endif
