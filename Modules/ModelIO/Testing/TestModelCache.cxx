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

#include <sys/stat.h>
#include <unistd.h>

using namespace dgtk::test;
using dgtk::Model;
using testing::HasSubstr;
namespace fs = std::filesystem;

namespace
{
/// Models large enough to be kept, and where they are kept. Files are older than the time in which a change is not
/// seen.
class Kept
{
public:
  explicit Kept(std::uint64_t bytes = std::uint64_t(1) << 30)
    : Cache(std::make_shared<dgtk::ModelCache>(Folder.path("cache"), bytes))
  {
    fs::create_directories(this->Folder.path("models"));
  }
  std::string path(const std::string& name) const { return this->Folder.path("models/" + name); }
  std::string write(const std::string& name, const std::string& bytes) const
  {
    fs::create_directories(fs::path(this->path(name)).parent_path());
    dgtk::writeFile(this->path(name), bytes);
    return this->path(name);
  }
  std::shared_ptr<const Model> read(const std::string& path, bool kept = true) const
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    dgtk::ReadOptions options;
    options.cache = kept ? this->Cache : nullptr;
    return dgtk::readModel(path, options);
  }
  std::vector<fs::path> files() const
  {
    std::vector<fs::path> files;
    for (const auto& file : fs::directory_iterator(this->Cache->folder()))
    {
      files.push_back(file.path());
    }
    return files;
  }
  std::size_t count() const { return fs::exists(this->Cache->folder()) ? this->files().size() : 0; }
  std::string folder() const { return this->Cache->folder(); }
  /// Whether a model is taken from what is kept: what is kept of it is replaced by what is kept of another.
  bool isFound(const std::string& path, const std::string& other) const
  {
    fs::remove_all(this->folder());
    this->read(other);
    const fs::path of = this->files().at(0);
    const std::string bytes = dgtk::readFile(of);
    fs::remove(of);
    const std::string right = this->keptText(path);
    dgtk::writeFile(this->files().at(0).string(), bytes);
    return this->keptText(path) != right;
  }

private:
  std::string keptText(const std::string& path) const { return this->read(path)->parts.at(0).name; }
  TemporaryFolder Folder;
  std::shared_ptr<dgtk::ModelCache> Cache;
};

std::string largeObj(const std::string& name, const std::string& head = "", int rows = 8000)
{
  std::string text = head + "o " + name + '\n';
  for (int i = 0; i < rows; ++i)
  {
    const std::string x = std::to_string(i);
    text += "v " + x + ".25 0 0\nv " + x + " 1 0.125\nv " + x + " 0 -3\nvt 0." + x + " 0.5\nf -3/-1 -2/-1 -1/-1\n";
  }
  return text;
}

std::string largeStl(int triangles)
{
  std::string bytes(80, ' ');
  const auto add = [&bytes](auto value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  add(std::uint32_t(triangles));
  for (int i = 0; i < triangles; ++i)
  {
    for (int k = 0; k < 12; ++k)
    {
      add(k < 3 ? 0.0f : float((i * 7 + k * k * 13) % 101));
    }
    add(std::uint16_t(0));
  }
  return bytes;
}

std::string largePly(int triangles)
{
  std::string text = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                     "element face " +
                     std::to_string(triangles) +
                     "\nproperty list uchar int vertex_indices\nend_header\n"
                     "0 0 0\n1 0 0\n0 1 0.5\n";
  for (int i = 0; i < triangles; ++i)
  {
    text += i % 2 == 0 ? "3 0 1 2\n" : "3 2 1 0\n";
  }
  return text;
}

/// A triangle that slides by 1 a second, of a material whose picture is in the file and has a cut-off of its own.
std::string slidingGlb(const std::string& picture)
{
  GltfMaker maker;
  const int positions = maker.floats("VEC3", { 1, 0, 0, 0, 1, 0, 0, 0, 1 });
  const int uvs = maker.floats("VEC2", { 0, 0, 1, 0, 0, 1 });
  const int times = maker.floats("SCALAR", { 0, 1 });
  const int moves = maker.floats("VEC3", { 0, 0, 0, 1, 0, 0 });
  maker.json["scenes"] = { { { "nodes", { 0 } } } };
  maker.json["nodes"] = { { { "mesh", 0 }, { "name", "Thing" } } };
  maker.json["meshes"] = { { { "primitives",
    { { { "attributes", { { "POSITION", positions }, { "TEXCOORD_0", uvs } } }, { "material", 0 } } } } } };
  maker.json["materials"] = { { { "name", "leaf" }, { "alphaMode", "MASK" }, { "alphaCutoff", 0.9 },
    { "emissiveTexture", { { "index", 1 } } },
    { "pbrMetallicRoughness", { { "baseColorTexture", { { "index", 0 } } }, { "metallicFactor", 0.25 } } } } };
  maker.json["images"] = { { { "name", "leaves" }, { "mimeType", "image/png" },
    { "bufferView", maker.view(picture) } } };
  maker.json["textures"] = { { { "source", 0 }, { "sampler", 0 } }, { { "source", 0 } } };
  maker.json["samplers"] = { { { "wrapS", 33071 }, { "wrapT", 33648 } } };
  maker.json["animations"] = { { { "name", "Slide" },
    { "channels", { { { "sampler", 0 }, { "target", { { "node", 0 }, { "path", "translation" } } } } } },
    { "samplers", { { { "input", times }, { "output", moves } } } } } };
  return maker.glb();
}

void expectEqual(const Model& a, const Model& b)
{
  EXPECT_EQ(a.format, b.format);
  EXPECT_EQ(a.path, b.path);
  EXPECT_EQ(a.warnings, b.warnings);
  EXPECT_EQ(a.companions, b.companions);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.rest->positions, b.rest->positions);
  EXPECT_EQ(a.rest->normals, b.rest->normals);
  EXPECT_EQ(a.uvs, b.uvs);
  EXPECT_EQ(a.unplaced, b.unplaced);
  EXPECT_EQ(a.sourceVertex, b.sourceVertex);
  EXPECT_EQ(a.normalGroup, b.normalGroup);
  const auto counts = [](const Model& m)
  {
    return std::vector<std::size_t>{ m.sourceVertices, std::size_t(m.frames), m.lines, m.declaredTriangles,
      m.twoSidedTriangles, m.twoSidedSurfaces, m.declaredMaterials, m.parts.size(), m.materials.size(),
      m.textures.size(), m.animations.size() };
  };
  ASSERT_EQ(counts(a), counts(b));
  EXPECT_EQ(a.boundsMin, b.boundsMin);
  EXPECT_EQ(a.boundsMax, b.boundsMax);
  for (std::size_t i = 0; i < a.parts.size(); ++i)
  {
    EXPECT_EQ(a.parts[i].name, b.parts[i].name);
    EXPECT_EQ(a.parts[i].material, b.parts[i].material);
    EXPECT_EQ(a.parts[i].firstTriangle, b.parts[i].firstTriangle);
    EXPECT_EQ(a.parts[i].triangles, b.parts[i].triangles);
  }
  for (std::size_t i = 0; i < a.textures.size(); ++i)
  {
    EXPECT_EQ(a.textures[i].name, b.textures[i].name);
    EXPECT_EQ(a.textures[i].path, b.textures[i].path);
    EXPECT_EQ(a.textures[i].wrap, b.textures[i].wrap);
    ASSERT_EQ(a.textures[i].image != nullptr, b.textures[i].image != nullptr);
    EXPECT_TRUE(!a.textures[i].image || a.textures[i].image->rgba == b.textures[i].image->rgba);
  }
  for (std::size_t i = 0; i < a.animations.size(); ++i)
  {
    EXPECT_EQ(a.animations[i].name, b.animations[i].name);
    EXPECT_EQ(a.animations[i].last, b.animations[i].last);
    EXPECT_EQ(a.animations[i].fps, b.animations[i].fps);
    EXPECT_EQ(a.animations[i].length, b.animations[i].length);
    EXPECT_EQ(geometryAt(a, int(i), 11.5)->positions, geometryAt(b, int(i), 11.5)->positions);
    EXPECT_EQ(geometryAt(a, int(i), 11.5)->normals, geometryAt(b, int(i), 11.5)->normals);
  }
}

void expectEqualMaterials(const Model& a, const Model& b)
{
  ASSERT_EQ(a.materials.size(), b.materials.size());
  for (std::size_t i = 0; i < a.materials.size(); ++i)
  {
    const dgtk::Material& m = a.materials[i];
    const dgtk::Material& n = b.materials[i];
    EXPECT_EQ(m.name, n.name);
    EXPECT_EQ(m.ambient, n.ambient);
    EXPECT_EQ(m.diffuse, n.diffuse);
    EXPECT_EQ(m.specular, n.specular);
    EXPECT_EQ(m.emission, n.emission);
    const auto numbers = [](const dgtk::Material& x)
    {
      return std::vector<double>{ x.shininess, x.opacity, double(x.twoSided), double(x.texture), double(x.cutOut),
        double(x.physical.has_value()), x.physical ? x.physical->metallic : 0, x.physical ? x.physical->roughness : 0,
        double(x.normalMap), double(x.bumpMap), double(x.metallicRoughnessMap), double(x.emissionMap),
        double(x.occlusionMap), x.normalScale, x.bumpScale, x.occlusionStrength, double(x.isBare), double(x.isDark) };
    };
    EXPECT_EQ(numbers(m), numbers(n));
  }
}
} // namespace

TEST(ModelCache, AKeptModelIsTheModel)
{
  const Kept kept;
  const std::string leaves = dgtk::readFile(sourceFile("Data/Textures/leaves.png"));
  kept.write("leaves.png", leaves);
  kept.write("a.mtl", "newmtl m\nKd 0.1 0.2 0.3\nKs 1 0 0\nNs 20\nmap_Kd leaves.png\nnewmtl n\nd 0.5\nmap_Kd "
                      "none.png\nKe 1 1 1\nmap_Ke none.png\nnewmtl o\nd 0\n");
  const std::string head = "mtllib a.mtl\nmtllib missing.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl o\nf 1 2 3\nusemtl n\n"
                           "f 3 2 1\nf 1 9999999 2\nl 1 2\nusemtl m\n";
  for (const std::string& path :
    { kept.write("a.obj", largeObj("thing", head, 1500)), kept.write("b.stl", largeStl(6000)),
      kept.write("c.ply", largePly(10000)), kept.write("d.glb", slidingGlb(leaves)),
      kept.write("e.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n" + std::string(70'000, '#')),
      kept.write("f.glb", slidingGlb("no picture")) })
  {
    SCOPED_TRACE(path);
    const std::size_t before = kept.count();
    const auto first = kept.read(path);
    EXPECT_EQ(kept.count(), before + 1);
    const auto second = kept.read(path);
    EXPECT_EQ(brokenPromise(*second), "");
    expectEqual(*kept.read(path, false), *first);
    expectEqualMaterials(*kept.read(path, false), *first);
    expectEqual(*first, *second);
    expectEqualMaterials(*first, *second);
  }
  const auto leaf = kept.read(kept.path("d.glb"));
  EXPECT_TRUE(leaf->materials[0].cutOut);
  EXPECT_EQ(leaf->textures.size(), 3u); // one more with the file's own cut-off
  EXPECT_THAT(kept.read(kept.path("a.obj"))->warnings, testing::SizeIs(4));
  EXPECT_THAT(kept.read(kept.path("a.obj"))->unplaced, testing::Contains(1)); // compared above
}

TEST(ModelCache, IsFoundByContentsAndName)
{
  const Kept kept;
  const std::string other = kept.write("other.obj", largeObj("other"));
  EXPECT_TRUE(kept.isFound(kept.write("a.obj", largeObj("thing")), other));
  // anywhere, under the same name
  kept.read(kept.path("a.obj"));
  const std::size_t count = kept.count();
  EXPECT_EQ(kept.read(kept.write("elsewhere/a.obj", largeObj("thing")))->path, kept.path("elsewhere/a.obj"));
  EXPECT_EQ(kept.count(), count);
  kept.read(kept.write("b.obj", largeObj("thing")));
  EXPECT_EQ(kept.count(), count + 1);
  kept.read(kept.write("a.obj", largeObj("things")));
  EXPECT_EQ(kept.count(), count + 2);
  // small ones of our own readers, and formats whose files cannot be told, are read
  kept.read(kept.write("small.obj", largeObj("thing", "", 10)));
  EXPECT_EQ(kept.count(), count + 2);
}

TEST(ModelCache, AnotherFileThatTheModelNamesMakesAnotherModel)
{
  const Kept kept;
  const std::string path = kept.write("a.obj", largeObj("thing", "mtllib a.mtl\nusemtl m\n"));
  EXPECT_THAT(kept.read(path)->warnings.at(0), HasSubstr("a.mtl"));
  kept.write("a.mtl", "newmtl m\nKd 1 0 0\n"); // was not there
  EXPECT_EQ(kept.read(path)->materials.at(0).diffuse, Eigen::Vector3d(1, 0, 0));
  kept.write("a.mtl", "newmtl m\nKd 0 1 0\n");
  EXPECT_EQ(kept.read(path)->materials.at(0).diffuse, Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(kept.read(path)->companions, std::vector<std::string>{ kept.path("a.mtl") });
  fs::rename(kept.path("a.mtl"), kept.path("A.MTL")); // found in any case
  EXPECT_EQ(kept.read(path)->companions, std::vector<std::string>{ kept.path("A.MTL") });
  fs::remove(kept.path("A.MTL"));
  EXPECT_THAT(kept.read(path)->warnings.at(0), HasSubstr("a.mtl"));
  EXPECT_EQ(kept.count(), 1u);
}

TEST(ModelCache, PicturesAreLookedForAnew)
{
  const Kept kept;
  kept.write("a.mtl", "newmtl m\nmap_Kd p.png\n");
  const std::string path = kept.write("a.obj", largeObj("thing", "mtllib a.mtl\nusemtl m\n"));
  EXPECT_THAT(kept.read(path)->warnings.at(0), HasSubstr("'p.png' not found"));
  fs::copy_file(sourceFile("Data/Textures/stone.png"), kept.path("p.png"));
  EXPECT_FALSE(kept.read(path)->materials[0].cutOut);
  EXPECT_TRUE(kept.read(path)->textures.at(0).image);
  fs::copy_file(sourceFile("Data/Textures/leaves.png"), kept.path("p.png"), fs::copy_options::overwrite_existing);
  EXPECT_TRUE(kept.read(path)->materials[0].cutOut);
  EXPECT_EQ(kept.count(), 1u);
}

TEST(ModelCache, AnotherImporterMakesAnotherModel)
{
  const Kept kept;
  const std::string path = kept.write("d.glb", slidingGlb(""));
  kept.read(path);
  const std::string program = kept.write("importer", "#!/bin/sh\nexit 3\n");
  fs::permissions(program, fs::perms::owner_all);
  ::setenv("DGTK_IMPORT", program.c_str(), 1);
  EXPECT_THROW(kept.read(path), dgtk::InputError);
  ::unsetenv("DGTK_IMPORT");
  kept.read(path);
}

TEST(ModelCache, ADamagedFileIsReadAnew)
{
  const Kept kept;
  const std::string path = kept.write("d.glb", slidingGlb(dgtk::readFile(sourceFile("Data/Textures/leaves.png"))));
  const auto right = kept.read(path);
  const std::string file = kept.files().at(0);
  const std::string bytes = dgtk::readFile(file);
  const auto step = std::max<std::size_t>(bytes.size() / (sweepsAreWhole() ? 25 : 6), 1);
  for (std::size_t at = 0; at < bytes.size(); at += at < 100 ? 9 : step)
  {
    for (const bool cut : { false, true })
    {
      std::string damaged = bytes;
      damaged[at] = static_cast<char>(damaged[at] ^ (1 << (at % 8)));
      dgtk::writeFile(file, cut ? bytes.substr(0, at) : damaged);
      expectEqual(*right, *kept.read(path));
      EXPECT_TRUE(dgtk::readFile(file) == bytes) << at; // written again
    }
  }
  // and whatever else stands in its place
  fs::remove(file);
  fs::create_symlink("/dev/zero", file);
  expectEqual(*right, *kept.read(path));
  EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(file)));
  fs::remove(file);
  fs::create_directory(file);
  expectEqual(*right, *kept.read(path));
}

TEST(ModelCache, TheOnesThatWereNotUsedForLongestGo)
{
  const Kept kept(3000000);
  const auto model = [](int i) { return largeObj("thing", "# " + std::to_string(i) + '\n', 5000); }; // 900 kB kept
  std::vector<std::string> paths;
  for (int i = 0; i < 3; ++i)
  {
    paths.push_back(kept.write(std::to_string(i) + ".obj", model(i)));
    kept.read(paths.back());
  }
  const std::size_t fit = kept.count();
  ASSERT_GE(fit, 2u);
  kept.read(paths[0]);
  for (int i = 3; i < 9; ++i)
  {
    kept.read(kept.write(std::to_string(i) + ".obj", model(i)));
    const std::vector<fs::path> files = kept.files();
    kept.read(paths[0]); // used all the time: there still
    EXPECT_EQ(kept.files(), files) << i;
  }
  EXPECT_LE(kept.count(), fit);
  std::uint64_t sum = 0;
  for (const fs::path& file : kept.files())
  {
    sum += fs::file_size(file);
  }
  EXPECT_LE(sum, 3000000u);
}

TEST(ModelCache, WhatStandsInTheWayIsNoError)
{
  const Kept kept;
  const std::string path = kept.write("a.obj", largeObj("thing"));
  dgtk::writeFile(kept.folder(), "a file");
  EXPECT_EQ(kept.read(path)->parts.size(), 1u);
  fs::remove(kept.folder());
  kept.read(path);
  struct stat status = {};
  ASSERT_EQ(::stat(kept.folder().c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777u, 0700u);
  // what a killed process left behind
  const std::string left = kept.folder() + "/0123.model.partial";
  dgtk::writeFile(left, "half");
  const fs::path file = kept.files().at(0).extension() == ".model" ? kept.files().at(0) : kept.files().at(1);
  dgtk::writeFile(file.string() + ".partial", "half");
  fs::remove(file);
  EXPECT_EQ(kept.read(path)->parts.size(), 1u);
  EXPECT_TRUE(fs::is_regular_file(file));
  fs::last_write_time(left, fs::file_time_type::clock::now() - std::chrono::hours(2));
  dgtk::ReadOptions options;
  options.cache = std::make_shared<dgtk::ModelCache>(kept.folder(), std::uint64_t(1) << 30); // of another process
  const std::string other = kept.write("b.obj", largeObj("more"));
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  dgtk::readModel(other, options);
  EXPECT_FALSE(fs::exists(left));
}

TEST(ModelCache, IsWhereTheEnvironmentSays)
{
  const char* const known = std::getenv("HOME");
  const std::string before = known ? known : "";
  const auto of = [](const char* cache, const char* home, const char* size)
  {
    const auto set = [](const char* name, const char* value)
    { return value ? ::setenv(name, value, 1) : ::unsetenv(name); };
    set("XDG_CACHE_HOME", cache);
    set("HOME", home);
    set("DGTK_CACHE", size);
    const auto made = dgtk::ModelCache::ofUser();
    return made ? made->folder() : std::string();
  };
  EXPECT_EQ(of("/x", "/home/me", nullptr), "/x/dgtk");
  EXPECT_EQ(of("relative", "/home/me", nullptr), "/home/me/.cache/dgtk");
  EXPECT_EQ(of(nullptr, "/home/me", "5"), "/home/me/.cache/dgtk");
  EXPECT_EQ(of(nullptr, nullptr, nullptr), "");
  EXPECT_EQ(of("/x", "/home/me", "0"), "");
  EXPECT_THROW(of("/x", "/home/me", "many"), dgtk::UsageError);
  of(nullptr, before.c_str(), nullptr);
}

TEST(ModelCache, ManyAtOnce)
{
  const Kept kept;
  const std::string path = kept.write("a.obj", largeObj("thing", "", 1500));
  const auto right = kept.read(path, false);
  std::vector<std::thread> threads;
  std::atomic<int> equal{ 0 };
  threads.reserve(8);
  for (int i = 0; i < 8; ++i)
  {
    threads.emplace_back(
      [&]
      {
        for (int k = 0; k < 5; ++k)
        {
          std::error_code busy;
          fs::remove_all(kept.folder(), busy);
          equal += kept.read(path)->triangles == right->triangles ? 1 : 0;
        }
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  EXPECT_EQ(equal, 40);
}
