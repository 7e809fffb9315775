// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkByteReader.h"
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkMd2Sequences.h"
#include "dgtkModelBuilder.h"
#include "dgtkTextLines.h"
#include "dgtkTextureFile.h"
#include "dgtkVertexDeformation.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace dgtk
{

namespace
{
constexpr std::size_t md2Header = 68;
constexpr std::size_t skinBytes = 64;
constexpr std::size_t stBytes = 4;
constexpr std::size_t triangleBytes = 12;
constexpr std::size_t frameHeadBytes = 40; ///< scale, translation, name
constexpr std::uint32_t mostTriangles = 131072;

/// The 17 numbers at the start, after magic and version.
struct Header
{
  std::int32_t skinWidth, skinHeight, frameSize, skins, vertices, sts, triangles, commands, frames, skinsAt, stsAt,
    trianglesAt, framesAt, commandsAt, end;
};

/// Positions as in the file: a byte a coordinate, scaled and moved frame by frame.
class Md2Frames : public VertexDeformation
{
public:
  struct Frame
  {
    Eigen::Vector3d scale;
    Eigen::Vector3d translate;
  };
  std::vector<Frame> Frames;
  std::vector<std::uint8_t> Coordinates; ///< frame by frame, vertex by vertex, x y z
  std::size_t Vertices = 0;
  std::vector<Animation> Animations;

  Eigen::Vector3d position(std::size_t frame, std::size_t vertex) const
  {
    const std::uint8_t* c = &this->Coordinates[(frame * this->Vertices + vertex) * 3];
    const Frame& f = this->Frames[frame];
    return { c[0] * f.scale[0] + f.translate[0], c[1] * f.scale[1] + f.translate[1],
      c[2] * f.scale[2] + f.translate[2] };
  }

  void positionsAt(int animation, double frame, std::vector<Eigen::Vector3d>& out) const override
  {
    const Moment moment = this->momentOf(animation, frame);
    out.resize(this->Vertices);
    for (std::size_t v = 0; v < this->Vertices; ++v)
    {
      out[v] = this->blended(moment, v);
    }
  }
  Eigen::Vector3d positionAt(int animation, double frame, std::uint32_t vertex) const override
  {
    return this->blended(this->momentOf(animation, frame), vertex);
  }

private:
  /// Between a frame and the next.
  struct Moment
  {
    std::size_t frame;
    double weight;
  };

  Moment momentOf(int animation, double frame) const
  {
    double first = 0;
    double last = static_cast<double>(this->Frames.size()) - 1;
    if (animation >= 0 && static_cast<std::size_t>(animation) < this->Animations.size())
    {
      first = this->Animations[static_cast<std::size_t>(animation)].first;
      last = this->Animations[static_cast<std::size_t>(animation)].last;
    }
    const double at = std::isnan(frame) ? first : std::min(std::max(frame, first), last);
    const double lower = std::floor(at);
    return { static_cast<std::size_t>(lower), at - lower };
  }

  Eigen::Vector3d blended(const Moment& moment, std::size_t vertex) const
  {
    Eigen::Vector3d x = this->position(moment.frame, vertex);
    if (moment.weight > 0)
    {
      x = (1 - moment.weight) * x + moment.weight * this->position(moment.frame + 1, vertex);
    }
    return x;
  }
};

std::size_t index(std::int32_t value) { return static_cast<std::size_t>(value); }

/// A block of `count` records of `bytes` at `offset` lies in the file; an empty one may be anywhere.
void checkBlock(const ByteReader& in, std::int32_t offset, std::int32_t count, std::size_t bytes, const char* what)
{
  if (count < 0)
  {
    in.fail(0, std::string("bad number of ") + what + " in the header", "0 or more", std::to_string(count));
  }
  if (count > 0)
  {
    if (offset < static_cast<std::int32_t>(md2Header))
    {
      in.fail(0, std::string("bad offset of ") + what + " in the header", "68 or more", std::to_string(offset));
    }
    in.need(index(offset), std::uint64_t(index(count)) * bytes, what);
  }
}

Header readHeader(const ByteReader& in, const std::string& path)
{
  if (in.size() < 8 || in.text(0, 4) != "IDP2")
  {
    throw InputError(
      path, "is not an MD2 file", "'IDP2' at its start", in.size() < 4 ? "a shorter file" : quoted(in.text(0, 4)));
  }
  if (in.i32(4) != 8)
  {
    throw InputError(path, "is an MD2 file of another version", "8", std::to_string(in.i32(4)));
  }
  in.need(0, md2Header, "the header");
  const auto field = [&in](std::size_t i) { return in.i32(8 + 4 * i); };
  const Header h = { field(0), field(1), field(2), field(3), field(4), field(5), field(6), field(7), field(8), field(9),
    field(10), field(11), field(12), field(13), field(14) };
  checkBlock(in, h.skinsAt, h.skins, skinBytes, "skins");
  checkBlock(in, h.stsAt, h.sts, stBytes, "texture coordinates");
  checkBlock(in, h.trianglesAt, h.triangles, triangleBytes, "triangles");
  if (h.vertices < 0 || h.vertices > 65536)
  {
    in.fail(0, "bad number of vertices in the header", "0 to 65536", std::to_string(h.vertices));
  }
  if (std::uint32_t(h.triangles) > mostTriangles)
  {
    in.fail(0, "too many triangles", "at most " + std::to_string(mostTriangles), std::to_string(h.triangles));
  }
  const std::size_t frameBytes = frameHeadBytes + 4 * index(h.vertices);
  if (h.frames < 1 || h.frameSize < 0 || index(h.frameSize) < frameBytes)
  {
    in.fail(0, "bad frames in the header", "at least one, of at least " + std::to_string(frameBytes) + " bytes",
      std::to_string(h.frames) + " of " + std::to_string(h.frameSize));
  }
  checkBlock(in, h.framesAt, h.frames, index(h.frameSize), "frames");
  return h;
}

std::shared_ptr<Md2Frames> readFrames(const ByteReader& in, const Header& h, std::vector<std::string>& names)
{
  auto frames = std::make_shared<Md2Frames>();
  frames->Vertices = index(h.vertices);
  frames->Frames.reserve(index(h.frames));
  frames->Coordinates.resize(index(h.frames) * frames->Vertices * 3);
  std::uint8_t* to = frames->Coordinates.data();
  for (std::size_t f = 0; f < index(h.frames); ++f)
  {
    const std::size_t at = index(h.framesAt) + f * index(h.frameSize);
    float numbers[6];
    for (std::size_t i = 0; i < 6; ++i)
    {
      numbers[i] = in.f32(at + 4 * i);
      // a vertex is at most 255 scales away; beyond this single precision overflows
      if (!(std::abs(numbers[i]) < 1e36f))
      {
        in.fail(at + 4 * i, "a frame's scale or translation is not a usable number");
      }
    }
    frames->Frames.push_back({ { numbers[0], numbers[1], numbers[2] }, { numbers[3], numbers[4], numbers[5] } });
    names.push_back(in.text(at + 24, 16));
    for (std::size_t v = 0; v < frames->Vertices; ++v)
    {
      for (std::size_t c = 0; c < 3; ++c)
      {
        *to++ = in.u8(at + frameHeadBytes + 4 * v + c);
      }
    }
  }
  return frames;
}

/// Variants of one picture; the first is the default. Without one that is found, a picture named like the model.
int readSkins(
  const ByteReader& in, const Header& h, const std::string& path, const ReadOptions& options, ModelBuilder& builder)
{
  TextureFinder finder(path, options.sceneFolder);
  const std::string stem = std::filesystem::path(path).stem().string();
  int skin = -1;
  bool found = false; ///< some skin so far
  for (std::size_t s = 0; s < index(h.skins); ++s)
  {
    const std::string name = in.text(index(h.skinsAt) + s * skinBytes, skinBytes);
    const std::string alternative = s == 0 ? stem : "";
    const int texture = builder.addTexture(name, alternative);
    const bool isFound =
      texture >= 0 && !(finder.find(name).empty() && (alternative.empty() || finder.find(alternative).empty()));
    skin = skin < 0 || (!found && isFound) ? texture : skin;
    found = found || isFound;
  }
  if (h.skins == 0 && !locateTexture(path, stem).empty())
  {
    skin = builder.addTexture(stem);
  }
  return skin;
}

void readTriangles(const ByteReader& in, const Header& h, const Md2Frames& frames, int material, ModelBuilder& builder)
{
  builder.beginObject("");
  builder.reserve(frames.Vertices, index(h.triangles), index(h.triangles) * 3);
  for (std::size_t v = 0; v < frames.Vertices; ++v)
  {
    builder.addVertex(frames.position(0, v));
  }
  SurfaceStyle style;
  style.material = material;
  style.shading = Shading::Area;
  std::size_t withoutUv = 0;
  const bool hasSkinSize = h.skinWidth > 0 && h.skinHeight > 0;
  for (std::size_t t = 0; t < index(h.triangles); ++t)
  {
    const std::size_t at = index(h.trianglesAt) + t * triangleBytes;
    Corner corners[3];
    for (std::size_t i = 0; i < 3; ++i)
    {
      Corner& corner = corners[2 - i]; // clockwise in the file
      corner.vertex = in.u16(at + 2 * i);
      const std::uint16_t st = in.u16(at + 6 + 2 * i);
      if (hasSkinSize && st < h.sts)
      {
        const std::size_t stAt = index(h.stsAt) + st * stBytes;
        corner.u = static_cast<float>(double(in.i16(stAt)) / h.skinWidth);
        corner.v = static_cast<float>(1 - double(in.i16(stAt + 2)) / h.skinHeight);
      }
      else
      {
        ++withoutUv;
      }
    }
    builder.addSurface(corners, 3, style);
  }
  builder.endObject();
  if (withoutUv > 0)
  {
    builder.warn(std::to_string(withoutUv) + " corner(s) without texture coordinates: " +
                 (hasSkinSize ? "bad indices"
                              : "the header's skin size is " + std::to_string(h.skinWidth) + " x " +
                                  std::to_string(h.skinHeight)));
  }
}

/// Animations of the text file of the same name, if there is one.
void addAnm(const std::string& path, int frames, std::vector<Animation>& animations, ModelBuilder& builder)
{
  const std::string anm = std::filesystem::path(path).replace_extension(".anm").string();
  std::error_code code;
  if (!std::filesystem::is_regular_file(anm, code))
  {
    return;
  }
  builder.model().companions.push_back(anm);
  std::vector<std::string> warnings;
  for (Animation& named : parseAnm(toUtf8(readFile(anm, std::uint64_t(1) << 20)), anm, frames, warnings))
  {
    named.beside = true;
    animations.push_back(std::move(named));
  }
  for (const std::string& warning : warnings)
  {
    builder.warn(warning);
  }
}
} // namespace

ModelContents readMd2(const std::string& path, const ReadOptions& options);
ModelContents readMd2(const std::string& path, const ReadOptions& options)
{
  const std::string bytes = readFile(path, std::uint64_t(1) << 30);
  const ByteReader in(path, bytes);
  const Header h = readHeader(in, path);
  std::vector<std::string> names;
  const std::shared_ptr<Md2Frames> frames = readFrames(in, h, names);

  ModelBuilder builder(path, "md2", bytes.size(), options);
  Material material;
  material.name = "skin";
  material.texture = readSkins(in, h, path, options, builder);
  if (material.texture >= 0)
  {
    material.ambient = material.diffuse = Eigen::Vector3d(1, 1, 1);
  }
  readTriangles(in, h, *frames, builder.addMaterial(material), builder);

  Model& model = builder.model();
  model.frames = h.frames;
  model.animations = sequencesOf(names);
  addAnm(path, h.frames, model.animations, builder);
  frames->Animations = model.animations;
  model.declaredMaterials = 1;
  if (h.frames > 1)
  {
    builder.setDeformation(frames);
  }
  return builder.finish();
}

} // namespace dgtk
