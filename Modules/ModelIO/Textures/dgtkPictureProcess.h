// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPictureProcess_h
#define dgtkPictureProcess_h

#include "dgtkPictureProtocol.h"

#include <cstdint>
#include <string>
#include <vector>

namespace dgtk::picture
{

/// An encoded picture: a file, or bytes that a model holds.
struct Source
{
  std::string path; ///< of the file; with `bytes`, of the model
  std::string extension;
  const std::vector<std::uint8_t>* bytes = nullptr;
};

/// Pixels that a helper has written; it may go on doing so, their number does not change.
class Pixels
{
public:
  Pixels() = default;
  ~Pixels();
  Pixels(const Pixels&) = delete;
  Pixels& operator=(const Pixels&) = delete;
  template <class T>
  const T* as() const
  {
    return static_cast<const T*>(this->Data);
  }

  /// Makes room; `file` is shared memory of that size. Throws std::bad_alloc.
  void map(int file, std::size_t bytes);

private:
  void* Data = nullptr;
  std::size_t Bytes = 0;
};

/// Starts dgtk-picture, unless it runs, and does not wait for it: for callers that are going to need it.
void prepare();

/// Size of the decoded picture. False, and `problem` set, when it is none. Throws MachineError when the machine, not
/// the picture, is in the way.
bool measure(const Source& source, Values values, Answer& size, std::string& problem);

/// The same with its pixels. A process decodes all pictures that it can, one after the other; it is started again when
/// a picture made it end, and ends when nothing has been asked for a while. Thread-safe.
bool decode(const Source& source, Values values, Answer& size, Pixels& pixels, std::string& problem);

} // namespace dgtk::picture

#endif
