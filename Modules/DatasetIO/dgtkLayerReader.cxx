// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLayerReader.h"

#include "dgtkError.h"
#include "dgtkInputFile.h"
#include "dgtkText.h"

#include <algorithm>
#include <cerrno>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace dgtk
{

InputFile::InputFile(const std::string& path)
  : Path(path)
  , Descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK))
{
  struct stat info = {};
  if (this->Descriptor < 0 || ::fstat(this->Descriptor, &info) != 0)
  {
    throw InputError(path, std::string("cannot be read: ") + std::strerror(errno));
  }
  if (!S_ISREG(info.st_mode))
  {
    ::close(this->Descriptor);
    throw InputError(path, "cannot be read", "a file", S_ISDIR(info.st_mode) ? "a directory" : "a pipe or device");
  }
  this->Size = static_cast<std::uint64_t>(info.st_size);
}

InputFile::~InputFile() { ::close(this->Descriptor); }

void InputFile::read(std::uint64_t offset, void* to, std::size_t bytes) const
{
  if (offset > this->Size || bytes > this->Size - offset)
  {
    this->fail(this->Size, "ends too early", std::to_string(bytes) + " bytes from offset " + std::to_string(offset));
  }
  char* out = static_cast<char*>(to);
  while (bytes > 0)
  {
    const ssize_t n = ::pread(this->Descriptor, out, bytes, static_cast<off_t>(offset));
    if (n < 0 && errno == EINTR)
    {
      continue;
    }
    if (n <= 0)
    {
      this->fail(offset, n < 0 ? std::string("cannot be read: ") + std::strerror(errno) : "ends too early");
    }
    out += n;
    offset += static_cast<std::uint64_t>(n);
    bytes -= static_cast<std::size_t>(n);
  }
}

std::string InputFile::head(std::size_t bytes) const
{
  std::string text(static_cast<std::size_t>(std::min<std::uint64_t>(bytes, this->Size)), '\0');
  this->read(0, text.data(), text.size());
  return text;
}

void InputFile::fail(
  std::uint64_t offset, const std::string& what, const std::string& expected, const std::string& found) const
{
  throw InputError(this->Path, "offset " + std::to_string(offset) + ": " + what, expected, found);
}

void checkImageSize(const InputFile& file, std::uint64_t offset, std::int64_t width, std::int64_t height)
{
  if (width < 1 || height < 1 || width > largestImageSide || height > largestImageSide)
  {
    file.fail(offset, "unusable image size", "1 to " + std::to_string(largestImageSide) + " pixels a side",
      std::to_string(width) + " x " + std::to_string(height));
  }
}

Rows RowReader::read(int rows)
{
  if (rows < 1)
  {
    throw UsageError("a block of " + std::to_string(rows) + " rows cannot be read");
  }
  Rows block(
    this->Info.type, this->Info.channels, this->Info.width, this->Next, std::min(rows, this->Info.height - this->Next));
  if (block.height() > 0)
  {
    this->readRows(block);
    this->Next += block.height();
  }
  return block;
}

void RowReader::skip(int rows)
{
  const int target = this->Next + std::min(std::max(rows, 0), this->Info.height - this->Next);
  while (this->Next < target && !this->anyRow())
  {
    this->read(1);
  }
  this->Next = target;
}

bool isLayerFile(const std::string& path)
{
  const std::string extension = extensionOf(path);
  return extension == "png" || extension == "exr" || plainReader(extension);
}

std::unique_ptr<RowReader> openLayerFile(const std::string& path, DepthMatrices* matrices)
{
  std::unique_ptr<RowReader> reader = openLayerTable(path, matrices);
  if (reader->info().height == 0)
  {
    throw InputError(path, "is an image without rows");
  }
  return reader;
}

std::unique_ptr<RowReader> openLayerTable(const std::string& path, DepthMatrices* matrices)
{
  const std::string extension = extensionOf(path);
  if (extension == "png")
  {
    return openPngReader(path);
  }
  if (extension == "exr")
  {
    return openExrReader(path);
  }
  const RowReaderFactory open = plainReader(extension);
  if (!open)
  {
    throw UsageError(path + ": no reader for images of this kind (there are npy, png, ppm, pgm, pfm, exr, flo, dgd)");
  }
  return open(path, matrices);
}

ImageData readLayerFile(const std::string& path, std::uint64_t limit)
{
  ImageData image;
  const std::unique_ptr<RowReader> reader = openLayerFile(path, &image.matrices);
  image.info = reader->info();
  if (image.info.pixelBytes() > limit)
  {
    throw InputError(path, "is too large to be read at once", "at most " + std::to_string(limit) + " bytes",
      std::to_string(image.info.pixelBytes()) + " bytes");
  }
  image.pixels = reader->read(image.info.height);
  return image;
}

} // namespace dgtk
