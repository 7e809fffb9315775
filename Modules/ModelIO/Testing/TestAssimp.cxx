// SPDX-License-Identifier: BSD-3-Clause
// Formats that are read through Assimp in dgtk-import, and what happens when that program fails.
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkHelperWall.h"
#include "dgtkModelChecks.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

using namespace dgtk::test;
using testing::HasSubstr;

namespace
{
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

TEST(Assimp, ColladaStaysInItsOwnAxesAndUnits)
{
  const auto model = readBytes("dae", quadDae);
  EXPECT_EQ(brokenPromise(*model), "");
  EXPECT_EQ(model->format, "collada");
  EXPECT_FALSE(model->isNumbered);
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
  EXPECT_FALSE(model->isNumbered);
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
    EXPECT_THAT(thrownBy<dgtk::InputError>([&] { readBytes("fbx", quadFbx); }), HasSubstr(message)) << script;
  };
  EXPECT_EQ(dgtk::InputError("", "").code(), dgtk::ExitCode::Input);
  expectMessage("kill -ABRT $$", "model.fbx: is damaged: its importer ended abnormally (signal 6, Aborted)");
  expectMessage("kill -SEGV $$", "(signal 11");
  expectMessage("kill -XCPU $$", "took more processor time or memory than allowed");
  expectMessage("exit 3", "(incomplete answer)");
  expectMessage("printf 'DGI1'; exit 0", "(incomplete answer)");
  // a count of 2^64 - 1
  expectMessage("printf 'DGI1\\0\\0\\0\\0\\0\\0\\0\\0\\377\\377\\377\\377\\377\\377\\377\\377'", "(incomplete answer)");
  expectMessage("yes nonsense | head -c 1000000", "(incomplete answer)");
}

namespace
{
/// Parent of a process, 0 when there is none of that number.
int parentOf(int process)
{
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string words;
  std::getline(file, words);
  const std::size_t name = words.rfind(')');
  return name == std::string::npos ? 0 : std::atoi(words.c_str() + name + 4);
}

/// Kills the first copy that a program started by this one makes of itself within some seconds.
bool killCopy()
{
  const auto start = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - start < std::chrono::seconds(20))
  {
    for (const auto& entry : std::filesystem::directory_iterator("/proc"))
    {
      const int process = std::atoi(entry.path().filename().c_str());
      if (process > 0 && parentOf(parentOf(process)) == ::getpid() && ::kill(process, SIGUSR1) == 0)
      {
        return true;
      }
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}
} // namespace

TEST(Assimp, OneProgramImportsAllModelsAndACrashCostsOne)
{
  const TemporaryFolder folder;
  const std::string real = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "dgtk-import";
  const OtherImporter counted("echo started >> '" + folder.path("log") + "'; exec '" + real + "'");
  const auto reads = []
  {
    for (int i = 0; i < 3; ++i)
    {
      EXPECT_EQ(readBytes("fbx", quadFbx)->triangles.size(), 2u);
      EXPECT_THAT(refusal("glb", "glTF"), HasSubstr("model.glb: cannot be read: "));
    }
  };
  std::thread beside(reads);
  reads();
  beside.join();
  std::string large = quadFbx;
  std::string faces;
  for (int i = 0; i < 400000; ++i)
  {
    faces += "0,1,-3,";
  }
  large.insert(large.find("0,1,2,-4"), faces);
  bool killed = false;
  std::thread killer([&killed] { killed = killCopy(); });
  const std::string said = refusal("fbx", large);
  killer.join();
  ASSERT_TRUE(killed);
  EXPECT_THAT(said, HasSubstr("model.fbx: is damaged: its importer ended abnormally (signal 10"));
  reads();
  EXPECT_EQ(dgtk::readFile(folder.path("log")), "started\n");
}

TEST(Assimp, AnInterruptionIsNoDamage)
{
  for (const char* signal : { "INT", "TERM", "HUP" })
  {
    const OtherImporter interrupted(std::string("kill -") + signal + " $$");
    EXPECT_THROW(readBytes("fbx", quadFbx), dgtk::MachineError) << signal;
  }
}

TEST(Assimp, AMissingImporterIsTheMachinesFault)
{
  ::setenv("DGTK_IMPORT", "/nowhere/dgtk-import", 1);
  EXPECT_THROW(readBytes("fbx", quadFbx), dgtk::MachineError);
  ::unsetenv("DGTK_IMPORT");
  EXPECT_EQ(readBytes("fbx", quadFbx)->triangles.size(), 2u);
}

TEST(Assimp, FilesOutsideOfTheModelsFolderAreRefused)
{
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path("model/parts"));
  dgtk::writeFile(folder.path("secret.bin"), std::string(36, '\0'));
  const auto refusalOf = [&folder](const std::string& name, const std::string& text) -> std::string
  {
    dgtk::writeFile(folder.path("model/" + name), text);
    return thrownBy<dgtk::InputError>([&] { dgtk::readModel(folder.path("model/" + name)); });
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
  dgtk::writeFile(folder.path("model/SECRET.BIN"), std::string(36, '\0'));
  EXPECT_EQ(refusalOf("a.gltf", gltf("../secret.bin")), "") << "its base name is beside the model, in another case";
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
  EXPECT_THAT(thrownBy<dgtk::InputError>([&] { read("b.bin"); }), HasSubstr("b.bin"));
}

TEST(Assimp, ANumberOfTooManyDigitsIsRefusedAtOnce)
{
  const auto withTranslation = [](const std::string& z)
  {
    std::string text = quadDae;
    text.insert(text.find("5</translate>"), z);
    return text;
  };
  EXPECT_EQ(refusal("dae", withTranslation(std::string(3'000'000, '1'))),
    "model.dae:11: cannot be read: a number has more than 1000 digits");
  EXPECT_EQ(refusal("dae", withTranslation("0." + std::string(900, '1'))), "");
}

TEST(Assimp, TooMuchMemoryIsSaidInWords)
{
  if (dgtk::helper::isSanitized)
  {
    GTEST_SKIP() << "sanitizers end a process that asks for too much";
  }
  std::string text = quadDae;
  const std::string count = "count=\"12\"";
  text.replace(text.find(count), count.size(), "count=\"4000000000\"");
  EXPECT_EQ(refusal("dae", text), "model.dae: cannot be read: needs more memory than a file of its size may");
}
