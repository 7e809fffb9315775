// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPictureServer_h
#define dgtkPictureServer_h

#include "dgtkPictureProtocol.h"

#include <cstddef>
#include <cstdint>
#include <string>

/// What the programs that decode pictures have in common: requests one after the other, behind the wall, within the
/// memory and processor time that a picture of its size may have.
namespace dgtk::picture
{

/// Shared memory, mapped. Throws std::bad_alloc.
class Mapping
{
public:
  Mapping(int file, std::uint64_t bytes, int protection);
  ~Mapping();
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;
  void* data() const { return this->Data; }
  std::size_t size() const { return this->Bytes; }

private:
  std::size_t Bytes;
  void* Data;
};

/// The folder in which a descriptor of this process has a path; problems that name such a path lose it.
extern const std::string descriptorFolder;

void refuse(Answer& answer, std::string problem);

/// For a header that says this size of pixels of `nativeBytes` each: false, with `answer` refused, when no picture of
/// these may be. Sets the answer's width, height and cramped, and the limits for what is left to do.
bool admit(const Request& request, std::int64_t width, std::int64_t height, int channels, std::uint64_t nativeBytes,
  std::uint64_t expansion, Answer& answer);

/// The memory for the pixels of an admitted picture; throws std::runtime_error if it is of another size.
class PixelMemory : public Mapping
{
public:
  PixelMemory(const Request& request, const Answer& answer, int memory);
};

/// Answers until nobody asks. `decoder` may throw; `start`, null for nothing, loads what cannot be loaded behind the
/// wall.
using Decoder = void (*)(const Request& request, int file, int memory, Answer& answer);
int serve(Decoder decoder, void (*start)());

} // namespace dgtk::picture

#endif
