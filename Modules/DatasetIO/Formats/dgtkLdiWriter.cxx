// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLdiFile.h"

#include "dgtkError.h"
#include "dgtkHash.h"
#include "dgtkLayerFile.h"

#include <algorithm>
#include <numeric>

namespace dgtk
{

LdiFileWriter::LdiFileWriter(const FilePlace& path, int width, int height)
  : Path(path.path())
  , Width(width)
  , Height(height)
  , File(path)
{
}

void LdiFileWriter::write(const LdiRows& rows)
{
  if (this->Finished || rows.y != this->NextRow || rows.height < 0 || rows.height > this->Height - this->NextRow)
  {
    throw UsageError(this->Path + ": rows out of order (expected row " + std::to_string(this->NextRow) + " of " +
                     std::to_string(this->Height) + ", found rows " + std::to_string(rows.y) + " to " +
                     std::to_string(std::int64_t(rows.y) + rows.height) + ")");
  }
  const std::uint64_t surfaces = std::accumulate(rows.counts.begin(), rows.counts.end(), std::uint64_t(0));
  if (rows.counts.size() != std::size_t(this->Width) * rows.height || surfaces != rows.surfaces.size())
  {
    throw UsageError(this->Path + ": the counts of surfaces do not add up");
  }
  this->writeRows(rows);
  this->NextRow += rows.height;
}

FileRecord LdiFileWriter::finish()
{
  if (this->Finished || this->NextRow != this->Height)
  {
    throw UsageError(this->Path + ": finished with " + std::to_string(this->NextRow) + " of " +
                     std::to_string(this->Height) + " rows, or twice");
  }
  FileRecord record = this->complete();
  record.path = this->Path;
  this->File.commit();
  this->Finished = true;
  return record;
}

namespace
{
class ThesisLdiWriter : public LdiFileWriter
{
public:
  ThesisLdiWriter(const FilePlace& path, int width, int height)
    : LdiFileWriter(path, width, height)
  {
    putLittle(this->Buffer, static_cast<std::int32_t>(width));
    putLittle(this->Buffer, static_cast<std::int32_t>(height));
    this->flush();
  }

protected:
  void writeRows(const LdiRows& rows) override
  {
    const LdiSurface* surface = rows.surfaces.data();
    for (const std::uint32_t count : rows.counts)
    {
      putLittle(this->Buffer, count);
      for (const LdiSurface* end = surface + count; surface != end; ++surface)
      {
        for (const std::uint8_t channel : ldiColor(surface->rgba))
        {
          this->Buffer.push_back(static_cast<char>(channel));
        }
        putLittle(this->Buffer, surface->depth);
        putLittle(this->Buffer, surface->splatIndex);
      }
      if (this->Buffer.size() > mostBuffered)
      {
        this->flush();
      }
    }
    this->flush();
  }

  FileRecord complete() override { return { {}, this->Bytes, this->Hash.hex() }; }

private:
  static constexpr std::size_t mostBuffered = 1 << 20;

  void flush()
  {
    this->File.write(this->Buffer);
    this->Hash.update(this->Buffer.data(), this->Buffer.size());
    this->Bytes += this->Buffer.size();
    this->Buffer.clear();
  }

  std::string Buffer;
  Sha256 Hash;
  std::uint64_t Bytes = 0;
};
} // namespace

std::array<std::uint8_t, 4> ldiColor(const std::array<float, 4>& rgba)
{
  std::array<std::uint8_t, 4> bytes{};
  std::transform(rgba.begin(), rgba.end(), bytes.begin(),
    [](float value) { return static_cast<std::uint8_t>(std::min(std::max(value, 0.0f), 1.0f) * 255.0f + 0.5f); });
  return bytes;
}

std::unique_ptr<LdiWriter> makeLdiWriter(const std::string& format, const FilePlace& path, int width, int height)
{
  if (format == "ldi")
  {
    return std::make_unique<ThesisLdiWriter>(path, width, height);
  }
  if (format == "exr")
  {
    return makeDeepExrWriter(path, width, height);
  }
  throw UsageError("layered depth images cannot be written as " + quoted(format) + " (expected ldi or exr)");
}

} // namespace dgtk
