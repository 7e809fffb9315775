// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTextureFile_h
#define dgtkTextureFile_h

#include "dgtkModelIOModule.h"
#include "dgtkModelReader.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// Finds the picture that a model names: as written, relative to the model; its base name beside the model;
/// case-insensitively; same stem with another image extension; stems equal in 8.3 names; the same in ../textures.
/// Returns "" when there is none. `tried` receives a short text of what was tried. Absolute names count by their base
/// name. Only regular files are found.
DGTKMODELIO_EXPORT std::string locateTexture(
  const std::string& modelPath, const std::string& name, std::string* tried = nullptr);

/// The same for many names of one model: folders are listed once.
class DGTKMODELIO_EXPORT TextureFinder
{
public:
  explicit TextureFinder(const std::string& modelPath)
    : ModelPath(modelPath)
  {
  }
  std::string find(const std::string& name, std::string* tried = nullptr);

private:
  const std::vector<std::string>& pictures(const std::string& folder);
  std::string ModelPath;
  std::map<std::string, std::vector<std::string>> Listings;
};

/// Decodes a picture to RGBA, rows top to bottom. Null, and `problem` set, when it cannot be decoded or is larger than
/// 16384 a side. An alpha channel that is 0 everywhere is taken as absent.
DGTKMODELIO_EXPORT std::shared_ptr<const Image> decodeTexture(const std::string& path, std::string& problem);

/// Decodes a picture of light: .hdr and .exr as they are, others from sRGB. Null, and `problem` set, as above; also
/// where a value is not finite. Negative values become 0.
DGTKMODELIO_EXPORT std::shared_ptr<const RadianceImage> decodeRadiance(const std::string& path, std::string& problem);

/// Whether a picture is a cut-out: some texels have alpha below 0.5 and some do not.
DGTKMODELIO_EXPORT bool isCutOut(const Image& image);

/// The textures of one model: each name is looked up once, each file decoded once.
class DGTKMODELIO_EXPORT TextureCache
{
public:
  TextureCache(const std::string& modelPath, const ReadOptions& options)
    : Finder(modelPath)
    , Options(options)
  {
  }
  /// Appends the texture to `textures` unless it is there; returns its index, or -1 when there are too many. `warning`
  /// is set when neither it nor `alternative` was found, or it was not decoded.
  int add(
    std::vector<Texture>& textures, const std::string& name, std::string& warning, const std::string& alternative = {});

private:
  int addFile(std::vector<Texture>& textures, const std::string& name, const std::string& path, std::string& warning);
  TextureFinder Finder;
  ReadOptions Options;
  std::map<std::string, int> ByName;
  std::map<std::string, std::shared_ptr<const Image>> ByPath;
};

} // namespace dgtk

#endif
