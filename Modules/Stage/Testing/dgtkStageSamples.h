// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkStageSamples_h
#define dgtkStageSamples_h

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkStage.h"
#include "dgtkTestSupport.h"

#include <cstdint>
#include <cstring>
#include <string>

namespace dgtk::test
{

/// One textured square in the plane z = 0, as AC3D.
inline const std::string squareAc = R"(AC3Db
MATERIAL "red" rgb 1 0 0 amb 0.2 0.2 0.2 emis 0 0 0 spec 0.5 0.5 0.5 shi 10 trans 0
OBJECT world
kids 1
OBJECT poly
name "square"
texture "red.ppm"
numvert 4
-1 -1 0
1 -1 0
1 1 0
-1 1 0
numsurf 1
SURF 0x00
mat 0
refs 4
0 0 0
1 1 0
2 1 1
3 0 1
kids 0
)";

/// An AC3D file without a surface.
inline const std::string emptyAc = "AC3Db\nMATERIAL \"m\" rgb 1 1 1 amb 0 0 0 emis 0 0 0 spec 0 0 0 shi 0 trans 0\n"
                                   "OBJECT world\nkids 0\n";

/// A picture of one pixel.
inline const std::string redPpm = std::string("P6\n1 1\n255\n\xff\0\0", 14);

/// One triangle as MD2: sequence "go" whose x offset is 0, 1, 2, 3 in its four frames, then "rest" of one frame.
inline std::string triangleMd2()
{
  std::string out;
  const auto i32 = [&out](std::int32_t v) { out.append(reinterpret_cast<const char*>(&v), 4); };
  const auto i16 = [&out](std::int16_t v) { out.append(reinterpret_cast<const char*>(&v), 2); };
  const auto f32 = [&out](float v) { out.append(reinterpret_cast<const char*>(&v), 4); };
  constexpr int frames = 5, vertices = 3, frameSize = 40 + vertices * 4;
  const int skinsAt = 68, stsAt = skinsAt + 2 * 64, trianglesAt = stsAt + 3 * 4, framesAt = trianglesAt + 12;
  const int end = framesAt + frames * frameSize;
  out = "IDP2";
  for (const int v :
    { 8, 4, 4, frameSize, 2, vertices, 3, 1, 0, frames, skinsAt, stsAt, trianglesAt, framesAt, end, end })
  {
    i32(v);
  }
  for (const char* skin : { "one.ppm", "two.ppm" })
  {
    std::string name(skin);
    name.resize(64);
    out += name;
  }
  for (const int v : { 0, 0, 4, 0, 0, 4 })
  {
    i16(static_cast<std::int16_t>(v));
  }
  for (const int v : { 0, 1, 2, 0, 1, 2 })
  {
    i16(static_cast<std::int16_t>(v));
  }
  for (int frame = 0; frame < frames; ++frame)
  {
    for (const float v : { 1.f, 1.f, 1.f, frame < 4 ? float(frame) : 10.f, 0.f, 0.f })
    {
      f32(v);
    }
    std::string name = frame < 4 ? "go0" + std::to_string(frame + 1) : "rest01";
    name.resize(16);
    out += name;
    out += std::string("\0\0\0\0\1\0\0\0\0\1\0\0", 12);
  }
  return out;
}

/// A folder with square.ac, empty.ac, runner.md2 and their pictures.
class ModelFolder : public TemporaryFolder
{
public:
  ModelFolder()
  {
    makeFolders(this->path("models"));
    writeFile(this->path("models/square.ac"), squareAc);
    writeFile(this->path("models/empty.ac"), emptyAc);
    writeFile(this->path("models/runner.md2"), triangleMd2());
    for (const char* picture : { "red", "one", "two", "other" })
    {
      writeFile(this->path(std::string("models/") + picture + ".ppm"), redPpm);
    }
  }
  std::shared_ptr<const Stage> load(const std::string& json, const Stage::WarningSink& warning = {}) const
  {
    writeFile(this->path("scene.json"), json);
    return Stage::load(readScene(this->path("scene.json")), warning);
  }
  /// The message of the InputError that loading raises, without the folder; "" when there is none.
  std::string refusalOf(const std::string& json) const
  {
    std::string message = thrownBy<InputError>([&] { this->load(json)->at(0); });
    for (std::size_t at; (at = message.find(this->path() + '/')) != std::string::npos;)
    {
      message.erase(at, this->path().size() + 1);
    }
    return message;
  }
};

} // namespace dgtk::test

#endif
