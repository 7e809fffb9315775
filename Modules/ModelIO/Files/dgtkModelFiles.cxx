// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelFiles.h"

#include "dgtkError.h"
#include "dgtkModelFolder.h"
#include "dgtkText.h"

#include <algorithm>
#include <charconv>
#include <filesystem>

namespace dgtk
{

namespace fs = std::filesystem;

ModelFiles::ModelFiles(const std::string& model)
  : Model(model)
  , Folder(folderOfFile(model))
{
}

std::string ModelFiles::find(const std::string& written)
{
  std::string path = this->locate(written);
  path = path.empty() ? this->locate(this->withoutEscapes(written)) : path;
  if (!path.empty())
  {
    this->Found.insert(path);
  }
  if (path != this->Model)
  {
    this->Asked[this->withoutFolder(written)] = path;
  }
  return path;
}

std::vector<ModelDependency> ModelFiles::dependencies() const
{
  std::vector<ModelDependency> all;
  for (const auto& [name, path] : this->Asked)
  {
    all.push_back({ ModelDependency::Kind::Named, name, this->relative(path) });
  }
  return all;
}

std::string ModelFiles::relative(const std::string& path) const
{
  return path.empty() ? path : fs::path(path).lexically_relative(this->Folder).string();
}

std::vector<std::string> ModelFiles::companions(const std::string& modelAsGiven) const
{
  std::vector<std::string> all;
  const std::string folder = (fs::path(this->Model).parent_path() / "").string();
  for (const std::string& file : this->Found)
  {
    const bool below = file.compare(0, folder.size(), folder) == 0;
    if (file != this->Model)
    {
      all.push_back(below ? (fs::path(modelAsGiven).parent_path() / file.substr(folder.size())).string() : file);
    }
  }
  return all;
}

void ModelFiles::refuseOutside(const std::string& modelAsGiven) const
{
  if (!this->Outside.empty())
  {
    const std::string name = oneLine(this->Outside, this->Folder + '/');
    throw InputError(modelAsGiven, "names the file '" + name + "', which lies outside of the model's folder");
  }
}

/// The importer puts the folder in front of what the model says.
std::string ModelFiles::withoutFolder(const std::string& written) const
{
  const std::string folder = (fs::path(this->Folder) / "").string();
  return written.substr(written.compare(0, folder.size(), folder) == 0 ? folder.size() : 0);
}

std::string ModelFiles::withoutEscapes(const std::string& written) const
{
  const std::string own = this->withoutFolder(written);
  return written.substr(0, written.size() - own.size()) + withoutPercents(own);
}

std::string ModelFiles::locate(const std::string& written)
{
  std::string name = written;
  std::replace(name.begin(), name.end(), '\\', '/');
  if (name == this->Model)
  {
    return name;
  }
  const fs::path path(name);
  const fs::path folder(this->Folder);
  std::error_code code;
  std::string outside;
  for (const fs::path& candidate : { folder / path, folder / path.filename() }) // an absolute path stays one
  {
    if (fs::is_regular_file(candidate, code))
    {
      if (liesBeneath(candidate.string(), this->Folder))
      {
        return candidate.string();
      }
      outside = written;
    }
  }
  std::string found = this->inAnyCase(lower(path.filename().string()));
  this->Outside = found.empty() && this->Outside.empty() ? outside : this->Outside;
  return found;
}

std::string ModelFiles::inAnyCase(const std::string& wanted) const
{
  std::string found;
  std::error_code code;
  for (fs::directory_iterator it(this->Folder, code), end; !code && it != end; it.increment(code))
  {
    const std::string other = it->path().filename().string();
    std::error_code kind;
    if (lower(other) == wanted && (found.empty() || other < found) && fs::is_regular_file(it->path(), kind) &&
        liesBeneath(it->path().string(), this->Folder))
    {
      found = other;
    }
  }
  return found.empty() ? found : (fs::path(this->Folder) / found).string();
}

std::string withoutPercents(const std::string& uri)
{
  std::string plain;
  for (std::size_t i = 0; i < uri.size(); ++i)
  {
    unsigned code = 0;
    const char* digits = uri.data() + i + 1;
    const bool escape =
      uri[i] == '%' && i + 2 < uri.size() && std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2;
    plain += escape ? static_cast<char>(code) : uri[i];
    i += escape ? 2 : 0;
  }
  return plain;
}

std::string oneLine(std::string text, const std::string& path)
{
  for (std::size_t at = text.find(path); !path.empty() && at != std::string::npos; at = text.find(path))
  {
    text.erase(at, path.size());
  }
  for (char& c : text)
  {
    c = static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
  }
  while (!text.empty() && (text.back() == ' ' || text.back() == '.'))
  {
    text.pop_back();
  }
  return text.substr(0, 300);
}

} // namespace dgtk
