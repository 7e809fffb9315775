// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelEntry.h"

#include "dgtkAssimpDeformation.h"
#include "dgtkFile.h"
#include "dgtkStream.h"

#include <algorithm>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace dgtk
{

template <class T, int N>
struct IsPlain<Eigen::Matrix<T, N, 1>> : IsPlain<T>
{
};

namespace
{
constexpr std::uint32_t magic = 0x4d474b44; // "DKGM"
constexpr std::size_t largePiece = std::size_t(1) << 16;

/// XXH3 of what goes by.
class Checksum
{
public:
  Checksum()
    : State(XXH3_createState())
  {
    XXH3_64bits_reset(this->State);
  }
  ~Checksum() { XXH3_freeState(this->State); }
  Checksum(const Checksum&) = delete;
  Checksum& operator=(const Checksum&) = delete;

  void add(const void* data, std::size_t bytes) { XXH3_64bits_update(this->State, data, bytes); }
  std::uint64_t value() const { return XXH3_64bits_digest(this->State); }

private:
  XXH3_state_t* State;
};

/// What stands before and behind the values of a file.
struct Frame
{
  std::uint64_t magic = dgtk::magic;
  std::uint64_t bytes = 0; ///< of the values
  std::uint64_t checksum = 0;
};

/// Small pieces are written together.
class Output
{
public:
  explicit Output(const std::string& path)
    : File(path)
  {
    this->File.write(&this->Head, sizeof this->Head);
  }
  void operator()(const void* data, std::size_t bytes)
  {
    this->Head.bytes += bytes;
    this->Sum.add(data, bytes);
    if (bytes < largePiece)
    {
      this->Small.append(static_cast<const char*>(data), bytes);
    }
    if (bytes >= largePiece || this->Small.size() >= largePiece)
    {
      this->flush();
    }
    if (bytes >= largePiece)
    {
      this->File.write(data, bytes);
    }
  }
  void commit()
  {
    this->flush();
    this->Head.checksum = this->Sum.value();
    this->File.writeAt(0, &this->Head, sizeof this->Head);
    this->File.commit();
  }

private:
  void flush()
  {
    this->File.write(this->Small);
    this->Small.clear();
  }
  AtomicFile File;
  Frame Head;
  Checksum Sum;
  std::string Small;
};

/// Throws std::runtime_error.
class Input
{
public:
  explicit Input(const std::string& path)
    : File(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK))
  {
    struct stat status = {};
    const bool isFile = this->File && ::fstat(this->File.number(), &status) == 0 && S_ISREG(status.st_mode);
    if (isFile && std::uint64_t(status.st_size) >= sizeof this->Head)
    {
      this->read(&this->Head, sizeof this->Head);
      this->Left = std::uint64_t(status.st_size) - sizeof this->Head;
      this->IsWhole = this->Head.magic == magic && this->Head.bytes == this->Left;
    }
  }
  bool isWhole() const { return this->IsWhole; }
  std::uint64_t bytes() const { return this->Head.bytes; }
  void operator()(void* to, std::size_t bytes)
  {
    auto* at = static_cast<char*>(to);
    const std::size_t buffered = std::min(bytes, this->Small.size() - this->Used);
    std::copy_n(this->Small.data() + this->Used, buffered, at);
    this->Used += buffered;
    const std::size_t rest = bytes - buffered;
    if (rest >= largePiece)
    {
      this->read(at + buffered, rest);
    }
    else if (rest > 0)
    {
      this->Small.resize(static_cast<std::size_t>(std::min<std::uint64_t>(largePiece, this->Left)));
      this->read(this->Small.data(), this->Small.size());
      std::copy_n(this->Small.data(), rest, at + buffered);
      this->Used = rest;
    }
    this->Sum.add(to, bytes);
  }
  bool isAsWritten() const { return this->Sum.value() == this->Head.checksum; }

private:
  void read(void* to, std::size_t bytes)
  {
    auto* at = static_cast<char*>(to);
    this->Left -= bytes;
    while (bytes > 0)
    {
      const ssize_t got = ::read(this->File.number(), at, bytes);
      if (got <= 0)
      {
        throw std::runtime_error("end");
      }
      at += got;
      bytes -= static_cast<std::size_t>(got);
    }
  }
  FileDescriptor File;
  Frame Head;
  Checksum Sum;
  bool IsWhole = false;
  std::uint64_t Left = 0; ///< of the file
  std::string Small;
  std::size_t Used = 0; ///< of Small
};
} // namespace

template <class A>
void io(A& a, ModelPicture& p)
{
  a(p.name), a(p.alternative), a(p.unescaped), a(p.type), a(p.width), a(p.height), a(p.bytes);
  a(p.same), a(p.wrap);
}
template <class A>
void io(A& a, MaterialAlpha& m)
{
  a(m.use), a(m.cutOff), a(m.mask), a(m.value), a(m.inverse);
}
template <class A>
void io(A& a, ModelNote& n)
{
  a(n.text), a(n.picture);
}
template <class A>
void io(A& a, ModelDependency& d)
{
  a(d.kind), a(d.name), a(d.found);
}
template <class A>
void io(A& a, Material& m)
{
  a(m.name), a(m.ambient), a(m.diffuse), a(m.specular), a(m.emission), a(m.shininess), a(m.opacity), a(m.twoSided);
  a(m.texture), a(m.cutOut);
  bool physical = m.physical.has_value();
  Material::Physical values = m.physical.value_or(Material::Physical());
  a(physical), a(values.metallic), a(values.roughness), a(values.wanted);
  m.physical = physical ? std::make_optional(values) : std::nullopt;
  a(m.normalMap), a(m.bumpMap), a(m.metallicRoughnessMap), a(m.emissionMap), a(m.occlusionMap);
  a(m.normalScale), a(m.bumpScale), a(m.occlusionStrength), a(m.isBare), a(m.isDark);
}
template <class A>
void io(A& a, Part& p)
{
  a(p.name), a(p.material), a(p.firstTriangle), a(p.triangles);
}
template <class A>
void io(A& a, Animation& n)
{
  a(n.name), a(n.first), a(n.last), a(n.fps), a(n.beside), a(n.length);
}
template <class A>
void io(A& a, Geometry& g)
{
  a(g.positions), a(g.normals);
}

namespace
{
template <class A>
void motion(A& a, Model& m)
{
  std::string bytes = A::isReader || !m.deformation ? std::string() : m.deformation->saved();
  a(bytes);
  if (A::isReader && !bytes.empty())
  {
    m.deformation = AssimpDeformation::restored(bytes);
  }
}
} // namespace

template <class A>
void io(A& a, Model& m)
{
  a(m.format), a(m.materials), a(m.parts), a(m.triangles);
  auto rest = A::isReader ? std::make_shared<Geometry>() : std::const_pointer_cast<Geometry>(m.rest);
  a(*rest);
  m.rest = rest;
  a(m.uvs), a(m.unplaced), a(m.colors), a(m.sourceVertex), a(m.sourceVertices), a(m.sourceOf), a(m.isNumbered);
  a(m.normalGroup), a(m.animations), a(m.frames);
  motion(a, m);
  a(m.lines), a(m.declaredTriangles), a(m.twoSidedTriangles), a(m.twoSidedSurfaces), a(m.declaredMaterials);
  a(m.boundsMin), a(m.boundsMax);
}
template <class A>
void io(A& a, ModelEntry& e)
{
  a(*e.contents.model);
  a(e.contents.pictures), a(e.contents.alpha), a(e.contents.notes), a(e.contents.moreNotes);
  a(e.contents.dependencies), a(e.contents.keptFrom), a(e.identities);
}

namespace
{
template <class Index>
bool allBelow(const std::vector<Index>& indices, std::size_t end)
{
  return std::all_of(indices.begin(), indices.end(), [end](Index i) { return i < end; });
}

bool hasParts(const Model& m)
{
  std::uint64_t next = 0;
  bool good = true;
  for (const Part& part : m.parts)
  {
    good = good && part.firstTriangle == next && std::size_t(part.material) < m.materials.size();
    next += part.triangles;
  }
  return good && next == m.triangles.size();
}

bool hasGeometry(const Model& m)
{
  const std::size_t vertices = m.rest->positions.size();
  const bool sizes = m.rest->normals.size() == vertices && (m.uvs.empty() || m.uvs.size() == vertices) &&
                     (m.unplaced.empty() || m.unplaced.size() == m.triangles.size()) &&
                     (m.colors.empty() || m.colors.size() == vertices) && m.sourceVertex.size() == vertices &&
                     (m.normalGroup.empty() || m.normalGroup.size() == vertices);
  const auto inside = [vertices](const std::array<std::uint32_t, 3>& t)
  { return t[0] < vertices && t[1] < vertices && t[2] < vertices; };
  return sizes && allBelow(m.sourceVertex, m.sourceVertices) && allBelow(m.sourceOf, m.sourceVertices) &&
         allBelow(m.normalGroup, vertices) && std::all_of(m.triangles.begin(), m.triangles.end(), inside);
}

bool hasMaterials(const ModelContents& contents)
{
  const auto pictures = static_cast<int>(contents.pictures.size());
  const auto known = [pictures](int index) { return index >= -1 && index < pictures; };
  bool good = contents.alpha.size() == contents.model->materials.size();
  for (const MaterialAlpha& alpha : contents.alpha)
  {
    good = good && known(alpha.mask) && alpha.use >= AlphaUse{} && alpha.use <= AlphaUse::Nothing &&
           alpha.value >= MaskValue{} && alpha.value <= MaskValue::Usual;
  }
  for (const Material& m : contents.model->materials)
  {
    for (const auto texture : materialTextures)
    {
      good = good && known(m.*texture);
    }
  }
  for (int i = 0; i < pictures; ++i)
  {
    const ModelPicture& picture = contents.pictures[std::size_t(i)];
    const auto isWrap = [](TextureWrap wrap) { return wrap <= TextureWrap::Mirror; };
    good = good && picture.same >= ModelPicture::own && picture.same < i && isWrap(picture.wrap[0]) &&
           isWrap(picture.wrap[1]);
  }
  for (const ModelNote& note : contents.notes)
  {
    good = good && note.picture >= ModelNote::ofDecoding && note.picture < pictures;
  }
  return good;
}

/// Every index is within its list.
bool isSound(const ModelEntry& entry)
{
  const ModelContents& contents = entry.contents;
  return entry.identities.size() == contents.dependencies.size() && hasParts(*contents.model) &&
         hasGeometry(*contents.model) && hasMaterials(contents);
}
} // namespace

void writeModelEntry(const std::string& path, ModelEntry& entry)
{
  Output output(path);
  StreamWriter<Output&> writer(output);
  writer(entry);
  output.commit();
}

bool readModelEntry(const std::string& path, ModelEntry& entry)
{
  try
  {
    Input input(path);
    if (!input.isWhole())
    {
      return false;
    }
    entry.contents.model = std::make_shared<Model>();
    StreamReader<Input&> reader(input, input.bytes());
    reader(entry);
    return input.isAsWritten() && isSound(entry);
  }
  catch (const std::runtime_error&)
  {
    return false;
  }
}

} // namespace dgtk
