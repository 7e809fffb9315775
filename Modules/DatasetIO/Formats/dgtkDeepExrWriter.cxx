// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDeepExrFile.h"
#include "dgtkLdiFile.h"

#include "dgtkError.h"
#include "dgtkHash.h"
#include "dgtkOnDemand.h"
#include "dgtkPortableMath.h"

#include <algorithm>
#include <filesystem>

namespace dgtk
{

namespace
{
class DeepExrWriter : public LdiFileWriter
{
public:
  DeepExrWriter(const FilePlace& path, int width, int height)
    : LdiFileWriter(path, width, height)
  {
    this->Output = onDemand<DeepExrCalls>("dgtkdeepexr").make(this->File.temporaryPath(), width, height);
    this->require(this->Output->opened());
  }

protected:
  void writeRows(const LdiRows& rows) override
  {
    if (rows.counts.empty())
    {
      return;
    }
    LdiRows linear = rows;
    for (LdiSurface& surface : linear.surfaces)
    {
      std::transform(surface.rgba.begin(), surface.rgba.begin() + 3, surface.rgba.begin(), portable::linearFromEncoded);
    }
    this->require(this->Output->write(linear));
  }

  FileRecord complete() override
  {
    this->require(this->Output->close());
    const std::string& file = this->File.temporaryPath();
    return { {}, std::filesystem::file_size(file), Sha256::ofFile(file) };
  }

private:
  void require(bool done) const
  {
    if (!done)
    {
      throw MachineError(this->Path + ": cannot be written: " + this->Output->error());
    }
  }

  std::unique_ptr<DeepExrFile> Output;
};
} // namespace

std::unique_ptr<LdiWriter> makeDeepExrWriter(const FilePlace& path, int width, int height)
{
  return std::make_unique<DeepExrWriter>(path, width, height);
}

} // namespace dgtk
