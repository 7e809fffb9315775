// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRunSession_h
#define dgtkRunSession_h

// Private to Pipeline.

#include "dgtkLikeScene.h"
#include "dgtkThreadPool.h"

#include "dgtkDatasetDocuments.h"

#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace dgtk
{

/// What runs that follow one another share: models and pictures of scenes, trees for rays, threads, hashes of files.
/// What was read once is not read again, whatever becomes of its file.
class RunSession
{
public:
  RunSession();

  std::shared_ptr<const Stage> load(SceneDescription scene, const Stage::WarningSink& warning)
  {
    return this->Scenes.load(std::move(scene), warning);
  }
  /// So many threads, from now on.
  ThreadPool& pool(int threads);
  /// Whether fileOf() need not read it. Thread-safe.
  bool knows(const std::string& path);
  /// Bytes and hash of a file as it was when it was asked for first. Thread-safe.
  InputRecord fileOf(const std::string& path);

private:
  SceneSeries Scenes;
  std::shared_ptr<void> Meshes;
  std::unique_ptr<ThreadPool> Pool;
  std::mutex Mutex;
  std::map<std::string, InputRecord> Files;
};

} // namespace dgtk

#endif
