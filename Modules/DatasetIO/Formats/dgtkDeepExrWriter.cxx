// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDeepExrFile.h"
#include "dgtkLdiFile.h"

#include "dgtkError.h"
#include "dgtkHash.h"
#include "dgtkPortableMath.h"

#include <algorithm>
#include <dlfcn.h>
#include <filesystem>

namespace dgtk
{

namespace
{
/// The function of the library dgtkdeepexr, which stands beside this one and is loaded once.
decltype(&dgtkNewDeepExrFile) deepExrLibrary()
{
  static void* const found = []() -> void*
  {
    Dl_info self;
    if (::dladdr(reinterpret_cast<const void*>(&makeDeepExrWriter), &self) == 0)
    {
      return nullptr;
    }
    const std::string path = std::filesystem::path(self.dli_fname).replace_filename("libdgtkdeepexr.so").string();
    void* const library = ::dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL);
    return library != nullptr ? ::dlsym(library, "dgtkNewDeepExrFile") : nullptr;
  }();
  return reinterpret_cast<decltype(&dgtkNewDeepExrFile)>(found);
}

class DeepExrWriter : public LdiFileWriter
{
public:
  DeepExrWriter(const FilePlace& path, int width, int height)
    : LdiFileWriter(path, width, height)
  {
    const auto make = deepExrLibrary();
    if (make == nullptr)
    {
      throw MachineError(
        this->Path + ": cannot be written: the library libdgtkdeepexr.so is missing or cannot be loaded");
    }
    this->Output.reset(make(this->File.temporaryPath(), width, height));
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
