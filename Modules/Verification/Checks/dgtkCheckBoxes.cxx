// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCheck.h"
#include "dgtkJsonFile.h"
#include "dgtkMasks.h"
#include "dgtkUpright.h"
#include "dgtkUtf8.h"
#include "dgtkWideCanvas.h"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>

namespace dgtk
{

namespace
{
using Json = nlohmann::json;
/// Part of the largest number of a matrix or corner: products of two placements.
constexpr double poseTolerance = 1e-12;
/// Pixels, or that part of a place far outside.
constexpr double projectedTolerance = 1e-9;

using Extents = std::map<std::uint32_t, Extent>; ///< by the object's id

Eigen::MatrixXd jsonMatrix(const Json& json, std::size_t rows, std::size_t columns)
{
  requireSize(json, rows);
  std::for_each(json.begin(), json.end(), [&](const Json& row) { requireSize(row, columns); });
  Eigen::MatrixXd matrix(rows, columns);
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
  {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
    {
      matrix(i, j) = json.at(std::size_t(i)).at(std::size_t(j)).get<double>();
    }
  }
  return matrix;
}

Eigen::Vector3d jsonVector(const Json& json) { return Eigen::Vector3d(numberList(json, 3).data()); }

class BoxCheck
{
public:
  BoxCheck(Picture& picture, const std::string& file)
    : Owner(picture)
    , File(file)
  {
    if (const PicturePointer ids = picture.quietly([&] { return picture.ids("objects"); }))
    {
      this->Visible.emplace();
      this->forPixels([&](int x, int y) { (*this->Visible)[ids->id(x, y)].addPixel(x, y); });
    }
    const std::string amodal = picture.dataset().find(picture.camera(), "amodal", picture.frame(), { ".json" });
    if (!amodal.empty())
    {
      const dgtk::Masks masks = readMasks(picture.dataset().absolute(amodal), picture.width(), picture.height());
      this->Amodal.emplace();
      for (const auto& [id, mask] : masks.byId)
      {
        this->forPixels(
          [&, own = id](int x, int y)
          {
            if (masks.inside(own, x, y))
            {
              (*this->Amodal)[own].addPixel(x, y);
            }
          });
      }
    }
  }

  /// Whose picture it is of.
  void place(const Json& camera, const Json& frame)
  {
    this->Names.equal(camera == utf8FromBytes(this->Owner.camera()) && frame == this->Owner.frame(),
      [&]
      {
        return Offender{ this->File, -1, -1, "camera " + camera.dump() + " frame " + frame.dump(),
          "camera " + quoted(this->Owner.camera()) + " frame " + std::to_string(this->Owner.frame()) };
      });
  }

  void object(const Json& object)
  {
    this->Id = object.at("id").get<std::uint32_t>();
    if (this->Id == 0 || this->Id > this->Owner.sight().state().instances.size())
    {
      this->Masks.equal(false,
        [&] {
          return Offender{ this->File, -1, -1, "object " + std::to_string(this->Id), "a known one" };
        });
      return;
    }
    this->names(object);
    const std::uint64_t visible = object.at("pixels_visible").get<std::uint64_t>();
    const std::uint64_t amodal = object.at("pixels_amodal").get<std::uint64_t>();
    if (this->Visible)
    {
      this->mask("visible", visible, object.at("box_visible"), (*this->Visible)[this->Id]);
    }
    if (this->Amodal)
    {
      this->mask("amodal", amodal, object.at("box_amodal"), (*this->Amodal)[this->Id]);
    }
    this->number(this->Masks, "visible_fraction", object.at("visible_fraction").get<double>(),
      amodal > 0 ? double(visible) / double(amodal) : 0);
    if (object.contains("pixels_whole")) // of newer versions
    {
      this->whole(object);
    }
    this->projected(object.at("box_projected"));
    this->pose(object);
  }

  void finish(Results& results)
  {
    const std::size_t objects = this->Owner.sight().state().instances.size();
    this->Names.equal(this->Number == objects,
      [&] {
        return Offender{ this->File, -1, -1, std::to_string(this->Number) + " objects", std::to_string(objects) };
      });
    results.add({ "names", "", { this->File } }, this->Names);
    results.add({ "masks", "", { this->File } }, this->Masks);
    if (this->Whole.Count > 0)
    {
      results.add({ "whole", "", { this->File } }, this->Whole);
    }
    results.add({ "projected", "pixel", { this->File } }, this->Projected);
    results.add({ "pose", "relative", { this->File } }, this->Pose);
  }

private:
  template <typename Body>
  void forPixels(const Body& body) const
  {
    for (int y = 0; y < this->Owner.height(); ++y)
    {
      for (int x = 0; x < this->Owner.width(); ++x)
      {
        body(x, y);
      }
    }
  }

  /// Every object of the scene, in its order.
  void names(const Json& object)
  {
    const Instance& instance = this->Owner.sight().instance(this->Id);
    const auto text = [](std::uint64_t id, const std::string& name, const std::string& kind)
    { return "object " + std::to_string(id) + " '" + name + "' '" + kind + '\''; };
    const std::string found =
      text(this->Id, object.at("name").get<std::string>(), object.at("class").get<std::string>());
    const std::string expected = text(++this->Number, utf8FromBytes(instance.name), utf8FromBytes(instance.className));
    this->Names.equal(found == expected, [&] { return Offender{ this->File, -1, -1, found, expected }; });
  }

  void number(Meter& meter, const std::string& key, double found, double expected, double scale = 1) const
  {
    meter.add(found == expected ? 0 : (found - expected) / scale,
      [&] { return this->offender(key, numberText(found), numberText(expected)); });
  }

  Offender offender(const std::string& key, const std::string& found, const std::string& expected) const
  {
    return { this->File, -1, -1, "object " + std::to_string(this->Id) + ' ' + key + ' ' + found, expected };
  }

  void box(Meter& meter, const std::string& key, const Json& found, const Extent& expected) const
  {
    if (found.is_null() || expected.empty())
    {
      meter.equal(found.is_null() && expected.empty(),
        [&]
        {
          return Offender{ this->File, -1, -1, "object " + std::to_string(this->Id) + ' ' + key + ' ' + found.dump(),
            expected.empty() ? "null" : numbersText(expected.box.data(), 4) };
        });
      return;
    }
    const std::vector<double> numbers = numberList(found, 4);
    const double size = std::max(this->Owner.width(), this->Owner.height());
    for (std::size_t i = 0; i < 4; ++i)
    {
      const double far = std::abs(expected.box[i]) / size;
      this->number(meter, key, numbers[i], expected.box[i], std::max(1.0, far * far));
    }
  }

  void mask(const std::string& name, std::uint64_t pixels, const Json& found, const Extent& expected)
  {
    this->number(this->Masks, "pixels_" + name, double(pixels), double(expected.pixels));
    this->box(this->Masks, "box_" + name, found, expected);
  }

  /// As the document has it.
  static Extent amodal(const Json& object)
  {
    Extent claimed;
    claimed.pixels = object.at("pixels_amodal").get<std::uint64_t>();
    const Json& box = object.at("box_amodal");
    if (!box.is_null())
    {
      claimed.add(box.at(0), box.at(1), box.at(2), box.at(3));
    }
    return claimed;
  }

  /// The amodal pixels and those around the picture.
  void whole(const Json& object)
  {
    const std::uint64_t pixels = object.at("pixels_whole").get<std::uint64_t>();
    const Extent inside = amodal(object);
    const auto with = [&](const Extent& around)
    {
      Extent whole = inside;
      whole.add(around);
      return whole;
    };
    this->Around = this->Around ? std::move(this->Around) : std::make_unique<WideCanvas>(this->Owner);
    Extent expected = with(this->Around->around(this->Id));
    const Json& box = object.at("box_whole");
    if (pixels != expected.pixels || !isBox(box, expected))
    {
      const WideCanvas::Bounds bounds = this->Around->boundsAround(this->Id);
      expected = nearest(pixels, box, with(bounds.least), with(bounds.most));
    }
    this->number(this->Whole, "pixels_whole", double(pixels), double(expected.pixels));
    this->box(this->Whole, "box_whole", box, expected);
  }

  static bool isBox(const Json& box, const Extent& expected)
  {
    return box.is_null() ? expected.empty() : !expected.empty() && box == Json(expected.box);
  }

  /// What is closest to the claims of all that may be right.
  static Extent nearest(std::uint64_t pixels, const Json& box, const Extent& least, const Extent& most)
  {
    Extent found = most;
    found.pixels = std::clamp(pixels, least.pixels, most.pixels);
    for (std::size_t i = 0; i < 4 && box.is_array() && !most.empty(); ++i)
    {
      const double inner = least.empty() ? most.box[(i + 2) % 4] : least.box[i];
      found.box[i] = std::clamp(box.at(i).get<double>(), std::min(inner, most.box[i]), std::max(inner, most.box[i]));
    }
    return found.pixels == 0 ? Extent() : found;
  }

  /// Vertices that the object's triangles use.
  template <typename Body>
  void forVertices(const Body& body) const
  {
    const Instance& instance = this->Owner.sight().instance(this->Id);
    const auto& triangles = instance.model->triangles;
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
    {
      for (int k = 0; k < 3; ++k)
      {
        body(instance.geometry->positions[triangles[i][std::size_t(k)]], i, k);
      }
    }
  }

  /// Where a corner is seen at its own time; `open` where that does not settle.
  bool sees(const Hit& hit, const Eigen::Vector3d& weights, Eigen::Vector2d& pixel, bool& open) const
  {
    const TimedSight& sight = this->Owner.time();
    double time = 0;
    const bool settled = sight.findTime(hit, weights, time);
    open = open || !settled;
    const Eye eye = sight.eyeAt(time);
    return settled && eye.project(eye.toCamera(sight.pointAt(time, hit, weights)), pixel);
  }

  void projected(const Json& found)
  {
    Extent extent;
    bool open = false;
    this->forVertices(
      [&](const Eigen::Vector3d& vertex, std::uint32_t triangle, int corner)
      {
        Eigen::Vector2d p;
        if (this->Owner.time().rolls()
              ? this->sees({ this->Id, triangle }, Eigen::Vector3d::Unit(corner), p, open)
              : this->Owner.eye().project(this->Owner.sight().cameraFromObject(this->Id) * vertex, p))
        {
          extent.add(p.x(), p.y(), p.x(), p.y());
        }
      });
    if (open) // of vertices beside the camera, which a moving camera sees several times or for a part of the time
    {
      this->Projected.skip();
      return;
    }
    this->box(this->Projected, "box_projected", found, extent);
  }

  void matrix(const char* key, const Eigen::MatrixXd& found, const Eigen::MatrixXd& expected)
  {
    const double scale = expected.cwiseAbs().maxCoeff();
    for (Eigen::Index i = 0; i < found.size(); ++i)
    {
      this->number(this->Pose, key, found.data()[i], expected.data()[i], scale);
    }
  }

  void pose(const Json& object)
  {
    const Affine3& camera_from_object = this->Owner.sight().cameraFromObject(this->Id);
    Eigen::MatrixXd expected(3, 4);
    expected << camera_from_object.linear, camera_from_object.translation;
    this->matrix("matrix", jsonMatrix(object.at("matrix"), 3, 4), expected);
    const bool rotation = !object.at("R").is_null();
    this->Pose.equal(maySay(rotation, largestCosine(camera_from_object.linear)),
      [&] { return this->offender("R", rotation ? "a rotation" : "null", "the other"); });
    if (rotation)
    {
      const Eigen::Matrix3d R = jsonMatrix(object.at("R"), 3, 3);
      this->Pose.equal(R.determinant() > 0, [&] { return this->offender("R", "a mirroring", "a rotation"); });
      const Eigen::Vector3d scale = jsonVector(object.at("scale"));
      this->matrix("R", R * R.transpose(), Eigen::Matrix3d::Identity());
      this->matrix("R diag(scale)", R * scale.asDiagonal(), camera_from_object.linear);
      this->matrix("t", jsonVector(object.at("t")), camera_from_object.translation);
    }
    Eigen::Vector3d least(infinite, infinite, infinite);
    Eigen::Vector3d most = -least;
    this->forVertices(
      [&](const Eigen::Vector3d& vertex, std::uint32_t, int)
      {
        least = least.cwiseMin(vertex);
        most = most.cwiseMax(vertex);
      });
    Eigen::MatrixXd corners(8, 3);
    for (int i = 0; i < 8; ++i)
    {
      const Eigen::Vector3d corner(
        (i & 1) != 0 ? most.x() : least.x(), (i & 2) != 0 ? most.y() : least.y(), (i & 4) != 0 ? most.z() : least.z());
      corners.row(i) = camera_from_object * corner;
    }
    this->matrix("box3d", jsonMatrix(object.at("box3d"), 8, 3), corners);
  }

  Picture& Owner;
  std::string File;
  std::optional<Extents> Visible; ///< by the layer objects
  std::optional<Extents> Amodal;  ///< by the layer amodal
  std::unique_ptr<WideCanvas> Around;
  std::uint32_t Id = 0;
  std::size_t Number = 0; ///< of objects so far
  Meter Names{ 0 };
  Meter Masks{ 0 };
  Meter Whole{ 0 };
  Meter Projected{ projectedTolerance };
  Meter Pose{ poseTolerance };
};
} // namespace

void checkBoxes(Picture& picture, Results& results)
{
  const Dataset& dataset = picture.dataset();
  const std::string file = dataset.find(picture.camera(), "boxes", picture.frame(), { ".json" });
  if (file.empty())
  {
    return;
  }
  const std::string path = dataset.absolute(file);
  const Json document = readJsonFile(path);
  BoxCheck check(picture, file);
  useJson(path,
    [&]
    {
      check.place(document.at("camera"), document.at("frame"));
      for (const Json& object : document.at("objects"))
      {
        check.object(object);
      }
      return 0;
    });
  check.finish(results);
}

} // namespace dgtk
