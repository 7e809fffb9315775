// SPDX-License-Identifier: BSD-3-Clause
// Files made to need much time or memory: at most 2 s, and 10 times the file and 64 MiB.
#include "dgtkModelChecks.h"
#include "dgtkModelSeeds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

using namespace dgtk::test;
using testing::Contains;
using testing::HasSubstr;

namespace
{
std::string polyWith(const std::string& statements)
{
  return "AC3Db\nMATERIAL \"\" rgb 1 1 1\nOBJECT poly\n" + statements + "kids 0\n";
}

std::string number(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}
} // namespace

TEST(ModelLimits, AnEndlessSpiral)
{
  // a concave polygon that has few ears at any time
  const int n = 40000;
  std::string vertices = "numvert " + std::to_string(n) + "\n";
  std::string refs = "SURF 0x10\nmat 0\nrefs " + std::to_string(n) + "\n";
  for (int i = 0; i < n; ++i)
  {
    const double turns = 200.0 * (i < n / 2 ? i : n - i) / (n / 2);
    const double radius = 1 + turns + (i < n / 2 ? 0.5 : 0);
    vertices += number(radius * std::cos(turns * 6.283)) + ' ' + number(radius * std::sin(turns * 6.283)) + " 0\n";
    refs += std::to_string(i) + " 0 0\n";
  }
  const auto model = readWithinLimits("ac", polyWith(vertices + refs));
  ASSERT_TRUE(model);
  EXPECT_EQ(model->triangles.size(), static_cast<std::size_t>(n - 2));
}

TEST(ModelLimits, AVertexOfAllSurfaces)
{
  const int n = 100000;
  std::string text = "crease 180\nnumvert 3\n0 0 0\n1 0 0\n0 1 0\n";
  for (int i = 0; i < n; ++i)
  {
    text += "SURF 16\nmat 0\nrefs 3\n0 " + number(i) + " 0\n1 0 0\n2 0 0\n";
  }
  const auto model = readWithinLimits("ac", polyWith(text));
  ASSERT_TRUE(model);
  EXPECT_EQ(model->triangles.size(), static_cast<std::size_t>(n));
}

TEST(ModelLimits, AFanOfOneCornerALine)
{
  const int n = 700000;
  std::string refs = "SURF 0\nmat 0\nrefs " + std::to_string(n) + "\n";
  for (int i = 0; i < n; ++i)
  {
    refs += std::to_string(i % 10) + ' ' + std::to_string(i / 10 % 10) + ' ' + std::to_string(i / 100 % 10) + '\n';
  }
  std::string vertices = "numvert 10\n";
  for (int i = 0; i < 10; ++i)
  {
    vertices += std::to_string(i) + ' ' + std::to_string(i * i % 7) + " 0\n";
  }
  readWithinLimits("ac", polyWith(vertices + refs));
}

TEST(ModelLimits, ManySmallThings)
{
  std::string objects;
  std::string materials;
  std::string vertices = "numvert 1000000\n";
  for (int i = 0; i < 60000; ++i)
  {
    objects += "OBJECT poly\ntexture \"" + std::to_string(i) +
               "\"\nnumvert 3\n0 0 0\n1 0 0\n0 1 0\nSURF 0\nmat 0\nrefs 3\n0 0 "
               "0\n1 0 0\n2 0 0\nkids 0\n";
    materials += "MATERIAL\n";
  }
  for (int i = 0; i < 1000000; ++i)
  {
    vertices += "0 0 0\n";
  }
  const auto textured = readWithinLimits("ac", "AC3Db\nMATERIAL \"\" rgb 1 1 1\n" + objects);
  ASSERT_TRUE(textured);
  EXPECT_EQ(textured->parts.size(), 60000u);
  EXPECT_THAT(textured->warnings, Contains(HasSubstr("more warnings")));
  readWithinLimits("ac", "AC3Db\n" + materials);
  EXPECT_FALSE(readWithinLimits("ac", "AC3Db\n" + materials + materials)) << "more than 65536";
  readWithinLimits("ac", polyWith(vertices));
  readWithinLimits("ac", polyWith("name \"" + std::string(8000000, 'x') + "\"\n"));
  readWithinLimits("ac", "AC3Db\n" + std::string(8000000, '\n'));
  readWithinLimits("ac", "\xff\xfe" + std::string(8000000, '\n'));
  readWithinLimits("ac", polyWith("data 999999999999\n" + std::string(4000000, 'k')));
}

TEST(ModelLimits, FlatMeshesOfFewVertices)
{
  // 8 bytes a face, which flat would become three vertices
  std::string vertices = u16(300);
  for (int i = 0; i < 300; ++i)
  {
    vertices += f32(static_cast<float>(i % 17)) + f32(static_cast<float>(i % 13)) + f32(static_cast<float>(i % 11));
  }
  std::string faces = u16(65535);
  unsigned random = 1;
  for (unsigned i = 0; i < 65535 * 3; ++i)
  {
    random = random * 1664525u + 1013904223u;
    faces += u16((random >> 16) % 300) + (i % 3 == 2 ? u16(0) : "");
  }
  const std::string mesh =
    chunk3ds(0x4000, std::string("m\0", 2) + chunk3ds(0x4100, chunk3ds(0x4110, vertices) + chunk3ds(0x4120, faces)));
  std::string meshes;
  for (int i = 0; i < 16; ++i)
  {
    meshes += mesh;
  }
  const auto model = readWithinLimits("3ds", chunk3ds(0x4d4d, chunk3ds(0x3d3d, meshes)));
  ASSERT_TRUE(model);
  EXPECT_EQ(model->triangles.size(), 16u * 65535);
  EXPECT_THAT(model->warnings, Contains(HasSubstr("flat surfaces are drawn smooth")));
  std::string empty;
  for (int i = 0; i < 400000; ++i)
  {
    empty += chunk3ds(0x4000, std::string("\0", 1) + chunk3ds(0x4100, ""));
  }
  readWithinLimits("3ds", chunk3ds(0x4d4d, chunk3ds(0x3d3d, empty)));
}

TEST(ModelLimits, TheLargestMd2)
{
  Md2File file = md2Seed();
  file.triangles.clear();
  file.sts.assign(8192, 1);
  for (unsigned i = 0; i < 131072; ++i)
  {
    const auto vertex = [i](unsigned k) { return static_cast<std::uint16_t>((i + k) % 256); };
    const auto st = [i](unsigned k) { return static_cast<std::uint16_t>((i / 256 * 3 + k) % 4096); };
    file.triangles.insert(file.triangles.end(), { vertex(0), vertex(1), vertex(2), st(0), st(1), st(2) });
  }
  for (Md2File::Frame& frame : file.frames)
  {
    frame.coordinates.clear();
    for (unsigned i = 0; i < 256 * 3; ++i)
    {
      frame.coordinates.push_back(static_cast<std::uint8_t>(i * 37));
    }
  }
  for (unsigned i = 0; i < file.sts.size(); ++i)
  {
    file.sts[i] = static_cast<std::int16_t>(i);
  }
  const auto model = readWithinLimits("md2", file.bytes());
  ASSERT_TRUE(model);
  EXPECT_EQ(model->triangles.size(), 131072u);
}
