// SPDX-License-Identifier: BSD-3-Clause
#include "dgtk3dsChunks.h"
#include "dgtk3dsMotion.h"
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkModelBuilder.h"
#include "dgtkText.h"

#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace dgtk
{

namespace
{
constexpr std::size_t chunkHeader = 6;

struct Chunk
{
  std::uint16_t id = 0;
  std::size_t at = 0;    ///< of its header
  std::size_t begin = 0; ///< of its contents
  std::size_t end = 0;
};

/// A material and how its texture lies on the surface.
struct MappedMaterial
{
  int material = -1;
  Eigen::Vector2d scale{ 1, 1 };
  Eigen::Vector2d offset{ 0, 0 };
  TextureWrap wrap = TextureWrap::Repeat;
  std::set<std::string> unread; ///< what its pictures that are not drawn are for
};

class Reader3ds
{
public:
  Reader3ds(const std::string& path, const std::string& bytes, const ReadOptions& options)
    : In(path, bytes)
    , Builder(path, "3ds", bytes.size(), options)
  {
  }

  ModelContents read()
  {
    const Chunk main = this->chunkAt(0, this->In.size());
    // materials first: objects name them, whatever the order in the file
    this->forEachOfEditors(main, MaterialBlock, [this](const Chunk& c) { this->material(c); });
    this->forEachOfEditors(main, NamedObject, [this](const Chunk& c) { this->namedObject(c); });
    if (!this->HasEditor)
    {
      this->In.fail(main.begin, "no model in the file", "a chunk 3D3D");
    }
    this->report();
    this->Builder.keep({}, ModelContents::worthwhile);
    return this->Builder.finish();
  }

private:
  /// The chunk at `at` inside a parent that ends at `end`; one that is longer than its parent is cut there.
  Chunk chunkAt(std::size_t at, std::size_t end)
  {
    this->In.need(at, chunkHeader, "the header of a chunk");
    const std::uint32_t length = this->In.u32(at + 2);
    if (length < chunkHeader)
    {
      this->In.fail(at, "bad chunk", "a length of at least 6", std::to_string(length));
    }
    this->CutChunks += length > end - at ? 1 : 0;
    return { this->In.u16(at), at, at + chunkHeader, length > end - at ? end : at + length };
  }

  template <typename Function>
  void forEach(std::size_t begin, std::size_t end, Function function)
  {
    // fewer bytes than a header are padding
    for (std::size_t at = begin; at + chunkHeader <= end;)
    {
      const Chunk chunk = this->chunkAt(at, end);
      function(chunk);
      at = chunk.end;
    }
  }

  template <typename Function>
  void forEachOfEditors(const Chunk& main, ChunkId3ds id, Function function)
  {
    this->forEach(main.begin, main.end,
      [&](const Chunk& editor)
      {
        this->HasEditor = this->HasEditor || editor.id == Editor;
        this->forEach(editor.begin, editor.id == Editor ? editor.end : editor.begin,
          [&](const Chunk& c)
          {
            if (c.id == id)
            {
              function(c);
            }
          });
      });
  }

  /// Throws unless `count` bytes of `what` lie in the chunk at `at`.
  void need(const Chunk& chunk, std::size_t at, std::uint64_t count, const char* what)
  {
    if (at > chunk.end || count > chunk.end - at)
    {
      this->In.fail(at, std::string(what) + " are cut short", std::to_string(count) + " bytes",
        std::to_string(at > chunk.end ? 0 : chunk.end - at));
    }
  }

  /// A text that ends with a zero byte; `at` moves behind it.
  std::string text(const Chunk& chunk, std::size_t& at)
  {
    std::size_t length = 0;
    while (at + length < chunk.end && this->In.u8(at + length) != 0)
    {
      ++length;
    }
    std::string out = this->In.text(at, length);
    at += length + 1;
    if (at > chunk.end)
    {
      this->In.fail(chunk.begin, "a name does not end in its chunk");
    }
    return out;
  }

  Eigen::Vector3d color(const Chunk& parent, const Eigen::Vector3d& otherwise)
  {
    Eigen::Vector3d out = otherwise;
    bool done = false;
    this->forEach(parent.begin, parent.end,
      [&](const Chunk& c)
      {
        const bool isFloat = c.id == ColorFloat || c.id == ColorFloatLinear;
        const bool isByte = c.id == ColorByte || c.id == ColorByteLinear;
        if (done || (!isFloat && !isByte))
        {
          return; // the first one is the one that artists see
        }
        done = true;
        this->need(c, c.begin, isFloat ? 12 : 3, "colours");
        for (std::size_t i = 0; i < 3; ++i)
        {
          out[static_cast<Eigen::Index>(i)] =
            isFloat ? double(this->In.f32(c.begin + 4 * i)) : this->In.u8(c.begin + i) / 255.0;
        }
      });
    return out;
  }

  /// In [0, 1].
  double percent(const Chunk& parent, double otherwise)
  {
    double out = otherwise;
    this->forEach(parent.begin, parent.end,
      [&](const Chunk& c)
      {
        if (c.id == PercentInt)
        {
          this->need(c, c.begin, 2, "percentages");
          out = this->In.i16(c.begin) / 100.0;
        }
        else if (c.id == PercentFloat)
        {
          this->need(c, c.begin, 4, "percentages");
          out = double(this->In.f32(c.begin)) / (std::abs(this->In.f32(c.begin)) > 1 ? 100.0 : 1.0);
        }
      });
    return std::isfinite(out) ? out : otherwise;
  }

  double scalar(const Chunk& chunk, double otherwise)
  {
    this->need(chunk, chunk.begin, 4, "texture placements");
    const double value = double(this->In.f32(chunk.begin));
    return std::isfinite(value) ? value : otherwise;
  }

  void material(const Chunk& block)
  {
    Material m;
    MappedMaterial mapped;
    std::string texture;
    MappedMaterial masked;
    std::string mask;
    std::set<std::string> unread;
    double strength = 1;
    double selfIllumination = 0;
    this->forEach(block.begin, block.end,
      [&](const Chunk& c)
      {
        std::size_t at = c.begin;
        switch (c.id)
        {
          case MaterialName:
            m.name = this->text(c, at);
            break;
          case Ambient:
          case Diffuse:
          case Specular:
          {
            Eigen::Vector3d& to = c.id == Ambient ? m.ambient : c.id == Diffuse ? m.diffuse : m.specular;
            to = this->color(c, to);
            break;
          }
          case Shininess:
            m.shininess = 128 * this->percent(c, 0);
            break;
          case ShininessStrength:
            strength = this->percent(c, 1);
            break;
          case Transparency:
            m.opacity = 1 - this->percent(c, 0);
            break;
          case TwoSided:
            m.twoSided = true;
            break;
          case SelfIllumination:
            selfIllumination = this->percent(c, 0);
            break;
          case TextureMap:
            texture = this->textureMap(c, mapped);
            break;
          case OpacityMap:
            mask = this->textureMap(c, masked);
            break;
          default:
            if (unreadMap3ds(c.id) && this->namesPicture(c))
            {
              unread.insert(unreadMap3ds(c.id));
            }
            break;
        }
      });
    m.specular *= strength;
    m.emission = m.diffuse * selfIllumination;
    mapped = texture.empty() ? masked : mapped;
    mapped.unread = unread;
    m.texture = this->Builder.addTexture(texture, {}, {}, { mapped.wrap, mapped.wrap });
    MaterialAlpha alpha;
    alpha.mask =
      mask == texture ? MaterialAlpha::none : this->Builder.addTexture(mask, {}, {}, { masked.wrap, masked.wrap });
    mapped.material = this->Builder.addMaterial(m, alpha);
    ++this->Builder.model().declaredMaterials;
    this->Materials.emplace(m.name, mapped); // of two with one name the first is meant
  }

  bool namesPicture(const Chunk& map)
  {
    bool found = false;
    this->forEach(map.begin, map.end,
      [&](const Chunk& c) { found = found || (c.id == TextureName && c.begin < c.end && this->In.u8(c.begin) != 0); });
    return found;
  }

  std::string textureMap(const Chunk& map, MappedMaterial& mapped)
  {
    std::string name;
    this->forEach(map.begin, map.end,
      [&](const Chunk& c)
      {
        std::size_t at = c.begin;
        if (c.id == TextureName)
        {
          name = this->text(c, at);
        }
        else if (c.id == TextureTiling)
        {
          constexpr unsigned mirrors = 2;
          constexpr unsigned once = 16; // the material's colour around it would be meant
          this->need(c, c.begin, 2, "texture placements");
          const unsigned flags = this->In.u16(c.begin);
          mapped.wrap = (flags & mirrors) != 0 ? TextureWrap::Mirror
                        : (flags & once) != 0  ? TextureWrap::Clamp
                                               : TextureWrap::Repeat;
        }
        else if (c.id == TextureScaleU || c.id == TextureScaleV)
        {
          mapped.scale[c.id == TextureScaleU ? 0 : 1] = this->scalar(c, 1);
        }
        else if (c.id == TextureOffsetU || c.id == TextureOffsetV)
        {
          mapped.offset[c.id == TextureOffsetU ? 0 : 1] = this->scalar(c, 0);
        }
        else if (c.id == TextureAngle)
        {
          this->Turned += this->scalar(c, 0) != 0 ? 1 : 0;
        }
      });
    return name;
  }

  void namedObject(const Chunk& object)
  {
    std::size_t at = object.begin;
    const std::string name = this->text(object, at);
    this->forEach(at, object.end,
      [&](const Chunk& c)
      {
        if (c.id == Mesh)
        {
          this->mesh(c, name);
        }
      });
  }

  /// Number of records of `bytes` at the start of a chunk, all of which lie in it.
  std::size_t counted(const Chunk& chunk, std::size_t bytes, const char* what)
  {
    this->need(chunk, chunk.begin, 2, what);
    const std::size_t count = this->In.u16(chunk.begin);
    this->need(chunk, chunk.begin + 2, std::uint64_t(count) * bytes, what);
    return count;
  }

  /// The lists of a mesh, and where its vertices are in the model.
  struct Mesh3ds
  {
    Chunk vertices;
    Chunk faces;
    Chunk uvs;
    std::size_t vertexCount = 0;
    std::size_t faceCount = 0;
    std::size_t uvCount = 0;
    std::uint32_t first = 0;
    std::vector<const MappedMaterial*> materialOf; ///< of each face, or null
    std::vector<std::uint32_t> groupsOf;
  };

  void mesh(const Chunk& chunk, const std::string& name)
  {
    Mesh3ds mesh;
    this->forEach(chunk.begin, chunk.end,
      [&](const Chunk& c)
      {
        (c.id == Vertices              ? mesh.vertices
          : c.id == Faces              ? mesh.faces
          : c.id == TextureCoordinates ? mesh.uvs
                                       : this->Ignored) = c;
      });
    this->Builder.beginObject(name);
    mesh.vertexCount = mesh.vertices.id ? this->counted(mesh.vertices, 12, "vertices") : 0;
    mesh.faceCount = mesh.faces.id ? this->counted(mesh.faces, 8, "faces") : 0;
    mesh.uvCount = mesh.uvs.id ? this->counted(mesh.uvs, 8, "texture coordinates") : 0;
    this->Builder.reserve(mesh.vertexCount, mesh.faceCount, mesh.faceCount * 3);
    for (std::size_t v = 0; v < mesh.vertexCount; ++v)
    {
      const std::size_t p = mesh.vertices.begin + 2 + 12 * v;
      const std::uint32_t index =
        this->Builder.addVertex({ double(this->In.f32(p)), double(this->In.f32(p + 4)), double(this->In.f32(p + 8)) });
      mesh.first = v == 0 ? index : mesh.first;
    }
    this->faceLists(mesh);
    for (std::size_t f = 0; f < mesh.faceCount; ++f)
    {
      this->face(mesh, f);
    }
    this->Builder.endObject();
  }

  /// What stands behind the faces: their materials and smoothing groups.
  void faceLists(Mesh3ds& mesh)
  {
    mesh.materialOf.assign(mesh.faceCount, nullptr);
    mesh.groupsOf.assign(mesh.faceCount, 0);
    this->forEach(mesh.faces.begin + (mesh.faces.id ? 2 + 8 * mesh.faceCount : 0), mesh.faces.end,
      [&](const Chunk& c)
      {
        if (c.id == FaceMaterial)
        {
          this->faceMaterial(c, mesh.materialOf);
        }
        for (std::size_t f = 0; c.id == SmoothingGroups && f < mesh.faceCount && c.begin + 4 * f + 4 <= c.end; ++f)
        {
          mesh.groupsOf[f] = this->In.u32(c.begin + 4 * f);
        }
      });
  }

  void face(const Mesh3ds& mesh, std::size_t f)
  {
    Corner corners[3];
    const MappedMaterial* mapped = mesh.materialOf[f];
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::size_t index = this->In.u16(mesh.faces.begin + 2 + 8 * f + 2 * i);
      corners[i].vertex = index < mesh.vertexCount ? mesh.first + static_cast<std::uint32_t>(index)
                                                   : std::numeric_limits<std::uint32_t>::max();
      if (index < mesh.uvCount)
      {
        const std::size_t at = mesh.uvs.begin + 2 + 8 * index;
        const Eigen::Vector2d uv(this->In.f32(at), this->In.f32(at + 4));
        const Eigen::Vector2d placed = mapped ? Eigen::Vector2d(uv.cwiseProduct(mapped->scale) + mapped->offset) : uv;
        corners[i].u = static_cast<float>(placed[0]);
        corners[i].v = static_cast<float>(placed[1]);
      }
    }
    SurfaceStyle style;
    style.material = mapped ? mapped->material : this->Builder.defaultMaterial();
    style.shading = mesh.groupsOf[f] != 0 ? Shading::Groups : Shading::Flat;
    style.groups = mesh.groupsOf[f];
    style.twoSided = mapped && this->Builder.model().materials[static_cast<std::size_t>(style.material)].twoSided;
    this->Builder.addSurface(corners, 3, style);
  }

  void faceMaterial(const Chunk& c, std::vector<const MappedMaterial*>& materialOf)
  {
    std::size_t at = c.begin;
    const auto known = this->Materials.find(this->text(c, at));
    this->need(c, at, 2, "the faces of a material");
    const std::size_t count = this->In.u16(at);
    this->need(c, at + 2, std::uint64_t(count) * 2, "the faces of a material");
    this->UnknownMaterials += known == this->Materials.end() ? 1 : 0;
    for (std::size_t i = 0; i < count && known != this->Materials.end(); ++i)
    {
      const std::size_t face = this->In.u16(at + 2 + 2 * i);
      if (face < materialOf.size())
      {
        materialOf[face] = &known->second;
        this->Unread.insert(known->second.unread.begin(), known->second.unread.end());
      }
      else
      {
        ++this->BadFaces;
      }
    }
  }

  void report()
  {
    const auto warn = [this](std::size_t count, const std::string& text)
    {
      if (count > 0)
      {
        this->Builder.warn(std::to_string(count) + text);
      }
    };
    warn(this->CutChunks, " chunk(s) are longer than the chunk or file that they are in");
    warn(this->UnknownMaterials, " list(s) of faces name a material that does not exist");
    warn(this->BadFaces, " entries of materials name a face that does not exist");
    warn(this->Turned, " texture(s) are drawn without the angle that their material says");
    if (!this->Unread.empty())
    {
      this->Builder.warn("pictures of " + joined({ this->Unread.begin(), this->Unread.end() }) + " are not drawn");
    }
    const std::size_t many = countMoving3ds(this->In);
    warn(many, (many == 1 ? " object moves" : " objects move") + std::string(": the motion of 3DS files is not read"));
  }

  ByteReader In;
  ModelBuilder Builder;
  std::map<std::string, MappedMaterial> Materials;
  std::set<std::string> Unread; ///< of materials that faces have
  Chunk Ignored;
  std::size_t CutChunks = 0;
  std::size_t UnknownMaterials = 0;
  std::size_t BadFaces = 0;
  std::size_t Turned = 0;
  bool HasEditor = false;
};
} // namespace

ModelContents read3ds(const std::string& path, const ReadOptions& options);
ModelContents read3ds(const std::string& path, const ReadOptions& options)
{
  const std::string bytes = readFile(path);
  const ByteReader in(path, bytes);
  if (bytes.size() < chunkHeader || in.u16(0) != Main)
  {
    throw InputError(path, "is not a 3DS file", "a chunk 4D4D at its start");
  }
  return Reader3ds(path, bytes, options).read();
}

} // namespace dgtk
