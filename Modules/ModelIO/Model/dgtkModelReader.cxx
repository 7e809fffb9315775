// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelReader.h"

#include "dgtkError.h"
#include "dgtkKeptModel.h"
#include "dgtkReaderRegistry.h"
#include "dgtkText.h"
#include "dgtkWorkTime.h"

#include <algorithm>
#include <filesystem>
#include <new>
#include <system_error>

namespace dgtk
{

namespace
{
std::string knownExtensions()
{
  std::string known;
  for (const ReaderRow& row : readerRows())
  {
    for (const std::string& extension : row.info.extensions)
    {
      known += (known.empty() ? "." : " .") + extension;
    }
  }
  return known;
}

ModelContents contentsOf(const ReaderRow& row, const std::string& path, const ReadOptions& options)
{
  std::error_code error;
  if (std::filesystem::is_regular_file(path, error) && std::filesystem::is_empty(path, error) && !error)
  {
    throw InputError(path, "is empty", "a model", "0 bytes");
  }
  const KeptModel kept(options.cache, path, row.info.format);
  std::optional<ModelContents> found = kept.find();
  return found ? std::move(*found) : kept.keep(row.read(path, options));
}
} // namespace

const std::vector<ReaderInfo>& modelReaders()
{
  static const std::vector<ReaderInfo> infos = []
  {
    std::vector<ReaderInfo> all;
    for (const ReaderRow& row : readerRows())
    {
      all.push_back(row.info);
    }
    return all;
  }();
  return infos;
}

std::shared_ptr<const Model> readModel(const std::string& path, const ReadOptions& options)
{
  const WorkTime load(WorkStage::Load);
  const std::string extension = extensionOf(path);
  for (const ReaderRow& row : readerRows())
  {
    const std::vector<std::string>& known = row.info.extensions;
    if (std::find(known.begin(), known.end(), extension) != known.end())
    {
      try
      {
        return withPictures(contentsOf(row, path, options), options);
      }
      catch (const std::bad_alloc&)
      {
        throw MachineError(path + ": is too large for the memory of this machine");
      }
    }
  }
  throw InputError(path, "is not a model file that can be read", "one of " + knownExtensions(),
    extension.empty() ? "no extension" : quoted("." + extension));
}

} // namespace dgtk
