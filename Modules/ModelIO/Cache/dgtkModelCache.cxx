// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelCache.h"

#include "dgtkError.h"
#include "dgtkFile.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <vector>

#include <sys/stat.h>

namespace dgtk
{

namespace
{
namespace fs = std::filesystem;
const char* const sizeVariable = "DGTK_CACHE";
constexpr std::uint64_t cacheMebibyte = std::uint64_t(1) << 20;
constexpr std::uint64_t usualMebibytes = 2048;
constexpr std::uint64_t notCounted = ~std::uint64_t(0);

std::string environment(const char* name)
{
  const char* const value = std::getenv(name);
  return value ? value : "";
}

std::uint64_t mebibytesOfEnvironment()
{
  const std::string digits = environment(sizeVariable);
  if (digits.size() > 9 || digits.find_first_not_of("0123456789") != std::string::npos)
  {
    throw UsageError(std::string(sizeVariable) + " is not a number of MiB: " + quoted(digits));
  }
  return digits.empty() ? usualMebibytes : std::stoull(digits);
}

/// The folder of the XDG Base Directory Specification, which says that relative ones do not count; "" for none.
std::string folderOfUser()
{
  const std::string cache = environment("XDG_CACHE_HOME");
  const std::string home = environment("HOME");
  const std::string folder = !cache.empty() && cache[0] == '/' ? cache
                             : !home.empty() && home[0] == '/' ? home + "/.cache"
                                                               : std::string();
  return folder.empty() ? folder : folder + "/dgtk";
}

struct KeptFile
{
  fs::file_time_type used;
  std::uint64_t bytes = 0;
  fs::path path;
};

/// Files of models in a folder; what killed processes left behind is removed.
std::vector<KeptFile> filesIn(const std::string& folder)
{
  std::vector<KeptFile> files;
  std::error_code code;
  for (fs::directory_iterator it(folder, code), end; !code && it != end; it.increment(code))
  {
    std::error_code gone;
    KeptFile file{ it->last_write_time(gone), it->file_size(gone), it->path() };
    const bool isOld = fs::file_time_type::clock::now() - file.used > std::chrono::hours(1);
    if (!gone && file.path.extension() == ".model")
    {
      files.push_back(std::move(file));
    }
    else if (!gone && file.path.extension() == ".partial" && isOld)
    {
      fs::remove(file.path, gone);
    }
  }
  return files;
}

std::mutex useMutex;
std::shared_ptr<ModelCache>& used()
{
  static std::shared_ptr<ModelCache> cache;
  return cache;
}
} // namespace

ModelCache::ModelCache(const std::string& folder, std::uint64_t bytes)
  : Folder(folder)
  , Limit(bytes)
{
}

std::shared_ptr<ModelCache> ModelCache::ofUser()
{
  const std::uint64_t limit = mebibytesOfEnvironment() * cacheMebibyte;
  const std::string folder = folderOfUser();
  return limit == 0 || folder.empty() ? nullptr : std::make_shared<ModelCache>(folder, limit);
}

void ModelCache::use(std::shared_ptr<ModelCache> cache)
{
  const std::lock_guard<std::mutex> lock(useMutex);
  used() = std::move(cache);
}

std::shared_ptr<ModelCache> ModelCache::inUse()
{
  const std::lock_guard<std::mutex> lock(useMutex);
  return used();
}

/// For its owner alone, as models may be confidential.
void ModelCache::makeFolder() const
{
  makeFolders(fs::path(this->Folder).parent_path().string());
  ::mkdir(this->Folder.c_str(), 0700);
}

void ModelCache::added(const std::string& file)
{
  std::error_code code;
  const std::uint64_t bytes = fs::file_size(file, code);
  const std::uint64_t before = this->Sum.load();
  if (before != notCounted && !code && (this->Sum += bytes) <= this->Limit)
  {
    return;
  }
  std::vector<KeptFile> files = filesIn(this->Folder);
  std::sort(files.begin(), files.end(), [](const KeptFile& a, const KeptFile& b) { return a.used < b.used; });
  std::uint64_t sum = 0;
  for (const KeptFile& kept : files)
  {
    sum += kept.bytes;
  }
  const std::uint64_t aim = sum > this->Limit ? this->Limit - this->Limit / 8 : this->Limit;
  for (auto kept = files.begin(); kept != files.end() && sum > aim; ++kept)
  {
    sum -= kept->bytes;
    fs::remove(kept->path, code);
  }
  this->Sum = sum;
}

} // namespace dgtk
