// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkKeptModel_h
#define dgtkKeptModel_h

#include "dgtkModelCache.h"
#include "dgtkModelContents.h"

#include <optional>
#include <string>

namespace dgtk
{

/// The place of one model in a cache. Made before the model is read.
class KeptModel
{
public:
  /// `cache`: null for none.
  KeptModel(std::shared_ptr<ModelCache> cache, const std::string& path, const std::string& format);

  /// The model, when it is kept.
  std::optional<ModelContents> find() const;
  /// Keeps the model, which has just been read, when that pays and nothing has changed meanwhile. Returns it.
  ModelContents keep(ModelContents contents) const;

private:
  std::string fileOf(const ModelDependency& dependency) const;
  std::string identityOf(const ModelDependency& dependency) const;
  bool isUnchanged(const ModelDependency& dependency) const;

  std::shared_ptr<ModelCache> Cache;
  std::string Path;
  std::string Absolute;
  std::uint64_t Bytes = 0; ///< of the model's file
  std::int64_t Begin = 0;  ///< of reading, as files' times are counted
  std::string File;        ///< of the cache; "" when the model cannot be kept
};

} // namespace dgtk

#endif
