// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPovMeshes_h
#define dgtkPovMeshes_h

// Private to Export.

#include "dgtkPovExport.h"
#include "dgtkPovImages.h"
#include "dgtkPovText.h"

#include <map>
#include <tuple>

namespace dgtk
{

/// Writes instances; a mesh that several have is declared once.
class PovMeshes
{
public:
  PovMeshes(PovText& text, PovImages& images, const PovOptions& options)
    : Text(text)
    , Images(images)
    , Options(options)
  {
  }
  void add(const Instance& instance, std::uint32_t id);

private:
  using Key = std::tuple<const Model*, const Geometry*, const std::vector<Material>*, std::uint32_t>;

  const std::vector<Material>& materialsOf(const Instance& instance) const;
  std::string declare(const Instance& instance, std::uint32_t id);
  void writeVertices(const Instance& instance);
  std::vector<int> writeTextures(const Instance& instance, std::uint32_t id);
  void writeFaces(const Model& model, const std::vector<int>& textures);

  PovText& Text;
  PovImages& Images;
  PovOptions Options;
  std::map<Key, std::string> Names;
};

} // namespace dgtk

#endif
