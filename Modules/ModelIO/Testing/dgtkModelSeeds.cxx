// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelSeeds.h"

#include <cstring>

namespace dgtk::test
{

std::string ac3dSeed()
{
  return "AC3Db\n"
         "MATERIAL \"red paint\" rgb 1 0.25 0  amb 0.2 0.2 0.2  emis 0 0.1 0  spec 0.5 0.5 0.5  shi 64  trans 0.25\n"
         "MATERIAL \"\" rgb 0 0 1  amb 0 0 0  emis 0 0 0  spec 0 0 0  shi 0  trans 0\n"
         "OBJECT world\n"
         "kids 2\n"
         "OBJECT group\n"
         "name \"all\"\n"
         "data 5\n"
         "a b\nc\n"
         "loc 1 0 0\n"
         "rot 1 0 0 0 1 0 0 0 1\n"
         "kids 2\n"
         "OBJECT poly\n"
         "name \"roof\"\n"
         "texture \"tiles.png\" base\n"
         "texture \"shadow.png\" shad\n"
         "texrep 2 3\n"
         "texoff 0.5 0\n"
         "crease 45\n"
         "numvert 5\n"
         "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0.5 0.5 -1\n"
         "numsurf 4\n"
         "SURF 0x30\nmat 0\nrefs 4\n0 0 0\n1 1 0\n2 1 1\n3 0 1\n"
         "SURF 0x10\nmat 1\nrefs 3\n0 0 0\n4 0.5 0.5\n1 1 0\n"
         "SURF 0x21\nmat 1\nrefs 3\n0 0 0\n1 0 0\n2 0 0\n"
         "SURF 0x02\nmat 1\nrefs 2\n3 0 0\n4 0 0\n"
         "kids 0\n"
         "OBJECT poly\n"
         "numvert 4\n"
         "0 0 1 0 0 1\n1 0 1 0 0 1\n0 1 1 0 0 1\n1 1 1 0 0 1\n"
         "numsurf 1\n"
         "SURF 0x24\nmat 1\nrefs 4\n0 0 0 9 9\n1 1 0 9 9\n2 0 1 9 9\n3 1 1 9 9\n"
         "kids 0\n"
         "OBJECT light\nloc 0 5 0\nkids 0\n";
}

std::string u16(unsigned value) { return { static_cast<char>(value & 255), static_cast<char>((value >> 8) & 255) }; }

std::string u32(unsigned long value)
{
  return u16(static_cast<unsigned>(value & 0xffff)) + u16(static_cast<unsigned>((value >> 16) & 0xffff));
}

std::string f32(float value)
{
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return u32(bits);
}

std::string Md2File::bytes() const
{
  const auto fixed = [](std::string text, std::size_t length)
  {
    text.resize(length, '\0');
    return text;
  };
  std::string skinBlock;
  for (const std::string& skin : this->skins)
  {
    skinBlock += fixed(skin, 64);
  }
  std::string stBlock;
  for (const std::int16_t value : this->sts)
  {
    stBlock += u16(static_cast<std::uint16_t>(value));
  }
  std::string triangleBlock;
  for (const std::uint16_t value : this->triangles)
  {
    triangleBlock += u16(value);
  }
  std::string frameBlock;
  for (const Frame& frame : this->frames)
  {
    for (const float value : frame.scale)
    {
      frameBlock += f32(value);
    }
    for (const float value : frame.translate)
    {
      frameBlock += f32(value);
    }
    frameBlock += fixed(frame.name, 16);
    for (std::size_t i = 0; i < frame.coordinates.size(); i += 3)
    {
      frameBlock.append(reinterpret_cast<const char*>(&frame.coordinates[i]), 3);
      frameBlock += '\xff'; // a normal index that does not exist
    }
  }
  const std::size_t frameCount = this->frames.size();
  const std::size_t vertices = frameCount ? this->frames[0].coordinates.size() / 3 : 0;
  const std::size_t skinsAt = 68;
  const std::size_t stsAt = skinsAt + skinBlock.size();
  const std::size_t trianglesAt = stsAt + stBlock.size();
  const std::size_t framesAt = trianglesAt + triangleBlock.size();
  const std::size_t end = framesAt + frameBlock.size();
  std::string out = "IDP2" + u32(8) + u32(static_cast<std::uint32_t>(this->skinWidth)) +
                    u32(static_cast<std::uint32_t>(this->skinHeight)) + u32(40 + 4 * vertices) +
                    u32(this->skins.size()) + u32(vertices) + u32(this->sts.size() / 2) +
                    u32(this->triangles.size() / 6) + u32(0) + u32(frameCount) + u32(skinsAt) + u32(stsAt) +
                    u32(trianglesAt) + u32(framesAt) + u32(end) + u32(end);
  return out + skinBlock + stBlock + triangleBlock + frameBlock;
}

Md2File md2Seed()
{
  Md2File file;
  file.skins = { "models/thing/skin.pcx", ".other" };
  file.sts = { 0, 0, 64, 0, 0, 32, -16, 48 };
  // clockwise from outside
  file.triangles = { 0, 1, 2, 0, 1, 2, 0, 3, 1, 0, 3, 1, 0, 2, 3, 0, 2, 3, 1, 3, 2, 1, 3, 2 };
  for (const char* name : { "stand01", "stand02", "pain101", "pain102" })
  {
    Md2File::Frame frame;
    frame.name = name;
    frame.translate[2] = static_cast<float>(file.frames.size());
    frame.coordinates = { 0, 0, 0, 10, 0, 0, 0, 10, 0, 0, 0, 10 };
    file.frames.push_back(frame);
  }
  return file;
}

std::string chunk3ds(std::uint16_t id, const std::string& contents)
{
  return u16(id) + u32(6 + contents.size()) + contents;
}

namespace
{
std::string text(const std::string& value) { return value + std::string(1, '\0'); }

std::string color(std::uint16_t id, unsigned char r, unsigned char g, unsigned char b)
{
  return chunk3ds(id, chunk3ds(0x0011, { static_cast<char>(r), static_cast<char>(g), static_cast<char>(b) }));
}

std::string percent(std::uint16_t id, unsigned value) { return chunk3ds(id, chunk3ds(0x0030, u16(value))); }

std::string floats(const std::vector<float>& values)
{
  std::string out;
  for (const float value : values)
  {
    out += f32(value);
  }
  return out;
}

std::string faces(const std::vector<unsigned>& indices)
{
  std::string out = u16(static_cast<unsigned>(indices.size() / 3));
  for (std::size_t i = 0; i < indices.size(); ++i)
  {
    out += u16(indices[i]) + (i % 3 == 2 ? u16(7) : "");
  }
  return out;
}
} // namespace

std::string seed3ds()
{
  const std::string texture = percent(0x0030, 100) + chunk3ds(0xa300, text("WALL.TGA"));
  const std::string wall =
    chunk3ds(0xafff, chunk3ds(0xa000, text("wall")) + color(0xa010, 10, 20, 30) + color(0xa020, 255, 128, 0) +
                       color(0xa030, 255, 255, 255) + percent(0xa040, 50) + percent(0xa041, 40) + percent(0xa050, 25) +
                       chunk3ds(0xa081, "") + chunk3ds(0xa200, texture));
  const std::string plain = chunk3ds(0xafff, chunk3ds(0xa000, text("plain")) + color(0xa020, 0, 255, 0));
  const std::string quad = chunk3ds(0x4100,
    chunk3ds(0x4110, u16(5) + floats({ 0, 0, 0, 2, 0, 0, 2, 1, 0, 0, 1, 0, 0, 0, 2e35f })) +
      chunk3ds(0x4140, u16(4) + floats({ 0, 0, 1, 0, 1, 1, 0, 1 })) +
      chunk3ds(0x4120, faces({ 0, 1, 2, 0, 2, 3 }) + chunk3ds(0x4130, text("wall") + u16(2) + u16(0) + u16(1))));
  const std::string solid = chunk3ds(0x4100, chunk3ds(0x4110, u16(4) + floats({ 0, 0, 5, 1, 0, 5, 0, 1, 5, 0, 0, 6 })) +
                                               chunk3ds(0x4120, faces({ 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3 }) +
                                                                  chunk3ds(0x4130, text("plain") + u16(1) + u16(3)) +
                                                                  chunk3ds(0x4150, u32(1) + u32(1) + u32(2) + u32(3))));
  return chunk3ds(0x4d4d,
    chunk3ds(0x0002, u32(3)) +
      chunk3ds(0x3d3d, chunk3ds(0x4000, text("quad") + quad) + wall + plain + chunk3ds(0x4000, text("solid") + solid)) +
      chunk3ds(0xb000, chunk3ds(0xb008, u32(0) + u32(10))));
}

} // namespace dgtk::test
