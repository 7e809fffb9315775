// SPDX-License-Identifier: BSD-3-Clause
// A small file of each format against everything that its reader makes of it.
#include "dgtkFile.h"
#include "dgtkGltfMaker.h"
#include "dgtkModelChecks.h"
#include "dgtkModelSeeds.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <sstream>

using namespace dgtk::test;
using Json = nlohmann::json;

namespace
{
/// Four digits, and no negative zero.
std::string text(double value)
{
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.4g", std::abs(value) < 5e-7 ? 0.0 : value);
  return buffer;
}

template <typename Vector>
std::string text(const Vector& v)
{
  std::string all;
  for (Eigen::Index i = 0; i < v.size(); ++i)
  {
    all += (i ? " " : "") + text(double(v[i]));
  }
  return all;
}

std::string textOf(const dgtk::Material& m)
{
  std::string all = "material '" + m.name + "' ambient " + text(m.ambient) + " diffuse " + text(m.diffuse) +
                    " specular " + text(m.specular) + " emission " + text(m.emission) + " shininess " +
                    text(m.shininess) + " opacity " + text(m.opacity);
  all += m.twoSided ? " two-sided" : "";
  all += m.cutOut ? " cut-out" : "";
  const std::pair<const char*, int> maps[] = { { "texture", m.texture }, { "normals", m.normalMap },
    { "bumps", m.bumpMap }, { "metal", m.metallicRoughnessMap }, { "emissions", m.emissionMap },
    { "occlusion", m.occlusionMap } };
  for (const auto& [name, index] : maps)
  {
    all += index >= 0 ? std::string(" ") + name + ' ' + std::to_string(index) : "";
  }
  all += m.normalScale == 1 ? "" : " normal scale " + text(m.normalScale);
  all += m.bumpScale == 1 ? "" : " bump scale " + text(m.bumpScale);
  all += m.occlusionStrength == 1 ? "" : " strength " + text(m.occlusionStrength);
  all += m.physical ? " physical " + text(m.physical->metallic) + ' ' + text(m.physical->roughness) +
                        (m.physical->wanted ? " wanted" : "")
                    : "";
  return all;
}

/// Position, normal, texture coordinate, vertex of the file and smoothing group of a split vertex.
std::string textOf(const dgtk::Model& model, std::uint32_t v)
{
  std::string all = std::to_string(v) + ": " + text(model.rest->positions[v]) + " | " + text(model.rest->normals[v]);
  all += model.uvs.empty() ? "" : " | " + text(model.uvs[v]);
  all += " | " + std::to_string(model.sourceVertex[v]);
  return all + (model.normalGroup.empty() ? "" : " | " + std::to_string(model.normalGroup[v]));
}

/// Everything of a model but its path, a line each.
std::string textOf(const dgtk::Model& model)
{
  std::ostringstream out;
  out << model.format << ": " << model.sourceVertices << " vertices, " << model.rest->positions.size() << " split, "
      << model.triangles.size() << " triangles, declared " << model.declaredTriangles << ", two-sided "
      << model.twoSidedTriangles << " of " << model.twoSidedSurfaces << ", lines " << model.lines << ", materials "
      << model.declaredMaterials << ", frames " << model.frames << '\n';
  out << "bounds " << text(model.boundsMin) << " to " << text(model.boundsMax) << '\n';
  for (const dgtk::Material& material : model.materials)
  {
    out << textOf(material) << '\n';
  }
  for (const dgtk::Texture& texture : model.textures)
  {
    out << "texture " << texture.name << '\n';
  }
  for (std::uint32_t v = 0; v < model.rest->positions.size(); ++v)
  {
    out << textOf(model, v) << '\n';
  }
  for (const dgtk::Part& part : model.parts)
  {
    out << "part '" << part.name << "' material " << part.material << ", " << part.triangles << " from "
        << part.firstTriangle << ':';
    for (std::uint32_t t = part.firstTriangle; t < part.firstTriangle + part.triangles; ++t)
    {
      const auto& [a, b, c] = model.triangles[t];
      out << ' ' << a << '-' << b << '-' << c;
    }
    out << '\n';
  }
  for (const dgtk::Animation& a : model.animations)
  {
    out << "animation " << a.name << ' ' << a.first << " to " << a.last << " at " << text(a.fps)
        << (a.beside ? " beside" : "") << '\n';
  }
  for (const std::string& warning : model.warnings)
  {
    out << "warning " << warning << '\n';
  }
  return out.str();
}

std::string whole(const std::string& extension, const std::string& bytes)
{
  return "\n" + textOf(*readBytes(extension, bytes));
}
} // namespace

TEST(ModelWhole, Ac3d)
{
  EXPECT_EQ(whole("ac", ac3dSeed()), R"(
ac3d: 9 vertices, 11 split, 5 triangles, declared 0, two-sided 4 of 3, lines 4, materials 2, frames 1
bounds 1 0 -1 to 2 1 1
material 'red paint' ambient 0.2 0.2 0.2 diffuse 1 0.25 0 specular 0.5 0.5 0.5 emission 0 0.1 0 shininess 64 opacity 0.75
material '' ambient 0 0 0 diffuse 0 0 1 specular 0 0 0 emission 0 0 0 shininess 0 opacity 1 two-sided
material 'red paint' ambient 0.2 0.2 0.2 diffuse 1 0.25 0 specular 0.5 0.5 0.5 emission 0 0.1 0 shininess 64 opacity 0.75 two-sided texture 0
material '' ambient 0 0 0 diffuse 0 0 1 specular 0 0 0 emission 0 0 0 shininess 0 opacity 1 texture 0
texture tiles.png
0: 1 0 0 | 0 0 1 | 0.5 0 | 0
1: 2 0 0 | 0 0 1 | 2.5 0 | 1
2: 2 1 0 | 0 0 1 | 2.5 3 | 2
3: 1 1 0 | 0 0 1 | 0.5 3 | 3
4: 1 0 0 | 0 -0.8944 -0.4472 | 0.5 0 | 0
5: 1.5 0.5 -1 | 0 -0.8944 -0.4472 | 1.5 1.5 | 4
6: 2 0 0 | 0 -0.8944 -0.4472 | 2.5 0 | 1
7: 1 0 1 | 0 0 1 | 0 0 | 5
8: 2 0 1 | 0 0 1 | 1 0 | 6
9: 1 1 1 | 0 0 1 | 0 1 | 7
10: 2 1 1 | 0 0 1 | 1 1 | 8
part 'roof' material 2, 2 from 0: 0-1-2 0-2-3
part 'roof' material 3, 1 from 2: 4-5-6
part '' material 1, 2 from 3: 7-8-9 9-8-10
warning texture 'tiles.png' not found (tried as written, 'tiles.png' beside the model, in any case, with other image extensions, as an 8.3 name, and in ../textures)
)");
}

TEST(ModelWhole, Ac3dPlacesAndBlocks)
{
  EXPECT_EQ(
    whole("ac", "AC3Dc\n"
                "MAT \"block\"\nrgb 0.5 0.25 0.125\namb 0.1 0.2 0.3\nemis 0.4 0.5 0.6\nspec 0.7 0.8 0.9\nshi 200\n"
                "trans 0.75\nENDMAT\n"
                "OBJECT world\n"
                "kids 2\n"
                "OBJECT group\n"
                "rot 0 1 0 -1 0 0 0 0 1\n"
                "loc 10 20 30\n"
                "texture \"of-kids.png\"\n"
                "kids 1\n"
                "OBJECT poly\n"
                "name \"turned\"\n"
                "rot 2 0 0 0 3 0 0 0 4\n"
                "loc 1 2 3\n"
                "texoff 0.5 0.25\n"
                "crease 30\n"
                "numvert 6\n"
                "0 0 0 0 0 1\n1 0 0 0 0 1\n1 1 0\n0 1 0\n0 0 1 1 1 0\n0 1 1\n"
                "numsurf 4\n"
                "SURF 0x30\nmat 0\nrefs 3\n0 0 0\n1 1 0\n2 1 1\n"
                "SURF 0x10\nmat 0\nrefs 3\n3 0 1\n4 0.5 0.25\n2 0 0\n"
                "SURF 0x01\nrefs 3\n0\n1\n2\n"
                "SURF 0x04\nrefs 5\n0 0 0\n1 1 0\n2 0 0\n2 0 0\n3 0 0\n"
                "kids 0\n"
                "OBJECT poly\n"
                "name \"plain\"\n"
                "numvert 4\n"
                "0 0 0\n2 0 0\n2 0 2\n0 0 2\n"
                "numsurf 1\n"
                "SURF 0x00\nmat 7\nrefs 4\n0\n1\n2\n9\n"
                "kids 0\n"),
    R"(
ac3d: 10 vertices, 7 split, 3 triangles, declared 0, two-sided 1 of 1, lines 3, materials 1, frames 1
bounds 12 17 33 to 15 19 37
material 'block' ambient 0.1 0.2 0.3 diffuse 0.5 0.25 0.125 specular 0.7 0.8 0.9 emission 0.4 0.5 0.6 shininess 128 opacity 0.25
material 'block' ambient 0.1 0.2 0.3 diffuse 0.5 0.25 0.125 specular 0.7 0.8 0.9 emission 0.4 0.5 0.6 shininess 128 opacity 0.25 two-sided texture 0
material '' ambient 0.2 0.2 0.2 diffuse 0.8 0.8 0.8 specular 0 0 0 emission 0 0 0 shininess 0 opacity 1
material '' ambient 0.2 0.2 0.2 diffuse 0.8 0.8 0.8 specular 0 0 0 emission 0 0 0 shininess 0 opacity 1 texture 0
texture of-kids.png
0: 12 19 33 | 0 0 1 | 0.5 0.25 | 0
1: 12 17 33 | 0 0 1 | 1.5 0.25 | 1
2: 15 17 33 | 0 0 1 | 1.5 1.25 | 2
3: 15 19 33 | 0.8 0 0.6 | 0.5 1.25 | 3
4: 12 19 37 | 0.5547 -0.8321 0 | 1 0.5 | 4
5: 15 17 33 | 0.8 0 0.6 | 0.5 0.25 | 2
6: 15 17 33 | 0 0 1 | 0.5 0.25 | 2
part 'turned' material 1, 2 from 0: 0-1-2 3-4-5
part 'turned' material 3, 1 from 2: 0-1-6
warning texture 'of-kids.png' not found (tried as written, 'of-kids.png' beside the model, in any case, with other image extensions, as an 8.3 name, and in ../textures)
warning 2 surface(s) name a material that does not exist; a grey one is used
warning 1 surface left out: a vertex that does not exist
)");
}

TEST(ModelWhole, Studio3ds)
{
  EXPECT_EQ(whole("3ds", seed3ds()), R"(
3ds: 9 vertices, 13 split, 6 triangles, declared 0, two-sided 2 of 0, lines 0, materials 2, frames 1
bounds 0 0 0 to 2 1 6
material 'wall' ambient 0.03922 0.07843 0.1176 diffuse 1 0.502 0 specular 0.4 0.4 0.4 emission 0 0 0 shininess 64 opacity 0.75 two-sided texture 0
material 'plain' ambient 0.2 0.2 0.2 diffuse 0 1 0 specular 0 0 0 emission 0 0 0 shininess 0 opacity 1
material '' ambient 0.2 0.2 0.2 diffuse 0.8 0.8 0.8 specular 0 0 0 emission 0 0 0 shininess 0 opacity 1
texture WALL.TGA
0: 0 0 0 | 0 0 1 | 0 0 | 0
1: 2 0 0 | 0 0 1 | 1 0 | 1
2: 2 1 0 | 0 0 1 | 1 1 | 2
3: 0 1 0 | 0 0 1 | 0 1 | 3
4: 0 0 5 | 0 -0.7071 -0.7071 | 0 0 | 5
5: 0 1 5 | 0.7071 0.7071 0 | 0 0 | 7
6: 1 0 5 | 1 0 0 | 0 0 | 6
7: 0 0 6 | 0.7071 0 0.7071 | 0 0 | 8
8: 0 0 5 | -1 0 0 | 0 0 | 5
9: 0 0 6 | 0 0.7071 0.7071 | 0 0 | 8
10: 0 1 5 | 0 0.7071 0.7071 | 0 0 | 7
11: 0 1 5 | 0 1 0 | 0 0 | 7
12: 0 0 6 | 0 0 1 | 0 0 | 8
part 'quad' material 0, 2 from 0: 0-1-2 0-2-3
part 'solid' material 2, 3 from 2: 4-5-6 4-6-7 8-9-10
part 'solid' material 1, 1 from 5: 6-11-12
warning texture 'WALL.TGA' not found (tried as written, 'WALL.TGA' beside the model, in any case, with other image extensions, as an 8.3 name, and in ../textures)
)");
}

TEST(ModelWhole, Md2)
{
  EXPECT_EQ(whole("md2", md2Seed().bytes()), R"(
md2: 4 vertices, 4 split, 4 triangles, declared 0, two-sided 0 of 0, lines 0, materials 1, frames 4
bounds 0 0 0 to 10 10 10
material 'skin' ambient 1 1 1 diffuse 1 1 1 specular 0 0 0 emission 0 0 0 shininess 0 opacity 1 texture 0
texture models/thing/skin.pcx
texture .other
0: 0 10 0 | 0 1 0 | 0 0 | 2 | 2
1: 10 0 0 | 1 0 0 | 1 1 | 1 | 1
2: 0 0 0 | -0.5774 -0.5774 -0.5774 | 0 1 | 0 | 0
3: 0 0 10 | 0 0 1 | -0.25 -0.5 | 3 | 3
part '' material 0, 4 from 0: 0-1-2 1-3-2 3-0-2 0-3-1
animation stand 0 to 1 at 10
animation pain1 2 to 3 at 10
warning texture 'models/thing/skin.pcx' not found (tried as written, 'skin.pcx' beside the model, in any case, with other image extensions, as an 8.3 name, and in ../textures, and 'model')
warning texture '.other' not found (tried as written, '.other' beside the model, in any case, with other image extensions, as an 8.3 name, and in ../textures)
)");
}

TEST(ModelWhole, Ply)
{
  EXPECT_EQ(
    whole("ply", "ply\nformat ascii 1.0\ncomment TextureFile grass.png\n"
                 "element vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
                 "property float nx\nproperty float ny\nproperty float nz\nproperty float s\nproperty float t\n"
                 "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                 "element face 2\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\n"
                 "element tristrips 1\nproperty list int int vertex_indices\n"
                 "element edge 2\nproperty int vertex1\nproperty int vertex2\nend_header\n"
                 "0 0 0 0 0 2 0.25 0.5 51 102 204\n1 0 0 0 3 4 0.75 0.5 51 102 204\n1 1 0 0 0 1 1 1 51 102 204\n"
                 "0 1 0 0 0 1 0 1 51 102 204\n0 0 5 1 0 0 0 0 51 102 204\n"
                 "4 0 1 2 3 8 0 0 1 0 1 1 0 2\n3 0 4 1 0\n"
                 "6 0 1 2 3 -1 4\n"
                 "0 4\n4 9\n"),
    R"(
ply: 5 vertices, 8 split, 5 triangles, declared 0, two-sided 0 of 0, lines 1, materials 0, frames 1
bounds 0 0 0 to 1 1 5
material 'ply' ambient 0.04 0.08 0.16 diffuse 0.2 0.4 0.8 specular 0 0 0 emission 0 0 0 shininess 0 opacity 1
material 'ply' ambient 0.04 0.08 0.16 diffuse 0.2 0.4 0.8 specular 0 0 0 emission 0 0 0 shininess 0 opacity 1 texture 0
texture grass.png
0: 0 0 0 | 0 0 1 | 0 0 | 0
1: 1 0 0 | 0 0.6 0.8 | 1 0 | 1
2: 1 1 0 | 0 0 1 | 1 1 | 2
3: 0 1 0 | 0 0 1 | 0 2 | 3
4: 0 0 0 | 0 0 1 | 0.25 0.5 | 0
5: 0 0 5 | 1 0 0 | 0 0 | 4
6: 1 0 0 | 0 0.6 0.8 | 0.75 0.5 | 1
7: 0 1 0 | 0 0 1 | 0 1 | 3
part 'mesh' material 1, 5 from 0: 0-1-2 0-2-3 4-5-6 4-6-2 2-6-7
warning texture 'grass.png' not found (tried as written, 'grass.png' beside the model, in any case, with other image extensions, as an 8.3 name, and in ../textures)
warning 1 surface left out: a vertex that does not exist
)");
}

TEST(ModelWhole, Pov)
{
  EXPECT_EQ(whole("pov",
              "camera { right -x }\n"
              "#declare Paint = texture { pigment { color rgbft <0.5, 0.25, 0.125, 0.25, 0.25> } finish { ambient 0.5 "
              "diffuse 0.8 specular 0.5 roughness 0.01 emission 0.25 } }\n"
              "#declare Picture = texture { pigment { image_map { png \"wood.png\" } scale 2 translate x } }\n"
              "mesh { triangle { <0,0,0>, <1,0,0>, <0,1,0> texture { Paint } }\n"
              "  smooth_triangle { <0,0,1>, <0,0,1>, <1,0,1>, <0,1,1>, <0,1,1>, <1,0,0> } texture { Picture }\n"
              "  scale <2, 3, 4> translate <10, 20, 30> }\n"
              "mesh2 { vertex_vectors { 4, <0,0,0>, <1,0,0>, <1,1,0>, <0,1,0> }\n"
              "  uv_vectors { 4, <0,0>, <1,0>, <1,1>, <0,1> }\n"
              "  texture_list { 2, texture { Paint }, texture { Picture uv_mapping } }\n"
              "  face_indices { 2, <0,1,2>, 0, <0,2,3>, 1 } uv_mapping rotate 90*z }\n"),
    R"(
pov: 10 vertices, 12 split, 4 triangles, declared 0, two-sided 4 of 0, lines 0, materials 3, frames 1
bounds -1 0 0 to 12 23 34
material 'Paint' ambient 0.25 0.125 0.0625 diffuse 0.4 0.2 0.1 specular 0.5 0.5 0.5 emission 0.125 0.0625 0.03125 shininess 100 opacity 0.5 two-sided
material 'Picture' ambient 0.2 0.2 0.2 diffuse 1 1 1 specular 0 0 0 emission 0 0 0 shininess 0 opacity 1 two-sided
material 'Picture' ambient 0.2 0.2 0.2 diffuse 1 1 1 specular 0 0 0 emission 0 0 0 shininess 0 opacity 1 two-sided texture 0
material 'Picture' ambient 0.2 0.2 0.2 diffuse 1 1 1 specular 0 0 0 emission 0 0 0 shininess 0 opacity 1 two-sided
material 'Picture' ambient 0.2 0.2 0.2 diffuse 1 1 1 specular 0 0 0 emission 0 0 0 shininess 0 opacity 1 two-sided texture 0
texture wood.png
0: 10 20 30 | 0 0 1 | 0 0 | 0
1: 12 20 30 | 0 0 1 | 0 0 | 1
2: 10 23 30 | 0 0 1 | 0 0 | 2
3: 10 20 34 | 0 0 1 | -0.5 0 | 3
4: 12 20 34 | 0 0.8 0.6 | 0 0 | 4
5: 10 23 34 | 1 0 0 | -0.5 0.5 | 5
6: 0 0 0 | 0 0 1 | 0 0 | 6
7: 0 1 0 | 0 0 1 | 1 0 | 7
8: -1 1 0 | 0 0 1 | 1 1 | 8
9: 0 0 0 | 0 0 1 | -0.5 0 | 6
10: -1 1 0 | 0 0 1 | 0 0.5 | 8
11: -1 0 0 | 0 0 1 | -0.5 0.5 | 9
part 'mesh0' material 0, 1 from 0: 0-1-2
part 'mesh0' material 2, 1 from 1: 3-4-5
part 'mesh1' material 0, 1 from 2: 6-7-8
part 'mesh1' material 4, 1 from 3: 9-10-11
warning no part of the model, left out: camera
warning texture 'wood.png' not found (tried as written, 'wood.png' beside the model, in any case, with other image extensions, as an 8.3 name, and in ../textures)
)");
}

TEST(ModelWhole, Obj)
{
  const TemporaryFolder folder;
  dgtk::writeFile(folder.path("a.mtl"),
    "newmtl wall\nKa 0.1 0.2 0.3\nKd 0.4 0.5 0.6\nKs 0.7 0.8 0.9\nKe 0.05 0.1 0.15\nNs 20\nd 0.5\nmap_Kd wall.png\n"
    "newmtl unused\nKd 1 0 0\nnewmtl roof\nKd 0 1 0\n");
  dgtk::writeFile(folder.path("a.obj"),
    "mtllib a.mtl\no house\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nv 1 2 0.5\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\nvn 0 1 0\n"
    "usemtl wall\nf 1/1/1 2/2/1 3/3/1 4/4/1\nusemtl roof\no top\nf 4//2 3//2 5//2\nl 1 2 3\n");
  EXPECT_EQ("\n" + textOf(*dgtk::readModel(folder.path("a.obj"))), R"(
obj: 5 vertices, 7 split, 3 triangles, declared 0, two-sided 0 of 0, lines 2, materials 3, frames 1
bounds 0 0 0 to 2 2 0.5
material 'wall' ambient 0.1 0.2 0.3 diffuse 0.4 0.5 0.6 specular 0.7 0.8 0.9 emission 0.05 0.1 0.15 shininess 20 opacity 0.5 texture 0
material 'roof' ambient 0 0 0 diffuse 0 1 0 specular 0 0 0 emission 0 0 0 shininess 0 opacity 1
texture wall.png
0: 0 0 0 | 0 0 1 | 0 0 | 0
1: 2 0 0 | 0 0 1 | 1 0 | 1
2: 2 1 0 | 0 0 1 | 1 1 | 2
3: 0 1 0 | 0 0 1 | 0 1 | 3
4: 0 1 0 | 0 1 0 | 0 0 | 3
5: 2 1 0 | 0 1 0 | 0 0 | 2
6: 1 2 0.5 | 0 1 0 | 0 0 | 4
part 'house' material 0, 2 from 0: 0-1-2 0-2-3
part 'top' material 1, 1 from 2: 4-5-6
warning texture 'wall.png' not found (tried as written, 'wall.png' beside the model, in any case, with other image extensions, as an 8.3 name, and in ../textures)
)");
}

TEST(ModelWhole, Gltf)
{
  GltfMaker maker;
  const int positions = maker.floats("VEC3", { 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0 });
  const int normals = maker.floats("VEC3", { 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0.6f, 0.8f });
  const int uvs = maker.floats("VEC2", { 0, 0, 1, 0, 0, 1, 1, 0.75f });
  const int indices = maker.shorts("SCALAR", { 0, 1, 2, 2, 1, 3 });
  const float half = std::sqrt(0.5f);
  maker.json["scenes"] = { { { "nodes", { 0 } } } };
  maker.json["nodes"] = { { { "name", "top" }, { "children", { 1, 2 } }, { "scale", { 1, 2, 1 } } },
    { { "name", "first" }, { "mesh", 0 }, { "translation", { 10, 20, 30 } } },
    { { "name", "second" }, { "mesh", 0 }, { "rotation", { 0, 0, half, half } } } };
  maker.json["meshes"] = { { { "name", "sheet" },
    { "primitives", { { { "attributes", { { "POSITION", positions }, { "NORMAL", normals }, { "TEXCOORD_0", uvs } } },
                      { "indices", indices }, { "material", 0 } } } } } };
  maker.json["images"] = { { { "uri", "base.png" } }, { { "uri", "normals.png" } }, { { "uri", "metal.png" } },
    { { "uri", "glow.png" } }, { { "uri", "dirt.png" } } };
  maker.json["textures"] = { { { "source", 0 } }, { { "source", 1 } }, { { "source", 2 } }, { { "source", 3 } },
    { { "source", 4 } } };
  maker.json["materials"] = { { { "name", "all" }, { "doubleSided", true }, { "alphaMode", "BLEND" },
    { "emissiveFactor", { 1, 0.5, 0.25 } },
    { "pbrMetallicRoughness",
      { { "baseColorFactor", { 1, 0.5, 0.25, 0.5 } }, { "metallicFactor", 0.25 }, { "roughnessFactor", 0.75 },
        { "baseColorTexture", { { "index", 0 } } }, { "metallicRoughnessTexture", { { "index", 2 } } } } },
    { "normalTexture", { { "index", 1 }, { "scale", 0.5 } } },
    { "occlusionTexture", { { "index", 4 }, { "strength", 0.5 } } }, { "emissiveTexture", { { "index", 3 } } } } };
  EXPECT_EQ(whole("gltf", maker.gltf()), R"(
gltf: 8 vertices, 8 split, 4 triangles, declared 0, two-sided 4 of 0, lines 0, materials 1, frames 1
bounds -1 0 0 to 11 42 30
material 'all' ambient 0.2 0.1471 0.1074 diffuse 1 0.7354 0.5371 specular 0.2934 0.2173 0.1646 emission 1 0.7354 0.5371 shininess 4.321 opacity 0.5 two-sided texture 0 normals 1 metal 2 emissions 3 occlusion 4 normal scale 0.5 strength 0.5 physical 0.25 0.75
texture base.png
texture normals.png
texture metal.png
texture glow.png
texture dirt.png
0: 10 40 30 | 0 0 1 | 0 1 | 0
1: 11 40 30 | 0 0 1 | 1 1 | 1
2: 10 42 30 | 0 0 1 | 0 0 | 2
3: 11 42 30 | 0 0.3511 0.9363 | 1 0.25 | 3
4: 0 0 0 | 0 0 1 | 0 1 | 4
5: 0 2 0 | 0 0 1 | 1 1 | 5
6: -1 0 0 | 0 0 1 | 0 0 | 6
7: -1 2 0 | -0.6 0 0.8 | 1 0.25 | 7
part 'first' material 0, 2 from 0: 0-1-2 2-1-3
part 'second' material 0, 2 from 2: 4-5-6 6-5-7
warning texture 'base.png' not found (tried as written, 'base.png' beside the model, in any case, with other image extensions, as an 8.3 name, and in ../textures)
warning texture 'normals.png' not found (tried as written, 'normals.png' beside the model, in any case, with other image extensions, as an 8.3 name, and in ../textures)
warning texture 'metal.png' not found (tried as written, 'metal.png' beside the model, in any case, with other image extensions, as an 8.3 name, and in ../textures)
warning texture 'glow.png' not found (tried as written, 'glow.png' beside the model, in any case, with other image extensions, as an 8.3 name, and in ../textures)
warning texture 'dirt.png' not found (tried as written, 'dirt.png' beside the model, in any case, with other image extensions, as an 8.3 name, and in ../textures)
)");
}

TEST(ModelWhole, Off)
{
  EXPECT_EQ(whole("off", "OFF\n5 3 0\n0 0 0\n2 0 0\n2 1 0\n0 1 0\n1 0 4\n4 0 1 2 3\n3 0 4 1\n3 2 4 3\n"),
    R"(
off: 5 vertices, 10 split, 4 triangles, declared 0, two-sided 0 of 0, lines 0, materials 0, frames 1
bounds 0 0 0 to 2 1 4
material '' ambient 0.2 0.2 0.2 diffuse 0.8 0.8 0.8 specular 0 0 0 emission 0 0 0 shininess 0 opacity 1
0: 0 0 0 | 0 0 1 | 0
1: 2 0 0 | 0 0 1 | 1
2: 2 1 0 | 0 0 1 | 2
3: 0 1 0 | 0 0 1 | 3
4: 0 0 0 | 0 1 0 | 0
5: 1 0 4 | 0 1 0 | 4
6: 2 0 0 | 0 1 0 | 1
7: 2 1 0 | 0 -0.9701 -0.2425 | 2
8: 1 0 4 | 0 -0.9701 -0.2425 | 4
9: 0 1 0 | 0 -0.9701 -0.2425 | 3
part '' material 0, 4 from 0: 0-1-2 0-2-3 4-5-6 7-8-9
)");
}

TEST(ModelWhole, Collada)
{
  EXPECT_EQ(whole("dae", R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="meter" meter="1"/><up_axis>Y_UP</up_axis></asset>
<library_effects><effect id="paint-fx"><profile_COMMON><technique sid="common"><phong>
<emission><color>0.1 0.2 0.3 1</color></emission><ambient><color>0.4 0.5 0.6 1</color></ambient>
<diffuse><color>0.7 0.8 0.9 1</color></diffuse><specular><color>0.25 0.5 0.75 1</color></specular>
<shininess><float>12</float></shininess></phong></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="paint" name="paint"><instance_effect url="#paint-fx"/></material></library_materials>
<library_geometries><geometry id="g" name="sheet"><mesh>
<source id="p"><float_array id="pa" count="12">0 0 0 1 0 0 1 1 0 0 1 0</float_array><technique_common>
<accessor source="#pa" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<source id="t"><float_array id="ta" count="8">0 0 1 0 1 1 0 0.5</float_array><technique_common>
<accessor source="#ta" count="4" stride="2"><param name="S" type="float"/><param name="T" type="float"/>
</accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles material="m" count="2"><input semantic="VERTEX" source="#v" offset="0"/>
<input semantic="TEXCOORD" source="#t" offset="1" set="0"/><p>0 0 1 1 2 2 0 0 2 2 3 3</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n" name="place"><translate>10 20 30</translate><scale>2 3 4</scale>
<instance_geometry url="#g"><bind_material><technique_common><instance_material symbol="m" target="#paint"/>
</technique_common></bind_material></instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>
)"),
    R"(
collada: 4 vertices, 4 split, 2 triangles, declared 0, two-sided 0 of 0, lines 0, materials 1, frames 1
bounds 10 20 30 to 12 23 30
material 'paint' ambient 0.4 0.5 0.6 diffuse 0.7 0.8 0.9 specular 0.25 0.5 0.75 emission 0.1 0.2 0.3 shininess 12 opacity 1
0: 10 20 30 | 0 0 1 | 0 0 | 0
1: 12 20 30 | 0 0 1 | 1 0 | 1
2: 12 23 30 | 0 0 1 | 1 1 | 2
3: 10 23 30 | 0 0 1 | 0 0.5 | 3
part 'place' material 0, 2 from 0: 0-1-2 0-2-3
)");
}
