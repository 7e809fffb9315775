// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSampleVerification.h"

#include "dgtkFolder.h"
#include "dgtkHash.h"
#include "dgtkJsonFile.h"
#include "dgtkMeshOverlap.h"
#include "dgtkMeter.h"
#include "dgtkModel.h"
#include "dgtkSceneDescription.h"
#include "dgtkStage.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>

namespace dgtk
{

namespace
{
using Json = nlohmann::json;

constexpr char recordName[] = "samples.json";

/// Objects that were kept, with their tolerance and whether something must hold them.
struct Claim
{
  std::string object;
  double tolerance = 0;
  bool held = false;
  bool fell = false; ///< in key frames: it lies where it is at the last
};

/// A name of a path, where `/` is `~1` and `~` is `~0`.
std::string nameOf(const std::string& escaped)
{
  std::string name;
  for (std::size_t i = 0; i < escaped.size(); ++i)
  {
    const bool isEscape = escaped[i] == '~' && i + 1 < escaped.size();
    name += !isEscape ? escaped[i] : escaped[++i] == '1' ? '/' : '~';
  }
  return name;
}

std::vector<Claim> claimsOf(const Json& sample)
{
  std::vector<Claim> claims;
  for (const Json& note : sample.value("notes", Json::array()))
  {
    const std::string path = note.at("path");
    const std::string first = "objects/";
    const std::string last = "/place";
    const Json measured = note.value("measured", Json::object());
    if (!note.at("kept") || !measured.contains("tolerance") || path.size() <= first.size() + last.size() ||
        path.rfind(first, 0) != 0)
    {
      continue;
    }
    claims.push_back({ nameOf(path.substr(first.size(), path.size() - first.size() - last.size())),
      measured.at("tolerance"), measured.contains("gap"), measured.contains("frames") });
  }
  return claims;
}

/// The bodies of a scene at its first frame, those that fell in key frames where they lie at the last, by the names of
/// the objects that carry the others. Models have their first shape.
std::map<std::string, WorldMesh> bodiesOf(const SceneDescription& scene, const std::vector<Claim>& claims)
{
  std::map<std::string, std::string> parents;
  std::map<std::string, Rigid3> moves; // of what has fallen, from the first key frame to the last
  const int first = scene.firstFrame();
  for (const ObjectDescription& object : scene.objects)
  {
    parents[object.name] = object.parent;
    const auto at = [&object](int frame) {
      return Rigid3{ object.orientation.at(frame).matrix(), object.position.at(frame) };
    };
    const bool fell = std::any_of(
      claims.begin(), claims.end(), [&](const Claim& claim) { return claim.fell && claim.object == object.name; });
    moves[object.name] = fell ? at(scene.lastFrame()) * at(first).inverse() : Rigid3();
  }
  std::map<std::string, WorldMesh> bodies;
  const std::shared_ptr<const Stage> stage = Stage::load(scene);
  for (const Instance& instance : stage->at(first)->instances)
  {
    std::string root = instance.name;
    while (!parents[root].empty())
    {
      root = parents[root];
    }
    for (const auto& t : instance.model->triangles)
    {
      WorldTriangle corners;
      for (std::size_t i = 0; i < 3; ++i)
      {
        corners[i] = moves[root] * (instance.world_from_object * instance.model->rest->positions[t[i]]);
      }
      bodies[root].add(corners);
    }
  }
  return bodies;
}

class SampleCheck
{
public:
  explicit SampleCheck(std::string folder)
    : Folder(std::move(folder))
  {
  }

  VerificationReport run()
  {
    const std::string path = dgtk::Folder(this->Folder).fileAt(recordName);
    const Json record = readJsonFile(path);
    useJson(path,
      [&]
      {
        if (!record.at("complete").get<bool>())
        {
          throw InputError(this->Folder, "holds an unfinished run: the same dgtk sample command begins it anew");
        }
        std::int64_t number = record.at("first");
        for (const Json& sample : record.at("samples"))
        {
          this->number(sample, number++);
          if (sample.contains("file"))
          {
            this->check(sample);
          }
        }
        const std::int64_t end = record.at("last").get<std::int64_t>() + 1;
        this->record(number == end, "samples to " + std::to_string(number - 1), "to " + std::to_string(end - 1));
        return 0;
      });
    Results results;
    results.startCheck(0, "hashes");
    results.add({ "", "", {} }, this->Hashes);
    results.startCheck(1, "penetration");
    results.add({ "", "tolerances", {} }, this->Depths);
    results.startCheck(2, "gap");
    results.add({ "", "tolerances", {} }, this->Gaps);
    results.startCheck(3, "record");
    results.add({ "", "", {} }, this->Record);
    return results.report();
  }

private:
  void record(bool right, const std::string& found, const std::string& expected)
  {
    this->Record.equal(right, [&] { return Offender{ recordName, -1, -1, found, expected }; });
  }

  /// Samples follow one another; each has the file of its number, or says why it has none.
  void number(const Json& sample, std::int64_t expected)
  {
    const std::string what = "sample " + sample.at("sample").dump();
    this->record(sample.at("sample") == expected, what, std::to_string(expected));
    const bool refused = sample.contains("refused");
    this->record(refused != sample.contains("file"), what, "either a file or why it was refused");
    if (refused)
    {
      this->record(!sample.at("refused").at("why").get<std::string>().empty(), what, "why it was refused");
      return;
    }
    char name[32];
    std::snprintf(name, sizeof name, "%06lld.json", static_cast<long long>(expected));
    this->record(sample.at("file") == name, what + " in " + sample.at("file").dump(), name);
  }

  /// What was measured where an object was placed is within its tolerance.
  void claimed(const Json& sample)
  {
    for (const Json& note : sample.value("notes", Json::array()))
    {
      const Json measured = note.value("measured", Json::object());
      const double tolerance = measured.value("tolerance", infinite);
      for (const char* key : { "penetration", "gap" })
      {
        const double value = measured.value(key, 0.0);
        this->record(!note.at("kept") || (value >= 0 && value <= tolerance),
          note.at("path").get<std::string>() + ' ' + key + ' ' + numberText(value), "within " + numberText(tolerance));
      }
    }
  }

  void check(const Json& sample)
  {
    const std::string file = sample.at("file");
    const std::string path = dgtk::Folder(this->Folder).fileAt(file);
    const std::string hash = hashOfFile(path);
    this->Hashes.equal(hash == sample.at("sha256"),
      [&] {
        return Offender{ file, -1, -1, hash, sample.at("sha256") };
      });
    const Json seed = readJsonFile(path).value("seed", Json());
    this->record(seed == sample.at("seed"), file + " of seed " + seed.dump(), sample.at("seed").dump());
    this->claimed(sample);
    const std::vector<Claim> claims = claimsOf(sample);
    if (claims.empty())
    {
      return;
    }
    const SceneDescription scene = readScene(path);
    const std::map<std::string, WorldMesh> bodies = bodiesOf(scene, claims);
    const Eigen::Vector3d down = -(scene.upAxis == UpAxis::Y ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ());
    for (const Claim& claim : claims)
    {
      const auto body = bodies.find(claim.object);
      if (body == bodies.end())
      {
        this->Depths.equal(false,
          [&] {
            return Offender{ file, -1, -1, "no object " + claim.object, "one that was placed" };
          });
        continue;
      }
      this->measure(file, claim, body->second, bodies, down);
    }
  }

  void measure(const std::string& file, const Claim& claim, const WorldMesh& body,
    const std::map<std::string, WorldMesh>& bodies, const Eigen::Vector3d& down)
  {
    const Eigen::Vector3d way = 2 * claim.tolerance * down; // farther is as wrong
    double depth = 0;
    double free = 1;
    for (const auto& [name, other] : bodies)
    {
      Eigen::AlignedBox3d reach = body.box;
      reach.extend(Eigen::Vector3d(body.box.min() + way));
      reach.extend(Eigen::Vector3d(body.box.max() + way));
      if (name == claim.object || !reach.intersects(other.box))
      {
        continue;
      }
      depth = std::max(depth, overlapDepth(body, other));
      free = claim.held ? std::min(free, freeWay(body, other, way)) : free;
    }
    const double gap = depth > 0 ? 0 : free * way.norm(); // what is in another object rests on it
    const auto where = [&](double found)
    {
      return [&file, &claim, found] {
        return Offender{ file, -1, -1, claim.object + ": " + numberText(found),
          "at most " + numberText(claim.tolerance) };
      };
    };
    this->Depths.add(depth / claim.tolerance, where(depth));
    if (claim.held)
    {
      this->Gaps.add(gap / claim.tolerance, where(gap));
    }
  }

  std::string Folder;
  Meter Hashes{ 0 };
  Meter Depths{ 1 };
  Meter Gaps{ 1 };
  Meter Record{ 0 };
};
} // namespace

bool isSampleFolder(const std::string& folder)
{
  std::error_code code;
  return std::filesystem::is_regular_file(folder + '/' + recordName, code);
}

VerificationReport verifySamples(const std::string& folder) { return SampleCheck(folder).run(); }

} // namespace dgtk
