// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRunSession.h"

#include "dgtkHash.h"
#include "dgtkRaySource.h"

#include <filesystem>

namespace dgtk
{

namespace
{
constexpr std::uint64_t mostModelBytes = std::uint64_t(1) << 30;
constexpr std::uint64_t mostMeshBytes = std::uint64_t(512) << 20;
constexpr std::size_t mostFiles = 20000; ///< whose hashes are known
} // namespace

RunSession::RunSession()
  : Scenes(mostModelBytes)
  , Meshes(keepRayMeshes(mostMeshBytes))
{
}

ThreadPool& RunSession::pool(int threads)
{
  if (!this->Pool || this->Pool->threads() != threads)
  {
    this->Pool = std::make_unique<ThreadPool>(threads);
  }
  return *this->Pool;
}

bool RunSession::knows(const std::string& path)
{
  const std::lock_guard<std::mutex> guard(this->Mutex);
  return this->Files.count(path) != 0;
}

InputRecord RunSession::fileOf(const std::string& path)
{
  {
    const std::lock_guard<std::mutex> guard(this->Mutex);
    const auto known = this->Files.find(path);
    if (known != this->Files.end())
    {
      return known->second;
    }
  }
  InputRecord record{ path, std::filesystem::file_size(path), hashOfFile(path) };
  const std::lock_guard<std::mutex> guard(this->Mutex);
  if (this->Files.size() >= mostFiles)
  {
    this->Files.clear();
  }
  this->Files[path] = record;
  return record;
}

} // namespace dgtk
