// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTextureFile.h"

#include "dgtkError.h"
#include "dgtkModelFolder.h"
#include "dgtkText.h"

#include <algorithm>
#include <filesystem>

namespace dgtk
{

namespace
{
namespace fs = std::filesystem;

constexpr std::size_t mostEntries = 20000;

const char* const imageExtensions[] = { "png", "jpg", "jpeg", "tga", "bmp", "rgb", "rgba", "sgi", "bw", "dds", "gif",
  "tif", "tiff", "ppm", "pgm", "pnm", "pcx", "webp", "exr", "hdr", "psd" };

std::string baseName(const std::string& path)
{
  const std::size_t slash = path.find_last_of("/\\:");
  return slash == std::string::npos ? path : path.substr(slash + 1);
}

/// A leading dot belongs to the stem's name: `.body01` is a name without extension.
std::string stemOf(const std::string& name)
{
  const std::size_t dot = name.find_last_of('.');
  return dot == std::string::npos || dot == 0 ? name : name.substr(0, dot);
}

bool isImageExtension(const std::string& extension)
{
  return std::find(std::begin(imageExtensions), std::end(imageExtensions), extension) != std::end(imageExtensions);
}

bool isFile(const fs::path& path)
{
  std::error_code code;
  return fs::is_regular_file(path, code);
}

/// Whether a stem, in lower case, is what DOS programs cut another one to: "foobarba" and "foobar~1" of "foobarbaz".
bool isShortStem(const std::string& cut, const std::string& whole)
{
  const std::size_t kept = std::min<std::size_t>(cut.find('~'), 8);
  return cut.size() <= 8 && kept > 0 && cut.size() >= kept && whole.compare(0, kept, cut, 0, kept) == 0;
}

bool sameShortStem(const std::string& wanted, const std::string& there)
{
  return isShortStem(wanted, there) || (there.find('~') == std::string::npos && isShortStem(there, wanted));
}

/// A folder beneath another one, by its name in any case; the name as it is where there is none.
fs::path folderInAnyCase(const fs::path& folder, const fs::path& name)
{
  fs::path found = folder;
  for (const fs::path& part : name)
  {
    std::error_code code;
    std::string next = part.string();
    std::size_t seen = 0;
    if (!fs::is_directory(found / part, code))
    {
      std::vector<std::string> alike;
      const fs::path listed = found.empty() ? fs::path(".") : found;
      for (fs::directory_iterator it(listed, code), end; !code && it != end && seen < mostEntries;
           it.increment(code), ++seen)
      {
        const std::string other = it->path().filename().string();
        if (lower(other) == lower(next) && it->is_directory(code))
        {
          alike.push_back(other);
        }
      }
      next = alike.empty() ? next : *std::min_element(alike.begin(), alike.end());
    }
    found /= next;
  }
  return found;
}

/// Names of the pictures of a folder, sorted.
std::vector<std::string> picturesIn(const fs::path& folder)
{
  std::vector<std::string> names;
  std::error_code code;
  std::size_t seen = 0;
  for (fs::directory_iterator it(folder, code), end; !code && it != end && seen < mostEntries;
       it.increment(code), ++seen)
  {
    const std::string name = it->path().filename().string();
    if (isImageExtension(extensionOf(name)) && isFile(it->path()))
    {
      names.push_back(name);
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// Among the pictures of a folder: the name itself, whatever its case; its stem with another extension, in the order
/// of imageExtensions; a stem that is the same in 8.3 names. "" when there is none.
std::string bestMatch(const std::vector<std::string>& pictures, const std::string& wanted)
{
  const std::string name = lower(wanted);
  const std::string stem = isImageExtension(extensionOf(name)) ? stemOf(name) : name;
  for (const std::string& picture : pictures)
  {
    if (lower(picture) == name)
    {
      return picture;
    }
  }
  for (const bool shortened : { false, true })
  {
    for (const char* extension : imageExtensions)
    {
      for (const std::string& picture : pictures)
      {
        const std::string other = lower(stemOf(picture));
        if (extensionOf(picture) == extension && (shortened ? sameShortStem(stem, other) : other == stem))
        {
          return picture;
        }
      }
    }
  }
  return {};
}
} // namespace

bool TextureFinder::mayName(const std::string& path) const
{
  const std::string above = folderOfFile(this->ModelPath) + "/..";
  return isNamedBeneath(path, above) || (!this->SceneFolder.empty() && isNamedBeneath(path, this->SceneFolder));
}

const std::vector<std::string>& TextureFinder::pictures(const std::string& folder)
{
  const auto known = this->Listings.find(folder);
  return known != this->Listings.end() ? known->second
                                       : this->Listings.emplace(folder, picturesIn(folder)).first->second;
}

std::string TextureFinder::find(const std::string& written, std::string* tried)
{
  std::string name = written;
  std::replace(name.begin(), name.end(), '\\', '/');
  name.erase(std::find(name.begin(), name.end(), '\0'), name.end());
  const std::string base = baseName(name);
  const fs::path folder = fs::path(this->ModelPath).parent_path();
  if (tried)
  {
    *tried = "as written, " + quoted(base) +
             " beside the model, in any case, with other image extensions, as an 8.3 name, and in ../textures";
  }
  const bool relative = !name.empty() && name[0] != '/' && name.find(':') == std::string::npos;
  if (base.empty() || base == "." || base == ".." || name.size() > 4096)
  {
    return {};
  }
  if (relative && isFile(folder / name) && this->mayName((folder / name).string()))
  {
    return (folder / name).lexically_normal().string();
  }
  if (isFile(folder / base))
  {
    return (folder / base).string();
  }
  // in the folder that was written, beside the model, and where games keep their textures
  std::vector<fs::path> folders = { folder, folder / ".." / "textures" };
  if (relative && name != base && this->mayName((folder / name).string()))
  {
    folders.insert(folders.begin(), folderInAnyCase(folder, fs::path(name).parent_path()));
  }
  // a leading dot, in MD2, means the model's own folder
  const std::string wanted = base[0] == '.' ? base.substr(1) : base;
  for (const fs::path& place : folders)
  {
    const std::string match = bestMatch(this->pictures(place.string().empty() ? "." : place.string()), wanted);
    if (!match.empty())
    {
      return (place / match).lexically_normal().string();
    }
  }
  return {};
}

std::string locateTexture(const std::string& modelPath, const std::string& name, std::string* tried)
{
  return TextureFinder(modelPath).find(name, tried);
}

} // namespace dgtk
