// SPDX-License-Identifier: BSD-3-Clause
// Formats that are read through Assimp in dgtk-import, and what happens when that program fails.
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkHelperWall.h"
#include "dgtkModelChecks.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>

using namespace dgtk::test;
using testing::Contains;
using testing::HasSubstr;

namespace
{
const char* const quadObj = "mtllib quad.mtl\no Quad\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n"
                            "vt 0 1\nvn 0 0 1\nusemtl red\nf 1/1/1 2/2/1 3/3/1 4/4/1\nl 1 2 3\n";
const char* const quadMtl = "newmtl red\nKa 0.1 0.1 0.1\nKd 1 0.5 0\nKs 0.5 0.5 0.5\nNs 20\nd 0.5\nmap_Kd Tex.PPM\n";

std::string asciiStl()
{
  // a cube of side 2 about the origin, two triangles a side
  const double corners[6][4][3] = { { { -1, -1, 1 }, { 1, -1, 1 }, { 1, 1, 1 }, { -1, 1, 1 } },
    { { -1, 1, -1 }, { 1, 1, -1 }, { 1, -1, -1 }, { -1, -1, -1 } },
    { { 1, -1, -1 }, { 1, 1, -1 }, { 1, 1, 1 }, { 1, -1, 1 } },
    { { -1, -1, 1 }, { -1, 1, 1 }, { -1, 1, -1 }, { -1, -1, -1 } },
    { { -1, 1, -1 }, { -1, 1, 1 }, { 1, 1, 1 }, { 1, 1, -1 } },
    { { 1, -1, -1 }, { 1, -1, 1 }, { -1, -1, 1 }, { -1, -1, -1 } } };
  std::string text = "solid cube\n";
  for (const auto& side : corners)
  {
    for (const auto& triangle : { std::array<int, 3>{ 0, 1, 2 }, std::array<int, 3>{ 0, 2, 3 } })
    {
      text += "facet normal 0 0 0\nouter loop\n";
      for (const int corner : triangle)
      {
        text += "vertex";
        for (const double x : side[corner])
        {
          text += ' ' + std::to_string(x);
        }
        text += '\n';
      }
      text += "endloop\nendfacet\n";
    }
  }
  return text + "endsolid cube\n";
}

std::string binaryStl()
{
  std::string text(80, ' ');
  const std::uint32_t count = 1;
  const float numbers[12] = { 0, 0, 1, 0, 0, 5, 2, 0, 5, 0, 3, 5 };
  text.append(reinterpret_cast<const char*>(&count), 4);
  text.append(reinterpret_cast<const char*>(numbers), sizeof numbers);
  return text + std::string(2, '\0');
}

const char* const quadDae =
  R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="centimeter" meter="0.01"/><up_axis>Z_UP</up_axis></asset>
<library_effects><effect id="e"><profile_COMMON><technique sid="c"><phong><emission><color>0 0.1 0 1</color></emission>
<diffuse><color>0.2 0.4 0.6 1</color></diffuse></phong></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m" name="Blue"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g" name="Tri"><mesh><source id="p"><float_array id="a" count="12">
0 0 0 1 0 0 1 1 0 0 1 0</float_array><technique_common><accessor source="#a" count="4" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common>
</source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices><polylist material="M" count="1">
<input semantic="VERTEX" source="#v" offset="0"/><vcount>4</vcount><p>0 1 2 3</p></polylist></mesh></geometry>
</library_geometries><library_visual_scenes><visual_scene id="s"><node id="n" name="Node"><translate>0 0 5</translate>
<rotate>0 0 1 90</rotate><instance_geometry url="#g"><bind_material><technique_common>
<instance_material symbol="M" target="#m"/></technique_common></bind_material></instance_geometry></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";

const char* const quadFbx = R"(; FBX 7.3.0 project file
FBXHeaderExtension:  {
	FBXHeaderVersion: 1003
	FBXVersion: 7300
}
Objects:  {
	Geometry: 1000, "Geometry::Quad", "Mesh" {
		Vertices: *12 {
			a: 0,0,0,1,0,0,1,1,0,0,1,0
		}
		PolygonVertexIndex: *4 {
			a: 0,1,2,-4
		}
		GeometryVersion: 124
	}
	Model: 2000, "Model::Node", "Mesh" {
		Version: 232
		Properties70:  {
			P: "Lcl Translation", "Lcl Translation", "", "A",0,0,5
		}
	}
}
Connections:  {
	C: "OO",2000,0
	C: "OO",1000,2000
}
)";

/// Sets DGTK_IMPORT for as long as it lives.
class OtherImporter
{
public:
  explicit OtherImporter(const std::string& script)
    : Path(this->Folder.path("importer"))
  {
    dgtk::writeFile(this->Path, "#!/bin/sh\n" + script + "\n");
    std::filesystem::permissions(this->Path, std::filesystem::perms::owner_all);
    ::setenv("DGTK_IMPORT", this->Path.c_str(), 1);
  }
  ~OtherImporter() { ::unsetenv("DGTK_IMPORT"); }
  OtherImporter(const OtherImporter&) = delete;
  OtherImporter& operator=(const OtherImporter&) = delete;

private:
  TemporaryFolder Folder;
  std::string Path;
};
} // namespace

TEST(Assimp, ObjWithMaterialAndTextureFoundInAnyCase)
{
  const TemporaryFolder folder;
  dgtk::writeFile(folder.path("quad.obj"), quadObj);
  dgtk::writeFile(folder.path("QUAD.MTL"), quadMtl);
  dgtk::writeFile(folder.path("tex.ppm"), std::string("P6 1 1 255\n") + "abc");
  const auto model = dgtk::readModel(folder.path("quad.obj"));
  EXPECT_EQ(brokenPromise(*model), "");
  EXPECT_EQ(model->format, "obj");
  ASSERT_EQ(model->triangles.size(), 2u);
  EXPECT_EQ(model->sourceVertices, 4u);
  EXPECT_EQ(model->lines, 2u);
  EXPECT_EQ(model->declaredMaterials, 1u);
  EXPECT_EQ(model->parts[0].name, "Quad");
  const dgtk::Material& red = model->materials[static_cast<std::size_t>(model->parts[0].material)];
  EXPECT_EQ(red.name, "red");
  EXPECT_LT((red.diffuse - Eigen::Vector3d(1, 0.5, 0)).norm(), 1e-6);
  EXPECT_LT((red.ambient - Eigen::Vector3d(0.1, 0.1, 0.1)).norm(), 1e-6);
  EXPECT_DOUBLE_EQ(red.shininess, 20);
  EXPECT_DOUBLE_EQ(red.opacity, 0.5);
  ASSERT_GE(red.texture, 0);
  const dgtk::Texture& texture = model->textures[static_cast<std::size_t>(red.texture)];
  EXPECT_EQ(texture.path, folder.path("tex.ppm"));
  ASSERT_TRUE(texture.image);
  EXPECT_EQ(texture.image->rgba, (std::vector<std::uint8_t>{ 'a', 'b', 'c', 255 }));
  for (std::size_t i = 0; i < 4; ++i)
  {
    EXPECT_EQ(model->uvs[i], Eigen::Vector2d(model->rest->positions[i].head<2>()));
  }
}

TEST(Assimp, ObjWithoutItsMaterialsSaysSo)
{
  const auto model = readBytes("obj", quadObj);
  EXPECT_EQ(model->triangles.size(), 2u);
  EXPECT_THAT(model->warnings, Contains(HasSubstr("quad.mtl not found")));
}

TEST(Assimp, ObjKeepsConcavePolygonsAndOrder)
{
  const auto model =
    readBytes("obj", "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nv 9 9 9\ng b\nf 1 2 3 4 5\ng a\nf 1 2 6\n");
  ASSERT_EQ(model->triangles.size(), 4u);
  ASSERT_EQ(model->parts.size(), 2u);
  EXPECT_EQ(model->parts[0].name, "b");
  double area = 0;
  for (std::size_t t = 0; t < 3; ++t)
  {
    const auto& p = model->rest->positions;
    const auto& c = model->triangles[t];
    area +=
      0.5 * ((p[c[1]] - p[c[0]]).x() * (p[c[2]] - p[c[0]]).y() - (p[c[1]] - p[c[0]]).y() * (p[c[2]] - p[c[0]]).x());
  }
  EXPECT_DOUBLE_EQ(area, 16 - 6); // the notch is a triangle of area 6
}

TEST(Assimp, StlAsciiAndBinary)
{
  const auto cube = readBytes("stl", asciiStl());
  EXPECT_EQ(brokenPromise(*cube), "");
  EXPECT_EQ(cube->triangles.size(), 12u);
  EXPECT_EQ(cube->sourceVertices, 8u);
  EXPECT_EQ(cube->rest->positions.size(), 24u); // flat: four corners a side
  EXPECT_EQ(cube->boundsMin, Eigen::Vector3d(-1, -1, -1));
  EXPECT_EQ(cube->boundsMax, Eigen::Vector3d(1, 1, 1));
  for (const auto& t : cube->triangles)
  {
    EXPECT_GT(cube->rest->normals[t[0]].cast<double>().dot(cube->rest->positions[t[0]]), 0.99); // outside is outside
  }
  const auto one = readBytes("stl", binaryStl());
  EXPECT_EQ(one->triangles.size(), 1u);
  EXPECT_EQ(one->boundsMax, Eigen::Vector3d(2, 3, 5));
}

TEST(Assimp, Off)
{
  const auto model = readBytes("off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
  EXPECT_EQ(brokenPromise(*model), "");
  EXPECT_EQ(model->triangles.size(), 2u);
  EXPECT_EQ(model->sourceVertices, 4u);
  EXPECT_EQ(model->rest->normals[0], Eigen::Vector3f(0, 0, 1));
}

TEST(Assimp, ColladaStaysInItsOwnAxesAndUnits)
{
  const auto model = readBytes("dae", quadDae);
  EXPECT_EQ(brokenPromise(*model), "");
  EXPECT_EQ(model->format, "collada");
  ASSERT_EQ(model->triangles.size(), 2u);
  EXPECT_LT((model->boundsMin - Eigen::Vector3d(-1, 0, 5)).norm(), 1e-6);
  EXPECT_LT((model->boundsMax - Eigen::Vector3d(0, 1, 5)).norm(), 1e-6);
  const dgtk::Material& blue = model->materials[static_cast<std::size_t>(model->parts[0].material)];
  EXPECT_EQ(blue.name, "Blue");
  EXPECT_LT((blue.diffuse - Eigen::Vector3d(0.2, 0.4, 0.6)).norm(), 1e-6);
  EXPECT_LT((blue.emission - Eigen::Vector3d(0, 0.1, 0)).norm(), 1e-6);
}

TEST(Assimp, FbxText)
{
  const auto model = readBytes("fbx", quadFbx);
  EXPECT_EQ(brokenPromise(*model), "");
  ASSERT_EQ(model->triangles.size(), 2u);
  EXPECT_EQ(model->sourceVertices, 4u);
  EXPECT_EQ(model->boundsMax, Eigen::Vector3d(1, 1, 5));
}

TEST(Assimp, TheImportersComplaintIsTheMessage)
{
  EXPECT_THAT(refusal("fbx", "this is no model\n"), HasSubstr("model.fbx: cannot be read: "));
  EXPECT_THAT(refusal("glb", "glTF"), HasSubstr("model.glb: cannot be read: "));
  EXPECT_EQ(refusal("dae", "<a>\n\n</b>").find('\n'), std::string::npos);
  EXPECT_THROW(dgtk::readModel("/nowhere/x.obj"), dgtk::InputError);
  EXPECT_THROW(dgtk::readModel("/dev/null/x.obj"), dgtk::InputError);
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path("x.obj"));
  EXPECT_THROW(dgtk::readModel(folder.path("x.obj")), dgtk::InputError);
}

TEST(Assimp, AnImporterThatDiesIsAnInputError)
{
  const auto expectMessage = [](const std::string& script, const std::string& message)
  {
    const OtherImporter other(script);
    try
    {
      readBytes("obj", quadObj);
      FAIL() << script;
    }
    catch (const dgtk::InputError& error)
    {
      EXPECT_THAT(error.what(), HasSubstr(message)) << script;
      EXPECT_EQ(error.code(), dgtk::ExitCode::Input);
    }
  };
  expectMessage("kill -ABRT $$", "model.obj: is damaged: its importer ended abnormally (signal 6, Aborted)");
  expectMessage("kill -SEGV $$", "(signal 11");
  expectMessage("kill -XCPU $$", "took more processor time or memory than allowed");
  expectMessage("exit 3", "(incomplete answer)");
  expectMessage("printf 'DGI1'; exit 0", "(incomplete answer)");
  // a count of 2^64 - 1
  expectMessage("printf 'DGI1\\0\\0\\0\\0\\0\\0\\0\\0\\377\\377\\377\\377\\377\\377\\377\\377'", "(incomplete answer)");
  expectMessage("yes nonsense | head -c 1000000", "(incomplete answer)");
}

TEST(Assimp, AMissingImporterIsTheMachinesFault)
{
  ::setenv("DGTK_IMPORT", "/nowhere/dgtk-import", 1);
  EXPECT_THROW(readBytes("obj", quadObj), dgtk::MachineError);
  ::unsetenv("DGTK_IMPORT");
  EXPECT_EQ(readBytes("obj", quadObj)->triangles.size(), 2u);
}

TEST(Assimp, BlendIsRefusedWithTheWayOut)
{
  EXPECT_THAT(refusal("blend", "BLENDER-v300"), HasSubstr("File > Export > glTF 2.0"));
}

TEST(Assimp, FilesOutsideOfTheModelsFolderAreRefused)
{
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path("model/parts"));
  dgtk::writeFile(folder.path("secret.bin"), std::string(36, '\0'));
  dgtk::writeFile(folder.path("quad.mtl"), quadMtl);
  dgtk::writeFile(folder.path("model/parts/quad.mtl"), quadMtl);
  const auto refusalOf = [&folder](const std::string& name, const std::string& text) -> std::string
  {
    dgtk::writeFile(folder.path("model/" + name), text);
    try
    {
      dgtk::readModel(folder.path("model/" + name));
    }
    catch (const dgtk::InputError& error)
    {
      return error.what();
    }
    return {};
  };
  const auto gltf = [](const std::string& uri)
  {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"buffers":[{"byteLength":36,"uri":")" +
           uri + R"("}],"bufferViews":[{"buffer":0,"byteLength":36}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[0,0,0]}]})";
  };
  EXPECT_THAT(refusalOf("a.gltf", gltf("../secret.bin")),
    HasSubstr("a.gltf: names the file '../secret.bin', which lies outside of the model's folder"));
  EXPECT_THAT(refusalOf("a.gltf", gltf("parts/../../secret.bin")), HasSubstr("outside of the model's folder"));
  EXPECT_THAT(refusalOf("a.gltf", gltf("%2e%2E/secret.bi%6e")), HasSubstr("'../secret.bin', which lies outside"));
  std::filesystem::create_symlink(folder.path("secret.bin"), folder.path("model/link.bin"));
  EXPECT_THAT(refusalOf("a.gltf", gltf("link.bin")), HasSubstr("'link.bin', which lies outside"));
  const auto obj = [](const std::string& library)
  { return "mtllib " + library + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n"; };
  EXPECT_EQ(refusalOf("a.obj", obj(folder.path("quad.mtl"))), "") << "the importer takes it as relative";
  EXPECT_THAT(dgtk::readModel(folder.path("model/a.obj"))->warnings, Contains(HasSubstr("quad.mtl not found")));
  EXPECT_THAT(refusalOf("a.obj", obj("../quad.mtl")), HasSubstr("'../quad.mtl', which lies outside"));
  EXPECT_EQ(refusalOf("a.obj", obj("/nowhere/quad.mtl")), "");
  EXPECT_EQ(refusalOf("a.obj", obj("parts/quad.mtl")), "");
  EXPECT_EQ(dgtk::readModel(folder.path("model/a.obj"))->materials.back().name, "red");
  dgtk::writeFile(folder.path("model/quad.mtl"), quadMtl);
  EXPECT_EQ(refusalOf("a.obj", obj("../quad.mtl")), "") << "its base name is beside the model";
}

// Animations are read by us, geometry by the importer: both must find the same file.
TEST(Assimp, BuffersBesideTheModel)
{
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path("parts"));
  const float numbers[] = { 0, 0, 0, 1, 0, 0, 0, 1, 0, /* times */ 0, 1, /* places */ 0, 0, 0, 0, 0, 8 };
  const std::string bytes(reinterpret_cast<const char*>(numbers), sizeof numbers);
  const auto read = [&folder](const std::string& uri)
  {
    dgtk::writeFile(folder.path("a.gltf"),
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"buffers":[{"byteLength":68,"uri":")" +
        uri + R"("}],"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":32}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5126,"count":2,"type":"SCALAR","min":[0],"max":[1]},
{"bufferView":1,"byteOffset":8,"componentType":5126,"count":2,"type":"VEC3"}],
"animations":[{"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}],
"samplers":[{"input":1,"output":2}]}]})");
    return dgtk::readModel(folder.path("a.gltf"));
  };
  const std::pair<const char*, const char*> table[] = { { "b.bin", "b.bin" }, { "parts/b.bin", "parts/b.bin" },
    { "my%20b.bin", "my b.bin" }, { "b.bi%6E", "b.bin" }, { "b%2ebin", "b.bin" }, { "50%.bin", "50%.bin" },
    { "b%2", "b%2" } };
  for (const auto& [uri, file] : table)
  {
    dgtk::writeFile(folder.path(file), bytes);
    try
    {
      const auto model = read(uri);
      std::vector<Eigen::Vector3d> positions;
      ASSERT_TRUE(model->deformation) << uri;
      model->deformation->positionsAt(0, model->animations.at(0).last, positions);
      EXPECT_EQ(positions.at(0), Eigen::Vector3d(0, 0, 8)) << uri;
    }
    catch (const dgtk::InputError& error)
    {
      ADD_FAILURE() << uri << ": " << error.what();
    }
    std::filesystem::remove(folder.path(file));
  }
  try
  {
    read("b.bin");
    ADD_FAILURE();
  }
  catch (const dgtk::InputError& error)
  {
    EXPECT_THAT(error.what(), HasSubstr("b.bin"));
  }
}

TEST(Assimp, ANumberOfTooManyDigitsIsRefusedAtOnce)
{
  const std::string many(3'000'000, '1');
  EXPECT_EQ(refusal("obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 " + many + "\n"),
    "model.obj:4: cannot be read: a number has more than 1000 digits");
  EXPECT_THAT(refusal("off", "OFF\n4 2 " + many + '\n'), HasSubstr("model.off:2: "));
  EXPECT_EQ(refusal("obj", "v 0 0 0\nv 1 0 0\nv 0 1 0.0" + std::string(900, '1') + "\nf 1 2 3\n"), "");
  const TemporaryFolder folder;
  dgtk::writeFile(folder.path("quad.obj"), quadObj);
  dgtk::writeFile(folder.path("quad.mtl"), "newmtl red\nNs " + many + '\n');
  try
  {
    dgtk::readModel(folder.path("quad.obj"));
    FAIL();
  }
  catch (const dgtk::InputError& error)
  {
    EXPECT_EQ(error.file(), folder.path("quad.mtl"));
    EXPECT_EQ(error.line(), 2);
  }
}

TEST(Assimp, TooMuchMemoryIsSaidInWords)
{
  if (dgtk::helper::isSanitized)
  {
    GTEST_SKIP() << "sanitizers end a process that asks for too much";
  }
  EXPECT_EQ(refusal("off", "OFF\n4000000000 4000000000 0\n0 0 0\n"),
    "model.off: cannot be read: needs more memory than a file of its size may");
}
