// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkModelCache_h
#define dgtkModelCache_h

#include "dgtkModelIOModule.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

namespace dgtk
{

/// Models that were read before, in a folder: what stands in their own files, as it was when they had been read. A
/// model is found again by the contents of its file and of all that it names, by its file's name, and by the programs
/// that read it; a byte that is not as it was written makes it a stranger. Pictures beside a model are not kept.
/// Processes may use the folder at the same time, and be killed at any time. What stands in the way (no room, no
/// rights) is never an error: the model is read then. Thread-safe.
class DGTKMODELIO_EXPORT ModelCache
{
public:
  /// At most `bytes` of files; those that were not used for longest go first. The folder is made when it is needed.
  ModelCache(const std::string& folder, std::uint64_t bytes);

  /// That of the user: $XDG_CACHE_HOME/dgtk or ~/.cache/dgtk, at most 2048 MiB, or as many as the environment variable
  /// DGTK_CACHE says. Null when that is 0, or there is no such folder. Throws UsageError when it is no number.
  static std::shared_ptr<ModelCache> ofUser();

  /// Makes a cache that of all models that are read where ReadOptions names no other, null for none. Programs call it
  /// when they start; before, there is none.
  static void use(std::shared_ptr<ModelCache> cache);
  static std::shared_ptr<ModelCache> inUse();

  const std::string& folder() const { return this->Folder; }

private:
  friend class KeptModel;
  void makeFolder() const;
  /// A file is there: others go when they are too many.
  void added(const std::string& file);

  std::string Folder;
  std::uint64_t Limit;
  std::atomic<std::uint64_t> Sum{ ~std::uint64_t(0) }; ///< of the files, roughly; all ones: not counted yet
};

} // namespace dgtk

#endif
