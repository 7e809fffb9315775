// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkMd2Sequences.h"
#include "dgtkModelChecks.h"
#include "dgtkModelSeeds.h"
#include "dgtkTestSupport.h"
#include "dgtkVertexDeformation.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

using dgtk::Model;
using dgtk::test::md2Seed;
using dgtk::test::readBytes;
using dgtk::test::refusal;
using testing::ElementsAre;
using testing::HasSubstr;

namespace
{
std::shared_ptr<const Model> seed() { return readBytes("md2", md2Seed().bytes()); }

std::vector<std::string> described(const std::vector<dgtk::Animation>& animations)
{
  std::vector<std::string> out;
  out.reserve(animations.size());
  for (const dgtk::Animation& a : animations)
  {
    out.push_back(a.name + " " + std::to_string(a.first) + "-" + std::to_string(a.last));
  }
  return out;
}

std::string refusedWith(std::size_t offset, long value)
{
  std::string bytes = md2Seed().bytes();
  bytes.replace(offset, 4, dgtk::test::u32(static_cast<unsigned long>(value) & 0xffffffffu));
  return refusal("md2", bytes);
}
} // namespace

TEST(Md2, WindingIsCounterClockwise)
{
  const std::shared_ptr<const Model> model = seed();
  ASSERT_EQ(model->triangles.size(), 4u);
  const auto& p = model->rest->positions;
  double volume = 0; // of the tetrahedron, positive when its faces look outwards
  for (const auto& t : model->triangles)
  {
    volume += p[t[0]].dot(p[t[1]].cross(p[t[2]])) / 6;
  }
  EXPECT_NEAR(volume, 1000.0 / 6, 1e-9);
  for (std::size_t v = 0; v < p.size(); ++v)
  {
    EXPECT_GT(model->rest->normals[v].cast<double>().dot(p[v] - Eigen::Vector3d(2.5, 2.5, 2.5)), 0);
  }
}

TEST(Md2, TextureCoordinatesAreSigned)
{
  const std::shared_ptr<const Model> model = seed();
  for (std::size_t v = 0; v < model->uvs.size(); ++v)
  {
    const Eigen::Vector2d expected[] = { { 0, 1 }, { 1, 1 }, { 0, 0 }, { -0.25, -0.5 } };
    EXPECT_EQ(model->uvs[v], expected[model->sourceVertex[v]]);
  }
}

TEST(Md2, PositionsAreInterpolatedWithinTheSequence)
{
  const std::shared_ptr<const Model> model = seed();
  EXPECT_EQ(model->frames, 4);
  ASSERT_THAT(described(model->animations), ElementsAre("stand 0-1", "pain1 2-3"));
  EXPECT_EQ(model->animations[0].fps, 10);
  const auto* const single = dynamic_cast<const dgtk::VertexDeformation*>(model->deformation.get());
  ASSERT_NE(single, nullptr);
  std::vector<Eigen::Vector3d> p;
  const auto height = [&](int animation, double frame)
  {
    model->deformation->positionsAt(animation, frame, p);
    for (std::uint32_t v = 0; v < p.size(); ++v)
    {
      EXPECT_EQ(single->positionAt(animation, frame, v), p[v]);
    }
    return p[0].z();
  };
  EXPECT_EQ(height(0, 0), 0);
  EXPECT_EQ(height(0, 0.25), 0.25);
  EXPECT_EQ(height(0, 1), 1);
  EXPECT_EQ(height(0, 1.5), 1) << "clamped to the sequence";
  EXPECT_EQ(height(0, -3), 0);
  EXPECT_EQ(height(1, 0), 2);
  EXPECT_EQ(height(1, 2.5), 2.5);
  EXPECT_EQ(height(1, 1e300), 3);
  EXPECT_EQ(height(0, std::nan("")), 0);
  EXPECT_EQ(height(99, 2.5), 2.5) << "no such animation: all frames";
  EXPECT_EQ(p.size(), model->sourceVertices);
}

TEST(Md2, GeometryFollowsTheFrame)
{
  const std::shared_ptr<const Model> model = seed();
  const auto still = dgtk::geometryAt(*model, 0, 0);
  EXPECT_EQ(still->positions, model->rest->positions);
  EXPECT_EQ(still->normals, model->rest->normals);
  const auto moved = dgtk::geometryAt(*model, 0, 0.5);
  for (std::size_t v = 0; v < moved->positions.size(); ++v)
  {
    EXPECT_EQ(moved->positions[v], Eigen::Vector3d(model->rest->positions[v] + Eigen::Vector3d(0, 0, 0.5)));
    EXPECT_LT((moved->normals[v] - model->rest->normals[v]).norm(), 1e-6f) << "a translation turns no normal";
  }
}

TEST(Md2, ASeamOfTheTextureDoesNotShow)
{
  dgtk::test::Md2File file = md2Seed();
  file.triangles[3] = 3; // another texture coordinate at vertex 0 of the first triangle
  const std::shared_ptr<const Model> model = readBytes("md2", file.bytes());
  EXPECT_EQ(model->rest->positions.size(), 5u);
  EXPECT_EQ(model->sourceVertices, 4u);
  for (std::size_t a = 0; a < 5; ++a)
  {
    for (std::size_t b = 0; b < 5; ++b)
    {
      EXPECT_EQ(model->sourceVertex[a] == model->sourceVertex[b], model->normalGroup[a] == model->normalGroup[b]);
      EXPECT_TRUE(
        model->sourceVertex[a] != model->sourceVertex[b] || model->rest->normals[a] == model->rest->normals[b]);
    }
  }
}

TEST(Md2, ATriangleCountsOnceInTheNormalOfTwoOfItsCorners)
{
  // one upright and one flat triangle; the flat one has two corners in the group of the upright one's first
  struct Still : dgtk::Deformation
  {
    void positionsAt(int /*animation*/, double /*frame*/, std::vector<Eigen::Vector3d>& positions) const override
    {
      positions = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 0 }, { 1, 0, 0 }, { 0, 0, 1 } };
    }
  };
  Model model = *seed();
  model.deformation = std::make_shared<Still>();
  model.triangles = { { 0, 1, 2 }, { 3, 4, 5 } };
  model.sourceVertex = { 0, 1, 2, 3, 4, 5 };
  model.normalGroup = { 0, 0, 1, 0, 2, 3 };
  const auto geometry = dgtk::geometryAt(model, 0, 0);
  EXPECT_LT((geometry->normals[0] - Eigen::Vector3f(0, -1, 1).normalized()).norm(), 1e-6f);
  EXPECT_EQ(geometry->normals[2], Eigen::Vector3f(0, 0, 1));
}

TEST(Md2, FramesMayBeLongerThanTheirVertices)
{
  std::string bytes = md2Seed().bytes();
  const auto field = [&bytes](std::size_t i)
  {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + 8 + 4 * i, 4);
    return value;
  };
  const std::uint32_t size = field(2), frames = field(8), begin = field(12);
  bytes.replace(8 + 2 * 4, 4, dgtk::test::u32(size + 4));
  for (std::uint32_t f = frames; f > 0; --f)
  {
    bytes.insert(begin + f * size, 4, '\x7f');
  }
  const auto plain = seed();
  const auto padded = readBytes("md2", bytes);
  for (const double frame : { 0.0, 1.0 })
  {
    EXPECT_EQ(dgtk::geometryAt(*padded, 1, 2 + frame)->positions, dgtk::geometryAt(*plain, 1, 2 + frame)->positions);
  }
}

TEST(Md2, SequencesFromFrameNames)
{
  const auto of = [](const std::vector<std::string>& names) { return described(dgtk::sequencesOf(names)); };
  EXPECT_THAT(of({ "stand01", "stand02", "run1", "run2" }), ElementsAre("stand 0-1", "run 2-3"));
  EXPECT_THAT(of({ "pain101", "pain102", "pain201", "pain202" }), ElementsAre("pain1 0-1", "pain2 2-3"));
  EXPECT_THAT(of({ "pain1_1", "pain1_2", "pain2_1" }), ElementsAre("pain1_ 0-1", "pain2_ 2-2"));
  EXPECT_THAT(of({ "FRAME 000...", "FRAME 000...", "FRAME 000..." }), ElementsAre("FRAME 000... 0-2"));
  EXPECT_THAT(of({ "frame098", "frame099", "frame100", "frame101" }), ElementsAre("frame 0-3"));
  EXPECT_THAT(of({ "f197", "f198", "f199", "f200" }), ElementsAre("f 0-3"));
  EXPECT_THAT(of({ "frame000" }), ElementsAre("frame 0-0"));
  EXPECT_THAT(of({ "", "", "07", "walk" }), ElementsAre(" 0-2", "walk 3-3"));
  EXPECT_THAT(of({ "a1", "b1", "a2" }), ElementsAre("a 0-0", "b 1-1", "a 2-2"));
  EXPECT_THAT(of({}), ElementsAre());
}

TEST(Md2, TimesFromAnAnmFile)
{
  const dgtk::test::TemporaryFolder folder;
  dgtk::writeFile(folder.path("x.md2"), md2Seed().bytes());
  dgtk::writeFile(folder.path("x.anm"),
    "// name start end fps\r\n\r\nwalk\t1\t3\t18.5\ndead 3 3 0\nlate 2 9 1 // cut\nbad 7 9 "
    "1\nworse x\n");
  const auto model = dgtk::readModel(folder.path("x.md2"));
  ASSERT_THAT(described(model->animations), ElementsAre("stand 0-1", "pain1 2-3", "walk 1-3", "dead 3-3", "late 2-3"));
  EXPECT_EQ(model->animations[2].fps, 18.5);
  EXPECT_EQ(model->animations[3].fps, 0);
  EXPECT_THAT(model->warnings, testing::Contains(HasSubstr("x.anm:6: left out")));
  EXPECT_THAT(model->warnings, testing::Contains(HasSubstr("x.anm:7: left out")));
  std::vector<Eigen::Vector3d> p;
  model->deformation->positionsAt(2, 1.5, p);
  EXPECT_EQ(p[0].z(), 1.5);
}

TEST(Md2, RatesOfAnAnmFile)
{
  std::vector<std::string> warnings;
  const auto rates = [&](const std::string& text)
  {
    std::vector<double> found;
    for (const dgtk::Animation& animation : dgtk::parseAnm(text, "x.anm", 4, warnings))
    {
      found.push_back(animation.fps);
    }
    return found;
  };
  EXPECT_THAT(rates("a 1 3\nb 1 3 // ten\n#c 1 3 4\nd 1 3 4 // four\ne 1 3 999999\nf 0 0 0\n"),
    ElementsAre(10, 10, 4, 999999, 0));
  EXPECT_THAT(warnings, testing::IsEmpty());
  EXPECT_THAT(rates("a 1 3 1000000\nb 3 1 4\nc 1 3 fast\nd -1 3 4\ne 1 3 -1\nf 1\n"), testing::IsEmpty());
  EXPECT_EQ(warnings.size(), 6u);
}

TEST(Md2, FrameNamesOfAllTheirCharacters)
{
  dgtk::test::Md2File file = md2Seed();
  file.frames[0].name = "a_frame_of_many1";
  file.frames[1].name = "a_frame_of_many2";
  EXPECT_THAT(described(readBytes("md2", file.bytes())->animations), ElementsAre("a_frame_of_many 0-1", "pain1 2-3"));
}

TEST(Md2, TimesOfAnAnmFileBeginWithinTheFrames)
{
  std::vector<std::string> warnings;
  EXPECT_THAT(described(dgtk::parseAnm("# name\nlast 3 3\n", "x.anm", 4, warnings)), ElementsAre("last 3-3"));
  EXPECT_THAT(warnings, testing::IsEmpty());
  EXPECT_THAT(dgtk::parseAnm("behind 4 9\n", "x.anm", 4, warnings), testing::IsEmpty());
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("x.anm:1: left out")));
}

TEST(Md2, SkinsAreFoundWhereGamesPutThem)
{
  const dgtk::test::TemporaryFolder folder;
  const auto found = [&](const std::vector<std::string>& skins, const std::vector<std::string>& files)
  {
    dgtk::test::Md2File file = md2Seed();
    file.skins = skins;
    const dgtk::test::TemporaryFolder place;
    dgtk::writeFile(place.path("gun.md2"), file.bytes());
    for (const std::string& name : files)
    {
      dgtk::writeFile(place.path(name), "not a picture");
    }
    dgtk::ReadOptions options;
    options.decodeTextures = false;
    const auto model = dgtk::readModel(place.path("gun.md2"), options);
    const int texture = model->materials.at(0).texture;
    const std::string path = texture < 0 ? "" : model->textures[static_cast<std::size_t>(texture)].path;
    return path.substr(path.rfind('/') + 1);
  };
  EXPECT_EQ(found({ "models/weapons/v/skin.pcx" }, { "skin.jpg", "gun.jpg" }), "skin.jpg");
  EXPECT_EQ(found({ "models/weapons/v/skin.pcx" }, { "gun.jpg" }), "gun.jpg") << "the model's own name";
  EXPECT_EQ(found({ ".body" }, { "body.tga", "gun.tga" }), "body.tga");
  EXPECT_EQ(found({ "a.pcx", "b.pcx" }, { "b.png" }), "b.png") << "a variant that is there";
  EXPECT_EQ(found({ "a.pcx", "b.pcx" }, { "a.png", "b.png" }), "a.png");
  EXPECT_EQ(found({}, { "gun.png" }), "gun.png");
  EXPECT_EQ(found({}, {}), "");
  EXPECT_EQ(seed()->materials.at(0).diffuse, Eigen::Vector3d(1, 1, 1)) << "as the skin is";
}

TEST(Md2, BlocksMayEndAtTheEndOfTheFile)
{
  dgtk::test::Md2File file = md2Seed();
  std::string bytes = file.bytes();
  // no commands, at an offset at the end of the file: as written; and no skins at a senseless offset
  file.skins.clear();
  bytes = file.bytes();
  bytes.replace(8 + 9 * 4, 4, dgtk::test::u32(0x7fffffff));
  EXPECT_EQ(readBytes("md2", bytes)->triangles.size(), 4u);
}

TEST(Md2, Refusals)
{
  EXPECT_EQ(refusal("md2", "ID"), "model.md2: is not an MD2 file (expected 'IDP2' at its start, found a shorter file)");
  EXPECT_THAT(refusal("md2", "IDP3aaaabbbb"), HasSubstr("is not an MD2 file"));
  for (const std::size_t length : { 8, 40, 67 })
  {
    EXPECT_THAT(refusal("md2", md2Seed().bytes().substr(0, length)), HasSubstr("the header")) << length;
  }
  EXPECT_EQ(refusedWith(4, 15), "model.md2: is an MD2 file of another version (expected 8, found 15)");
  EXPECT_THAT(refusedWith(8 + 4 * 4, -1), HasSubstr("bad number of vertices in the header"));
  EXPECT_THAT(refusedWith(8 + 4 * 4, 50), HasSubstr("bad frames in the header"));
  EXPECT_THAT(refusedWith(8 + 6 * 4, 100000), HasSubstr("triangles at byte"));
  EXPECT_THAT(refusedWith(8 + 6 * 4, 0x7fffffff), HasSubstr("triangles at byte"));
  EXPECT_THAT(refusedWith(8 + 8 * 4, 0), HasSubstr("bad frames in the header"));
  EXPECT_THAT(refusedWith(8 + 8 * 4, 0x7fffffff), HasSubstr("frames at byte"));
  EXPECT_THAT(refusedWith(8 + 12 * 4, -5), HasSubstr("bad offset of frames in the header"));
  for (const auto& [number, offset, what] :
    { std::tuple(3, 9, "skins"), { 5, 10, "texture coordinates" }, { 6, 11, "triangles" }, { 8, 12, "frames" } })
  {
    EXPECT_THAT(refusedWith(8 + std::size_t(number) * 4, 100000), HasSubstr(std::string(what) + " at byte"));
    EXPECT_THAT(refusedWith(8 + std::size_t(offset) * 4, 67), HasSubstr(std::string("bad offset of ") + what));
    EXPECT_THAT(refusedWith(8 + std::size_t(offset) * 4, 100000), HasSubstr(std::string(what) + " at byte"));
    EXPECT_THAT(refusedWith(8 + std::size_t(number) * 4, -1), HasSubstr("in the header")) << what;
  }
  dgtk::test::Md2File file = md2Seed();
  file.frames[1].scale[0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(refusal("md2", file.bytes()), HasSubstr("a frame's scale or translation is not a usable number at byte"));
}

TEST(Md2, BadIndicesAreCounted)
{
  dgtk::test::Md2File file = md2Seed();
  file.triangles[0] = 4;
  file.triangles[9] = 4; // one behind the last of both
  const auto model = readBytes("md2", file.bytes());
  EXPECT_EQ(model->triangles.size(), 3u);
  EXPECT_THAT(model->warnings, testing::Contains(HasSubstr("1 surface left out: a vertex that does not exist")));
  EXPECT_THAT(model->warnings, testing::Contains(HasSubstr("1 corner(s) without texture coordinates: bad indices")));
}

TEST(Md2, UnusedLastVerticesAreNoBother)
{
  // the surfaces around each vertex are looked up; with library assertions one index too far ends the program
  dgtk::test::Md2File file = md2Seed();
  const std::size_t vertices = file.frames[0].coordinates.size() / 3;
  for (dgtk::test::Md2File::Frame& frame : file.frames)
  {
    frame.coordinates.insert(frame.coordinates.end(), { 1, 2, 3, 4, 5, 6 });
  }
  const auto model = readBytes("md2", file.bytes());
  EXPECT_EQ(dgtk::test::brokenPromise(*model), "");
  EXPECT_EQ(model->sourceVertices, vertices + 2);
  EXPECT_EQ(model->triangles.size(), readBytes("md2", md2Seed().bytes())->triangles.size());
}
