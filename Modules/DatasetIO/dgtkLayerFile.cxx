// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLayerFile.h"

#include "dgtkError.h"

#include <algorithm>

namespace dgtk
{

LayerFileWriter::LayerFileWriter(const FilePlace& path, const LayerSpec& spec, int width, int height)
  : Spec(spec)
  , Width(width)
  , Height(height)
  , Path(path.path())
  , File(path)
{
}

void LayerFileWriter::check(const Rows& rows) const
{
  if (this->Finished)
  {
    throw UsageError(this->Path + ": rows after the file was finished");
  }
  if (rows.type() != this->Spec.type || rows.channels() != this->Spec.channels || rows.width() != this->Width)
  {
    throw UsageError(this->Path + ": rows of another type or width (expected " + std::to_string(this->Width) + " x " +
                     std::to_string(this->Spec.channels) + " " + nameOf(this->Spec.type) + ", found " +
                     std::to_string(rows.width()) + " x " + std::to_string(rows.channels()) + " " +
                     nameOf(rows.type()) + ")");
  }
  if (rows.y() != this->NextRow || rows.height() < 0 || rows.height() > this->Height - this->NextRow)
  {
    throw UsageError(this->Path + ": rows out of order (expected row " + std::to_string(this->NextRow) + " of " +
                     std::to_string(this->Height) + ", found rows " + std::to_string(rows.y()) + " to " +
                     std::to_string(std::int64_t(rows.y()) + rows.height()) + ")");
  }
}

void LayerFileWriter::write(const Rows& rows)
{
  this->check(rows);
  this->writeRows(rows);
  this->NextRow += rows.height();
}

FileRecord LayerFileWriter::finish()
{
  if (this->Finished || this->NextRow != this->Height)
  {
    throw UsageError(this->Path + ": finished with " + std::to_string(this->NextRow) + " of " +
                     std::to_string(this->Height) + " rows, or twice");
  }
  this->complete();
  const std::string sha256 = this->Sequential ? this->Hash.hex() : Sha256::ofFile(this->File.temporaryPath());
  this->File.commit();
  this->Finished = true;
  return { this->Path, this->Bytes, sha256 };
}

void LayerFileWriter::append(const void* data, std::size_t bytes)
{
  this->File.write(data, bytes);
  if (this->Sequential)
  {
    this->Hash.update(data, bytes);
  }
  this->Bytes += bytes;
}

void LayerFileWriter::writeAt(std::uint64_t offset, const void* data, std::size_t bytes)
{
  this->File.writeAt(offset, data, bytes);
  this->Sequential = false;
  this->Bytes = std::max<std::uint64_t>(this->Bytes, offset + bytes);
}

void refuseIds(
  const std::uint32_t* ids, std::size_t count, std::uint32_t largest, const char* container, const std::string& layer)
{
  const std::uint32_t* bad = std::find_if(ids, ids + count, [=](std::uint32_t id) { return id > largest; });
  throw UsageError("layer " + quoted(layer) + ": " +
                   (bad == ids + count ? std::string("a value") : std::to_string(*bad)) + " does not fit " + container +
                   " (largest " + std::to_string(largest) + "); use .npy");
}

void narrow(const Rows& rows, std::vector<float>& out)
{
  out.resize(rows.bytes() / bytesOf(rows.type()));
  if (rows.type() == PixelType::Float32)
  {
    std::memcpy(out.data(), rows.data(), rows.bytes());
  }
  else
  {
    const double* from = rows.row<double>(rows.y());
    std::transform(from, from + out.size(), out.begin(), [](double v) { return static_cast<float>(v); });
  }
}

} // namespace dgtk
