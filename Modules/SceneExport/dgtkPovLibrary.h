// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPovLibrary_h
#define dgtkPovLibrary_h

#include "dgtkPovExport.h"
#include "dgtkPovMeshes.h"

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace dgtk
{

/// A mesh of the library.
struct PovIncluded
{
  std::string name; ///< of the mesh
  std::string file; ///< that declares it
  std::vector<std::string> pictures;
};

struct PovLibrary::Impl
{
  std::string folder;
  std::string reference;
  std::function<void(const std::string&)> announce;

  PovIncluded mesh(const Instance& instance, std::uint32_t ownId, const PovSurfaceOptions& options);
  /// Declares a mesh with triangles that are shaded as a view sees them; returns the pictures that it uses.
  std::vector<std::string> declareTurned(PovText& text, const std::string& name, const Instance& instance,
    const PovTurned& turned, const PovSurfaceOptions& options);
  PovFile describe(const std::string& name);
  /// Writes a file unless it is there; returns its name <stem>_<hash>.<extension>.
  std::string add(const std::string& stem, const std::string& extension, const std::string& contents);

  using ImageKey = std::tuple<const Image*, double, double, double, bool>;
  /// `make` gives the file's name when the image has none yet.
  template <class Make>
  std::string image(const ImageKey& key, Make make);

private:
  /// A mesh is known by addresses, as long as what stands there lives.
  struct Entry
  {
    std::weak_ptr<const Geometry> geometry;
    std::optional<std::weak_ptr<const std::vector<Material>>> materials; ///< none: the model's
    std::once_flag once;
    PovIncluded included;
  };
  using MeshKey = std::tuple<const Model*, const Geometry*, const std::vector<Material>*, std::uint32_t, bool, double>;
  std::shared_ptr<Entry> entryOf(const Instance& instance, std::uint32_t ownId, bool headLit);
  PovIncluded write(const Instance& instance, std::uint32_t ownId, const PovSurfaceOptions& options);

  std::mutex Mutex;
  std::map<MeshKey, std::shared_ptr<Entry>> Entries;
  std::map<ImageKey, std::string> Images;
  std::map<std::string, PovFile> Written;
};

/// Meshes of a scene that includes them.
class PovMeshesIncluded final : public PovMeshes
{
public:
  PovMeshesIncluded(PovLibrary::Impl& library, const PovSurfaceOptions& options)
    : Library(library)
    , Options(options)
  {
  }
  std::string declare(const Instance& instance, std::uint32_t id, const PovTurned& turned) override;
  const std::vector<std::string>& includes() const { return this->Includes; }
  /// Meshes of this scene alone.
  const std::string& declared() const { return this->Declared.text(); }
  const std::vector<PovFile>& uses() const { return this->Uses; }

private:
  void use(const std::vector<std::string>& files);

  PovLibrary::Impl& Library;
  PovSurfaceOptions Options;
  PovText Declared;
  std::set<std::string> Known;
  std::vector<std::string> Includes;
  std::vector<PovFile> Uses;
};

} // namespace dgtk

#endif
