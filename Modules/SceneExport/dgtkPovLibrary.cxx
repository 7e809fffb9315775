// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovLibrary.h"

#include "dgtkFile.h"
#include "dgtkHash.h"

#include <filesystem>

namespace dgtk
{

namespace
{
constexpr std::size_t hashDigits = 16;
constexpr std::size_t longestStem = 100;
/// Forgotten meshes are looked for when so many are known.
constexpr std::size_t manyEntries = 256;

std::string stemOf(const std::string& path, const char* fallback)
{
  const std::string stem = povPlainName(std::filesystem::path(path).stem().string());
  return stem.empty() ? fallback : stem.substr(0, longestStem);
}

/// Pictures of one mesh.
class PovImagesIncluded final : public PovImages
{
public:
  explicit PovImagesIncluded(PovLibrary::Impl& library)
    : Library(library)
  {
  }

  std::string color(const Texture& texture, const Eigen::Vector3d& tint, bool cutOut) override
  {
    const bool whole = tint == Eigen::Vector3d(1, 1, 1) && povReads(texture);
    const std::string stem = stemOf(texture.path, "texture");
    return this->named(this->Library.image({ texture.image.get(), tint.x(), tint.y(), tint.z(), cutOut },
      [&]
      {
        return whole ? this->Library.add(stem, "png", readFile(texture.path))
                     : this->Library.add(stem, "ppm", povPpm(*texture.image, tint, cutOut));
      }));
  }

  std::string mask(const Texture& texture) override
  {
    const std::string stem = stemOf(texture.path, "texture") + "_mask";
    return this->named(this->Library.image({ texture.image.get(), -1, -1, -1, true },
      [&] { return this->Library.add(stem, "pgm", povMaskPgm(*texture.image)); }));
  }

  const std::vector<std::string>& files() const { return this->Files; }

private:
  std::string named(const std::string& file)
  {
    this->Files.push_back(file);
    return file.substr(file.size() - 3) + " \"" + this->Library.reference + file + '"';
  }

  PovLibrary::Impl& Library;
  std::vector<std::string> Files;
};
} // namespace

PovLibrary::PovLibrary(
  const std::string& folder, const std::string& reference, std::function<void(const std::string&)> announce)
  : Self(new Impl)
{
  this->Self->folder = folder;
  this->Self->reference = reference;
  this->Self->announce = std::move(announce);
}

PovLibrary::~PovLibrary() = default;

std::string PovLibrary::Impl::add(const std::string& stem, const std::string& extension, const std::string& contents)
{
  const std::string hash = Sha256::of(contents);
  std::string name = stem + '_' + hash.substr(0, hashDigits) + '.' + extension;
  const std::lock_guard<std::mutex> lock(this->Mutex);
  if (this->Written.try_emplace(name, PovFile{ name, contents.size(), hash }).second)
  {
    this->announce(name);
    writeFile(this->folder + '/' + name, contents);
  }
  return name;
}

PovFile PovLibrary::Impl::describe(const std::string& name)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  return this->Written.at(name);
}

template <class Make>
std::string PovLibrary::Impl::image(const ImageKey& key, Make make)
{
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    const auto known = this->Images.find(key);
    if (known != this->Images.end())
    {
      return known->second;
    }
  }
  const std::string name = make(); // twice the same when two threads come at once
  const std::lock_guard<std::mutex> lock(this->Mutex);
  return this->Images.try_emplace(key, name).first->second;
}

std::shared_ptr<PovLibrary::Impl::Entry> PovLibrary::Impl::entryOf(
  const Instance& instance, std::uint32_t ownId, bool headLit)
{
  const auto gone = [](const Entry& entry)
  { return entry.geometry.expired() || (entry.materials && entry.materials->expired()); };
  const std::lock_guard<std::mutex> lock(this->Mutex);
  for (auto at = this->Entries.begin(); this->Entries.size() > manyEntries && at != this->Entries.end();)
  {
    at = gone(*at->second) ? this->Entries.erase(at) : std::next(at);
  }
  std::shared_ptr<Entry>& entry = this->Entries[{
    instance.model.get(), instance.geometry.get(), &povMaterialsOf(instance), ownId, headLit, povUnitOf(instance) }];
  if (!entry || gone(*entry))
  {
    entry = std::make_shared<Entry>();
    entry->geometry = instance.geometry;
    entry->materials =
      instance.materials ? std::optional<std::weak_ptr<const std::vector<Material>>>(instance.materials) : std::nullopt;
  }
  return entry;
}

PovIncluded PovLibrary::Impl::write(const Instance& instance, std::uint32_t ownId, const PovSurfaceOptions& options)
{
  PovText text;
  PovImagesIncluded images(*this);
  povWriteMesh(text, instance, povTexturesOf(instance, ownId, options, images));
  PovIncluded included;
  included.name = "Mesh_" + Sha256::of(text.text()).substr(0, hashDigits);
  included.file =
    this->add(stemOf(instance.model->path, "mesh"), "inc", "#declare " + included.name + " = mesh2 " + text.text());
  included.pictures = images.files();
  return included;
}

PovIncluded PovLibrary::Impl::mesh(const Instance& instance, std::uint32_t ownId, const PovSurfaceOptions& options)
{
  const std::shared_ptr<Entry> entry = this->entryOf(instance, ownId, options.headLit);
  std::call_once(entry->once, [&] { entry->included = this->write(instance, ownId, options); });
  return entry->included;
}

std::vector<std::string> PovLibrary::Impl::declareTurned(PovText& text, const std::string& name,
  const Instance& instance, const PovTurned& turned, const PovSurfaceOptions& options)
{
  PovImagesIncluded images(*this);
  povDeclareMesh(text, name, instance, povTexturesOf(instance, 0, options, images), turned);
  return images.files();
}

void PovMeshesIncluded::use(const std::vector<std::string>& files)
{
  for (const std::string& file : files)
  {
    if (this->Known.insert(file).second)
    {
      this->Uses.push_back(this->Library.describe(file));
    }
  }
}

std::string PovMeshesIncluded::declare(const Instance& instance, std::uint32_t id, const PovTurned& turned)
{
  if (!turned.empty())
  {
    std::string name = "Mesh" + std::to_string(id);
    this->use(this->Library.declareTurned(this->Declared, name, instance, turned, this->Options));
    return name;
  }
  const PovIncluded mesh = this->Library.mesh(instance, povOwnId(instance, id, this->Options), this->Options);
  if (this->Known.count(mesh.file) == 0)
  {
    this->Includes.push_back(mesh.file);
  }
  this->use({ mesh.file });
  this->use(mesh.pictures);
  return mesh.name;
}

} // namespace dgtk
