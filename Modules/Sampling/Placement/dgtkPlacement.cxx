// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPlacement.h"

#include "dgtkFallen.h"
#include "dgtkObjectPoses.h"
#include "dgtkPlaceRule.h"
#include "dgtkPlaceWorld.h"
#include "dgtkSolidModel.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace dgtk
{

namespace
{
Eigen::AlignedBox3d boxOf(const SolidMesh& mesh)
{
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : mesh.points)
  {
    box.extend(p);
  }
  return box;
}

/// A proxy has a surface, and a box that is about that of the object's model, whose place it takes.
void checkProxy(const JsonCursor& at, const std::string& proxy, const SceneDescription& scene, std::size_t object,
  SampleModels& models)
{
  constexpr double near = 0.2; // of the size
  Eigen::AlignedBox3d found;
  try
  {
    found = boxOf(*solidOf(models, proxy));
  }
  catch (const InputError& error)
  {
    at.fail(std::string("names a model that cannot be read: ") + error.what());
  }
  if (found.isEmpty())
  {
    at.fail("names a model without a surface");
  }
  const std::string model = scene.objects[object].model;
  const Eigen::AlignedBox3d wanted = model.empty() ? found : boxOf(*solidOf(models, scene.resolve(model)));
  const double off =
    std::max((found.min() - wanted.min()).cwiseAbs().maxCoeff(), (found.max() - wanted.max()).cwiseAbs().maxCoeff());
  if (!(off <= near * wanted.sizes().maxCoeff()))
  {
    at.fail("names a model that is not where the object's is",
      "a box that is that of " + quoted(model) + " to a fifth of its size, in the same axes and units");
  }
}

/// What becomes of a rule, in the order in which the rules come.
class Placing
{
public:
  Placing(SceneDescription& scene, const std::vector<SampleRule>& rules, const SampleDraws& draws, SampleModels& models)
    : Scene(scene)
    , Given(rules)
    , Draws(draws)
    , Rules(read(scene, rules, models))
    , World(scene, this->Rules, models)
  {
    for (const PlaceRule& rule : this->Rules)
    {
      PlaceOutcome placed;
      placed.index = rule.object;
      placed.note.path = rule.path;
      placed.note.kept = false;
      this->Placed.push_back(std::move(placed));
    }
  }

  std::vector<PlaceOutcome> run()
  {
    for (std::size_t i = 0; i < this->Rules.size(); ++i)
    {
      if (!this->Rules[i].drop)
      {
        this->put(i);
        this->judge(i);
      }
    }
    this->drop();
    return std::move(this->Placed);
  }

private:
  static std::vector<PlaceRule> read(
    const SceneDescription& scene, const std::vector<SampleRule>& rules, SampleModels& models)
  {
    std::vector<PlaceRule> result;
    std::vector<int> when(scene.objects.size(), -1); // -1: stands, 0: is put, 1: falls
    for (const SampleRule& rule : rules)
    {
      result.push_back(readPlaceRule(rule, scene));
      when[rule.index] = result.back().drop ? 1 : 0;
      if (!result.back().proxy.empty())
      {
        checkProxy(JsonCursor(rule.rule)["proxy"], result.back().proxy, scene, rule.index, models);
      }
    }
    std::vector<char> done(scene.objects.size(), 0);
    for (std::size_t i = 0; i < rules.size(); ++i)
    {
      const PlaceRule& rule = result[i];
      if (rule.support &&
          (when[*rule.support] == 1 || (when[*rule.support] == 0 && !rule.drop && !done[*rule.support])))
      {
        const JsonCursor at(rules[i].rule);
        at[rule.in ? "in" : "on"].fail(
          "names an object that is placed later", "one that stands, or is placed before without 'drop'");
      }
      done[rule.object] = 1;
    }
    return result;
  }

  bool isIn(std::size_t object) const
  {
    return std::all_of(this->Placed.begin(), this->Placed.end(),
      [object](const PlaceOutcome& placed) { return placed.index != object || placed.note.kept; });
  }

  /// Why there is nothing that it is put on or in; "": there is.
  std::string lacking(const PlaceRule& rule) const
  {
    return rule.support && !this->isIn(*rule.support) ? quoted(this->Scene.objects[*rule.support].name) + " is left out"
                                                      : rule.lacks;
  }
  void put(std::size_t i);
  std::string fault(const PlaceRule& rule, PlaceBody& body);
  void drop();
  /// Refuses the sample where a rule that could not be kept says so.
  void judge(std::size_t i) const
  {
    const SampleNote& note = this->Placed[i].note;
    if (!note.kept && this->Rules[i].refuses)
    {
      throw SampleRefused(note.path, note.why, note.attempts);
    }
  }
  void write(std::size_t i);
  /// Throws InputError for a fall whose key frames are more than there are frames.
  void checkFrames(std::size_t i, const FallingObject& fallen) const;

  SceneDescription& Scene;
  const std::vector<SampleRule>& Given;
  const SampleDraws& Draws;
  std::vector<PlaceRule> Rules;
  PlaceWorld World;
  std::vector<PlaceOutcome> Placed;
};

/// Why an object cannot be where it is; "": it can.
std::string Placing::fault(const PlaceRule& rule, PlaceBody& body)
{
  const Eigen::Vector3d down = -this->World.up();
  if (!rule.in)
  {
    const PlaceBody& support = this->World.body(*rule.support);
    const double most =
      body.box().min()[this->World.upAxis()] - support.box().min()[this->World.upAxis()] + body.size();
    const double way = wayDown(body, support, down, most, 0);
    if (way >= most)
    {
      return "nothing of " + quoted(support.name()) + " is below it";
    }
    body.move(down * (way - 1e-6 * body.size()));
    if (!stands(body, support, down, this->World.tolerance(rule)))
    {
      return "it does not stand on " + quoted(support.name()) + " as it is turned";
    }
  }
  for (const PlaceBody* other : this->World.others({ rule.object }))
  {
    const bool support = !rule.in && other == &this->World.body(*rule.support);
    if (penetration(body, *other).depth > 0 || (!support && (distance(body, *other, rule.clearance) < rule.clearance ||
                                                              coincide(body, *other, down, 0.5e-6 * body.size()))))
    {
      return "it is too near to " + quoted(other->name());
    }
  }
  return {};
}

void Placing::put(std::size_t i)
{
  const PlaceRule& rule = this->Rules[i];
  SampleNote& note = this->Placed[i].note;
  PlaceBody& body = this->World.body(rule.object);
  note.why = this->lacking(rule);
  if (!note.why.empty())
  {
    return;
  }
  for (note.attempts = 1; !note.kept; ++note.attempts)
  {
    note.why = startPlace(this->World, rule, this->Draws, note.attempts - 1);
    note.why = note.why.empty() ? this->fault(rule, body) : note.why;
    note.kept = note.why.empty();
    if (note.kept || note.attempts == rule.attempts)
    {
      break;
    }
  }
  if (note.kept)
  {
    this->World.putIn(rule.object);
    const double most = 2 * body.size();
    const PlaceMeasure measure = measurePlace(body, this->World.others({ rule.object }), -this->World.up(), most);
    note.measured = { { "penetration", measure.penetration } };
    if (!rule.in)
    {
      note.measured.emplace_back("gap", measure.gap);
    }
    note.measured.emplace_back("tolerance", this->World.tolerance(rule));
    this->write(i);
  }
}

void Placing::drop()
{
  std::vector<FallingObject> falling;
  std::vector<std::size_t> which;
  for (std::size_t i = 0; i < this->Rules.size(); ++i)
  {
    const PlaceRule& rule = this->Rules[i];
    if (!rule.drop)
    {
      continue;
    }
    this->Placed[i].note.why = this->lacking(rule);
    if (this->Placed[i].note.why.empty())
    {
      falling.push_back({ &rule, &this->Placed[i].note, {} });
      which.push_back(i);
    }
  }
  dropObjects(this->World, this->Scene, this->Draws, falling);
  for (std::size_t k = 0; k < falling.size(); ++k)
  {
    const std::size_t i = which[k];
    this->judge(i);
    if (this->Placed[i].note.kept)
    {
      this->write(i);
      this->checkFrames(i, falling[k]);
      writeFall(this->Scene.objects[this->Rules[i].object], falling[k]);
    }
  }
  for (std::size_t i = 0; i < this->Rules.size(); ++i)
  {
    this->judge(i);
  }
}

void Placing::checkFrames(std::size_t i, const FallingObject& fallen) const
{
  const DropRule& drop = *this->Rules[i].drop;
  const int most = largestFrame - int(fallen.poses.size()) + 1;
  if (drop.keys && drop.from > most)
  {
    const JsonCursor at = JsonCursor(this->Given[i].rule)["drop"];
    (drop.from > 0 ? at["from"] : at)
      .fail("leaves too few frames for the fall", "at most " + std::to_string(most), std::to_string(drop.from));
  }
}

void Placing::write(std::size_t i)
{
  ObjectDescription& object = this->Scene.objects[this->Rules[i].object];
  const Rigid3& pose = this->World.body(this->Rules[i].object).pose();
  object.position = Track<Eigen::Vector3d>(pose.translation);
  if (this->Rules[i].drop)
  {
    object.orientation = Track<Quaternion>(quaternionOf(pose.rotation));
  }
}
} // namespace

std::vector<PlaceOutcome> placeObjects(
  SceneDescription& scene, const std::vector<SampleRule>& rules, const SampleDraws& draws, SampleModels& models)
{
  return Placing(scene, rules, draws, models).run();
}

} // namespace dgtk

const dgtk::PlacementCalls* dgtkPlacementCalls()
{
  static const dgtk::PlacementCalls calls{ &dgtk::placeObjects };
  return &calls;
}
