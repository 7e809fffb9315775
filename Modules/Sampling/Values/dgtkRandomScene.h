// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRandomScene_h
#define dgtkRandomScene_h

#include "dgtkSamplingModule.h"

#include "dgtkJson.h"
#include "dgtkSceneDescription.h"

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace dgtk
{

/// Files that a pattern names, with `*` and `?` in any part of its path, in the order of their bytes; paths are written
/// as the pattern is. A part that begins with a dot is named by one that does only.
DGTKSAMPLING_EXPORT std::vector<std::string> filesLike(const std::string& pattern, const std::string& folder);
/// Whether a name is like a pattern with `*` and `?`.
DGTKSAMPLING_EXPORT bool isLike(const std::string& name, const std::string& pattern);

/// A .json scene that may be random, as read. Immutable but for the files that patterns were found to name;
/// thread-safe.
class DGTKSAMPLING_EXPORT RandomScene
{
public:
  /// Throws InputError for what is no .json or no JSON.
  static std::shared_ptr<const RandomScene> read(const std::string& path);
  /// Of a text that is in no file; relative paths start in `folder`.
  static std::shared_ptr<const RandomScene> ofText(const std::string& json, const std::string& folder);

  const JsonDocument& document() const { return this->Document; }
  const std::string& file() const { return this->File; } ///< "": none
  const std::string& folder() const { return this->Folder; }
  const std::string& sha256() const { return this->Sha256; }
  std::uint64_t seed() const { return this->Seed; }
  bool stratify() const { return this->Stratify; }
  UpAxis upAxis() const { return this->Up; }

  /// filesLike() in the scene's folder; found once.
  const std::vector<std::string>& files(const std::string& pattern) const;
  /// All patterns that files() was asked for.
  std::map<std::string, std::vector<std::string>> foundFiles() const;

  /// A value that is random: path in the scene ("objects[1].scale"), word, line.
  struct Place
  {
    std::string path;
    std::string word;
    int line = 0;
  };
  /// All values that are random or use a parameter, counts and rules, in the file's order.
  std::vector<Place> places() const;

private:
  RandomScene(const std::string& file, const std::string& folder, const std::string& contents);
  JsonDocument Document;
  std::string File;
  std::string Folder;
  std::string Sha256;
  std::uint64_t Seed = 0;
  bool Stratify = false;
  UpAxis Up = UpAxis::Y;
  mutable std::mutex Lock;
  mutable std::map<std::string, std::vector<std::string>> Found;
};

} // namespace dgtk

#endif
