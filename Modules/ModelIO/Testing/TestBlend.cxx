// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkGltfMaker.h"
#include "dgtkModelCache.h"
#include "dgtkModelChecks.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <thread>

using namespace dgtk::test;
using testing::ElementsAre;
using testing::HasSubstr;

namespace
{
/// A folder with a model, and a program in Blender's place.
class BlendFolder
{
public:
  BlendFolder()
  {
    std::filesystem::create_directories(this->Folder.path("bin"));
    std::filesystem::create_directories(this->Folder.path("scene"));
    dgtk::writeFile(this->Folder.path("scene/a.blend"), "BLENDER-v304");
  }
  ~BlendFolder() { ::unsetenv("DGTK_BLENDER"); }
  BlendFolder(const BlendFolder&) = delete;
  BlendFolder& operator=(const BlendFolder&) = delete;

  std::string path(const std::string& name) const { return this->Folder.path(name); }
  /// The last three arguments are the file, the model and the list.
  void program(const std::string& script) const
  {
    dgtk::writeFile(this->path("bin/blender"),
      "#!/bin/sh\nfor word in \"$@\"; do blend=$model; model=$files; files=$word; done\n" + script + '\n');
    std::filesystem::permissions(this->path("bin/blender"), std::filesystem::perms::owner_all);
    ::setenv("DGTK_BLENDER", this->path("bin/blender").c_str(), 1);
  }
  std::string refusal() const
  {
    const std::string text = thrownBy<dgtk::InputError>([&] { dgtk::readModel(this->path("scene/a.blend")); });
    return text.empty() ? text : text.substr(this->path("scene/").size());
  }

private:
  TemporaryFolder Folder;
};

/// One triangle with colours of its vertices.
std::string glb(const std::string& name = "Thing")
{
  GltfMaker maker;
  const int positions = maker.floats("VEC3", { 1, 0, 0, 0, 1, 0, 0, 0, 1 });
  maker.json["scenes"] = { { { "nodes", { 0 } } } };
  maker.json["nodes"] = { { { "mesh", 0 }, { "name", name } } };
  const int colors = maker.floats("VEC3", { 1, 0, 0, 0, 1, 0, 0, 0, 1 });
  maker.json["meshes"] = {
    { { "primitives", { { { "attributes", { { "POSITION", positions }, { "COLOR_0", colors } } } } } } }
  };
  return maker.glb();
}
} // namespace

TEST(Blend, IsRefusedWithTheWayOutWithoutBlender)
{
  const BlendFolder folder;
  for (const char* program : { "/nowhere/blender", "/etc/passwd", "/" })
  {
    ::setenv("DGTK_BLENDER", program, 1);
    EXPECT_EQ(folder.refusal(), "a.blend: Blender's own files are read by Blender, which is not installed: install it "
                                "(DGTK_BLENDER can name it), "
                                "or choose File > Export > glTF 2.0 in it and use the .glb file")
      << program;
  }
}

TEST(Blend, IsWhatBlenderMakesOfIt)
{
  const BlendFolder folder;
  dgtk::writeFile(folder.path("bin/made.glb"), glb());
  dgtk::writeFile(folder.path("scene/tiles.png"), "");
  dgtk::writeFile(folder.path("stone.png"), "");
  folder.program("case \"$*\" in '--background --factory-startup --disable-autoexec -noaudio '*) ;; *) exit 5;; esac\n"
                 "[ \"$blend\" = '" +
                 folder.path("scene/a.blend") + "' ] || exit 6\n[ \"$HOME\" = \"${model%/*}\" ] || exit 7\ncp '" +
                 folder.path("bin/made.glb") + "' \"$model\"\nprintf '%s\\n%s\\n/etc/passwd\\n/nowhere\\n%s' '" +
                 folder.path("scene/tiles.png") + "' '" + folder.path("stone.png") + "' '" + folder.path("stone.png") +
                 "' > \"$files\"");
  const auto model = dgtk::readModel(folder.path("scene/a.blend"));
  EXPECT_EQ(model->format, "blend");
  EXPECT_FALSE(model->isNumbered);
  EXPECT_EQ(model->path, folder.path("scene/a.blend"));
  EXPECT_EQ(model->triangles.size(), 1u);
  EXPECT_EQ(model->parts.at(0).name, "Thing");
  EXPECT_TRUE(model->colors.empty());
  EXPECT_THAT(model->warnings, ElementsAre("colours of vertices are not drawn"));
  EXPECT_THAT(model->companions, ElementsAre(folder.path("scene/tiles.png"), folder.path("stone.png")));
}

TEST(Blend, IsKeptAsLongAsItsFilesAndBlenderAreTheSame)
{
  const BlendFolder folder;
  const std::string stone = folder.path("stone.png");
  const std::string later = folder.path("scene/later.png");
  dgtk::writeFile(stone, "");
  std::filesystem::create_symlink("/etc/passwd", folder.path("scene/link.png"));
  const std::string script = "cp '" + folder.path("bin/made.glb") + "' \"$model\"; printf '%s\n%s\n%s' '" +
                             folder.path("scene/link.png") + "' '" + stone + "' '" + later + "' > \"$files\"";
  folder.program(script);
  dgtk::ReadOptions options;
  options.cache = std::make_shared<dgtk::ModelCache>(folder.path("cache"), std::uint64_t(1) << 30);
  // what Blender makes of it is another thing each time
  const auto read = [&](const std::string& name, const std::vector<std::string>& companions)
  {
    dgtk::writeFile(folder.path("bin/made.glb"), glb(name));
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    const auto model = dgtk::readModel(folder.path("scene/a.blend"), options);
    EXPECT_EQ(model->format, "blend");
    EXPECT_EQ(model->companions, companions);
    return model->parts.at(0).name;
  };
  EXPECT_EQ(read("1", { stone }), "1");
  EXPECT_EQ(read("2", { stone }), "1");
  dgtk::writeFile(stone, "changed");
  EXPECT_EQ(read("3", { stone }), "3");
  EXPECT_EQ(read("4", { stone }), "3");
  dgtk::writeFile(later, "");
  EXPECT_EQ(read("5", { later, stone }), "5");
  EXPECT_EQ(read("6", { later, stone }), "5");
  folder.program(script + "\n# another release");
  EXPECT_EQ(read("7", { later, stone }), "7");
  EXPECT_EQ(read("8", { later, stone }), "7");
}

TEST(Blend, WhatGoesWrongIsSaid)
{
  const BlendFolder folder;
  const std::string blender = "(" + folder.path("bin/blender") + ")";
  folder.program("exit 9");
  EXPECT_EQ(folder.refusal(), "a.blend: cannot be read by Blender " + blender + ", which ended with code 9");
  folder.program("true");
  EXPECT_EQ(folder.refusal(), "a.blend: cannot be read by Blender " + blender + ", which ended with code 0");
  folder.program("kill -SEGV $$");
  EXPECT_THAT(folder.refusal(), HasSubstr(" " + blender + ", which ended with "));
  folder.program("echo nonsense > \"$model\"; : > \"$files\"");
  EXPECT_THAT(folder.refusal(), HasSubstr("a.blend: what Blender makes of it cannot be read: "));
  std::filesystem::remove(folder.path("scene/a.blend"));
  EXPECT_EQ(folder.refusal(), "a.blend: no such file");
  std::filesystem::create_directory(folder.path("scene/a.blend"));
  EXPECT_EQ(folder.refusal(), "a.blend: is not a regular file");
}

TEST(Blend, ByBlenderItself)
{
  if (std::system("command -v blender > /dev/null") != 0)
  {
    GTEST_SKIP() << "Blender is not installed";
  }
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path("scene"));
  dgtk::writeFile(folder.path("stone.tga"), std::string("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\x18\0cba", 21));
  dgtk::writeFile(folder.path("make.py"), R"(
import bpy, sys
folder = sys.argv[-1]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.mesh.primitive_plane_add(size=2, location=(1, 2, 3))
floor = bpy.context.object
floor.name = "Floor"
material = bpy.data.materials.new("stone")
material.use_nodes = True
shader = material.node_tree.nodes["Principled BSDF"]
picture = material.node_tree.nodes.new("ShaderNodeTexImage")
picture.image = bpy.data.images.load(folder + "/stone.tga")
material.node_tree.links.new(picture.outputs["Color"], shader.inputs["Base Color"])
floor.data.materials.append(material)
bpy.ops.mesh.primitive_cube_add(size=1)
cube = bpy.context.object
cube.name = "Cube"
cube.keyframe_insert("location", frame=1)
cube.location = (0, 0, 4)
cube.keyframe_insert("location", frame=25)
bpy.ops.mesh.primitive_cube_add(size=9)
bpy.context.object.hide_render = True
bpy.ops.wm.save_as_mainfile(filepath=folder + "/scene/a.blend")
)");
  ASSERT_EQ(std::system(("blender --background --factory-startup --python '" + folder.path("make.py") + "' -- '" +
                         folder.path() + "' > /dev/null 2>&1")
                          .c_str()),
    0);
  const auto model = dgtk::readModel(folder.path("scene/a.blend"));
  EXPECT_EQ(brokenPromise(*model), "");
  EXPECT_EQ(model->triangles.size(), 14u) << "without what a render does not show";
  EXPECT_THAT(model->boundsMin, testing::Eq(Eigen::Vector3d(-0.5, -0.5, -0.5)));
  EXPECT_THAT(model->boundsMax, testing::Eq(Eigen::Vector3d(2, 3, 3))) << "Blender's own axes";
  ASSERT_EQ(model->textures.size(), 1u);
  EXPECT_EQ(model->textures[0].path, folder.path("scene/a.blend"));
  ASSERT_TRUE(model->textures[0].image);
  EXPECT_EQ(model->textures[0].image->rgba, (std::vector<std::uint8_t>{ 'a', 'b', 'c', 255 }));
  EXPECT_THAT(model->companions, ElementsAre(folder.path("stone.tga")));
  ASSERT_EQ(model->animations.size(), 1u);
  std::vector<Eigen::Vector3d> positions;
  model->deformation->positionsAt(0, model->animations[0].last, positions);
  double highest = 0;
  for (const Eigen::Vector3d& position : positions)
  {
    highest = std::max(highest, position.z());
  }
  EXPECT_GT(highest, 4.4) << "the cube moves up";
  dgtk::writeFile(folder.path("scene/b.blend"), "BLENDER-v304 and nothing more");
  EXPECT_THROW(dgtk::readModel(folder.path("scene/b.blend")), dgtk::InputError) << "not the scene that Blender has";
}
