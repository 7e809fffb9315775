// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTextureFile_h
#define dgtkTextureFile_h

#include "dgtkModelIOModule.h"
#include "dgtkModelReader.h"

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace dgtk
{

/// Finds the picture that a model names: as written, relative to the model; its base name beside the model;
/// case-insensitively; same stem with another image extension; stems equal in 8.3 names; the same in ../textures.
/// Returns "" when there is none. `tried` receives a short text of what was tried. Absolute names count by their base
/// name, and so do names that lead out of the folder above the model's. Only regular files are found.
DGTKMODELIO_EXPORT std::string locateTexture(
  const std::string& modelPath, const std::string& name, std::string* tried = nullptr);

/// The same for many names of one model: folders are listed once. A name may also lead anywhere into the scene's
/// folder, when there is one.
class DGTKMODELIO_EXPORT TextureFinder
{
public:
  explicit TextureFinder(const std::string& modelPath, const std::string& sceneFolder = {})
    : ModelPath(modelPath)
    , SceneFolder(sceneFolder)
  {
  }
  std::string find(const std::string& name, std::string* tried = nullptr);

private:
  const std::vector<std::string>& pictures(const std::string& folder);
  bool mayName(const std::string& path) const;
  std::string ModelPath;
  std::string SceneFolder;
  std::map<std::string, std::vector<std::string>> Listings;
};

/// What a picture is for. It matters where a file has light (.exr, .hdr, TIFF of floats): colours are its sRGB codes.
enum class TextureUse
{
  Color,
  Data ///< normals, heights, roughness, ...: the values as they are
};

/// Of one of materialTextures.
inline TextureUse useOf(int Material::*texture)
{
  return texture == &Material::texture || texture == &Material::emissionMap ? TextureUse::Color : TextureUse::Data;
}

/// The pictures of files that a scene shows: each is decoded once, whatever number of models names it. Together they
/// may take 4096 MiB of memory, whatever the machine has, or as many as the environment variable DGTK_TEXTURE_MEMORY
/// says. Thread-safe.
class DGTKMODELIO_EXPORT TextureStore
{
public:
  /// Throws MachineError when the variable is no number of MiB.
  TextureStore();
  explicit TextureStore(std::uint64_t bytes);
  ~TextureStore();
  TextureStore(const TextureStore&) = delete;
  TextureStore& operator=(const TextureStore&) = delete;

  /// Throws MachineError, with the picture and the sum, when it does not fit any more. Nothing has been decoded then.
  void take(const std::string& picture, int width, int height, std::uint64_t bytes);
  /// Takes what the picture of a file will need, unless that was done. False, and `problem` set, when it is no picture.
  bool reserve(const std::string& path, std::string& problem);
  /// What decodeTexture() says of a picture that was reserved, decoded at the first call.
  std::shared_ptr<const Image> decode(const std::string& path, TextureUse use, std::string& problem);

private:
  struct Entry;
  Entry& entryOf(const std::string& path);

  std::uint64_t Limit;
  std::atomic<std::uint64_t> Taken{ 0 };
  std::mutex Mutex; ///< of Entries, not of what they hold
  std::map<std::string, std::unique_ptr<Entry>> Entries;
};

/// Decodes a picture to RGBA, rows top to bottom, in a process of its own: whatever the file does to its decoder, the
/// picture is lost and nothing else. Null, and `problem` set, when it cannot be decoded or is larger than 16384 a side.
/// An alpha channel that is 0 everywhere is taken as absent; what is brighter than white is white. Throws MachineError
/// when memory is short, or beyond what `store` may hold (null: one of its own).
DGTKMODELIO_EXPORT std::shared_ptr<const Image> decodeTexture(
  const std::string& path, std::string& problem, TextureStore* store = nullptr, TextureUse use = TextureUse::Color);

/// Decodes a picture of light: .hdr and .exr as they are, others from sRGB. Null, and `problem` set, as above; also
/// where a value is not finite. Negative values become 0.
DGTKMODELIO_EXPORT std::shared_ptr<const RadianceImage> decodeRadiance(
  const std::string& path, std::string& problem, TextureStore* store = nullptr);

/// Whether a picture is a cut-out: some texels have alpha below 0.5 and some do not.
DGTKMODELIO_EXPORT bool isCutOut(const Image& image);

} // namespace dgtk

#endif
