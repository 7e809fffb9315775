// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCheck.h"

#include "dgtkError.h"
#include "dgtkFile.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace dgtk
{

namespace
{
constexpr std::size_t recordBytes = 16;

/// A .ldi file, taken apart here from the description of its bytes.
class LdiFile
{
public:
  LdiFile(const std::string& path, int width, int height)
    : Width(width)
    , Bytes(readFile(path))
  {
    if (this->Bytes.size() < 8 || this->number<std::int32_t>(0) != width || this->number<std::int32_t>(4) != height)
    {
      throw InputError(path, "size differs from the camera's, or is missing");
    }
    std::size_t at = 8;
    for (std::size_t i = 0; i < std::size_t(width) * height; ++i)
    {
      this->Starts.push_back(at);
      const std::size_t left = at + 4 <= this->Bytes.size() ? (this->Bytes.size() - at - 4) / recordBytes : 0;
      if (at + 4 > this->Bytes.size() || this->number<std::uint32_t>(at) > left)
      {
        throw InputError(path, "ends at byte " + std::to_string(this->Bytes.size()) + " within a pixel");
      }
      at += 4 + recordBytes * this->number<std::uint32_t>(at);
    }
    if (at != this->Bytes.size())
    {
      throw InputError(path, "has bytes behind its last pixel");
    }
  }
  std::size_t count(int x, int y) const { return this->number<std::uint32_t>(this->start(x, y)); }
  double depth(int x, int y, std::size_t i) const
  {
    return this->number<double>(this->start(x, y) + 4 + recordBytes * i + 4);
  }
  int color(int x, int y, std::size_t i, int channel) const
  {
    return static_cast<unsigned char>(this->Bytes[this->start(x, y) + 4 + recordBytes * i + channel]);
  }

private:
  std::size_t start(int x, int y) const { return this->Starts[std::size_t(y) * this->Width + x]; }
  template <typename T>
  T number(std::size_t at) const
  {
    T value;
    std::memcpy(&value, this->Bytes.data() + at, sizeof value);
    return value;
  }
  int Width;
  std::string Bytes;
  std::vector<std::size_t> Starts;
};

class LdiCheck
{
public:
  LdiCheck(Picture& picture, const std::string& file)
    : Owner(picture)
    , File(file)
    , Ldi(picture.dataset().absolute(file), picture.width(), picture.height())
  {
  }

  /// The records against all surfaces along the ray.
  void surfaces(int x, int y, Meter& meter) const
  {
    std::vector<Hit> hits;
    std::vector<double> depths;
    this->Owner.sight(x, y).surfaces(centreOf(x, y), hits, depths);
    const std::string problem = this->problem(x, y, depths);
    if (!problem.empty() && meter.Bad < usualPatience && this->isOpen(x, y))
    {
      meter.skip();
      return;
    }
    meter.equal(problem.empty(),
      [&]
      {
        return Offender{ this->File, x, y, problem,
          std::to_string(depths.size()) + " surfaces from depth " +
            numbersText(depths.data(), static_cast<int>(std::min<std::size_t>(4, depths.size()))) };
      });
  }

  void order(int x, int y, Meter& meter) const
  {
    bool sorted = true;
    for (std::size_t i = 1; i < this->Ldi.count(x, y); ++i)
    {
      sorted = sorted && this->Ldi.depth(x, y, i - 1) <= this->Ldi.depth(x, y, i);
    }
    meter.equal(sorted, [&] { return Offender{ this->File, x, y, "records that go back in depth", "near to far" }; });
  }

  void firstDepth(const PictureFile& depth, int x, int y, Meter& meter) const
  {
    const double found = this->Ldi.count(x, y) > 0 ? this->depthAt(x, y, this->Ldi.depth(x, y, 0)) : infinite;
    const double expected = depth.at(x, y);
    meter.add(found == expected ? 0 : found - expected,
      [&] {
        return Offender{ this->File, x, y, "first record " + numberText(found), numberText(expected) };
      });
  }

  /// Only where the first surface is opaque.
  void firstColor(const PictureFile& color, int x, int y, Meter& meter) const
  {
    if (this->Ldi.count(x, y) == 0 || this->Ldi.color(x, y, 0, 3) != 255)
    {
      return;
    }
    double found[3];
    double expected[3];
    double error = 0;
    for (int c = 0; c < 3; ++c)
    {
      found[c] = this->Ldi.color(x, y, 0, c);
      expected[c] = color.at(x, y, c);
      error = std::max(error, std::abs(found[c] - expected[c]));
    }
    meter.add(error,
      [&] {
        return Offender{ this->File, x, y, "first record " + numbersText(found, 3), numbersText(expected, 3) };
      });
  }

private:
  /// Of a lens records have the parameter of the ray.
  double depthAt(int x, int y, double range) const
  {
    const Eye& eye = this->Owner.eye();
    const CameraRay ray = eye.linear() ? CameraRay{} : eye.ray(centreOf(x, y));
    return eye.linear() ? range : (ray.origin + range * ray.direction).z();
  }

  std::string problem(int x, int y, const std::vector<double>& depths) const
  {
    const std::size_t count = this->Ldi.count(x, y);
    if (count != depths.size())
    {
      return std::to_string(count) + " records";
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      const double found = this->Ldi.depth(x, y, i);
      if (!this->isClose(found, depths[i]))
      {
        return "record " + std::to_string(i) + " at " + numberText(found);
      }
    }
    return {};
  }

  /// Whether the records differ from the surfaces only by some with an edge within EdgeReach, or coincident ones: each
  /// record is a surface of some ray around, each surface of all these rays has a record.
  bool isOpen(int x, int y) const
  {
    struct Nearby
    {
      Hit hit;
      int rays = 0;
    };
    constexpr int raysAround = 81; // the centre's and five rings of 16: slivers are thinner than the reach
    constexpr double sixteenth = 0.39269908169872414;
    std::vector<Nearby> all;
    std::vector<Hit> hits;
    std::vector<double> depths;
    for (int i = 0; i < raysAround; ++i)
    {
      const Eigen::Vector2d offset(std::cos(i * sixteenth), std::sin(i * sixteenth));
      this->Owner.sight(x, y).surfaces(centreOf(x, y) + edgeReach * ((i + 15) / 16) / 5 * offset, hits, depths);
      for (const Hit& hit : hits)
      {
        auto known = std::find_if(all.begin(), all.end(), [&](const Nearby& n) { return n.hit == hit; });
        known = known == all.end() ? all.insert(all.end(), { hit, 0 }) : known;
        ++known->rays;
      }
    }
    // What the other layers show, which may be the edge of a cut-out texture that rays pass on either side.
    const Surfaces& seen = this->Owner.surfaces();
    std::vector<double> possible{ this->Owner.sight(x, y).rangeOf(seen.hits[seen.index(x, y)], centreOf(x, y)) };
    bool complete = true;
    for (const Nearby& nearby : all)
    {
      possible.push_back(this->Owner.sight(x, y).rangeOf(nearby.hit, centreOf(x, y)));
      complete = complete && (nearby.rays < raysAround || this->hasRecord(x, y, possible.back()));
    }
    for (std::size_t i = 0; i < this->Ldi.count(x, y); ++i)
    {
      const double found = this->Ldi.depth(x, y, i);
      complete = complete && (std::any_of(possible.begin(), possible.end(),
                                [&](double depth) { return this->isClose(found, depth); }) ||
                               this->Owner.isEdgeAt(x, y, found));
    }
    return complete;
  }

  bool hasRecord(int x, int y, double depth) const
  {
    bool found = false;
    for (std::size_t i = 0; i < this->Ldi.count(x, y); ++i)
    {
      found = found || this->isClose(this->Ldi.depth(x, y, i), depth);
    }
    return found;
  }

  bool isClose(double a, double b) const
  {
    return std::abs(a - b) <= wideDepthTolerance * this->Owner.eye().farness(b) * b;
  }

  Picture& Owner;
  std::string File;
  LdiFile Ldi;
};

/// Whether colour is that of the first surface at the pixel's centre, by the renderer that draws all surfaces.
bool showsFirstSurface(const Picture& picture)
{
  const Manifest& manifest = picture.dataset().manifest();
  const bool asked = std::none_of(manifest.request.begin(), manifest.request.end(),
    [](const auto& option)
    {
      return (option.first == "samples" && option.second != "1") ||
             (option.first == "renderer" && option.second == "povray") || option.first == "exposure" ||
             option.first == "tone";
    });
  const std::vector<CameraDescription>& cameras = picture.dataset().stage().description().cameras;
  return asked && std::none_of(cameras.begin(), cameras.end(),
                    [&](const CameraDescription& camera) { return camera.name == picture.camera() && camera.blurs(); });
}
} // namespace

void checkLdi(Picture& picture, Results& results)
{
  const Dataset& dataset = picture.dataset();
  const std::string file = dataset.find(picture.camera(), "ldi", picture.frame(), { ".ldi" });
  if (file.empty())
  {
    return;
  }
  picture.surfaces();
  const LdiCheck check(picture, file);
  const auto measure = [&](const auto& pixel)
  {
    return meterRows(picture.pool(), picture.height(), 0,
      [&](int y, Meter& row)
      {
        for (int x = 0; x < picture.width(); ++x)
        {
          pixel(x, y, row);
        }
      });
  };
  results.add({ "surfaces", "", { file } }, measure([&](int x, int y, Meter& row) { check.surfaces(x, y, row); }));
  results.add({ "order", "", { file } }, measure([&](int x, int y, Meter& row) { check.order(x, y, row); }));
  const PicturePointer depth = picture.quietly([&] { return picture.image("depth", { ".npy", ".dgd" }); });
  if (depth)
  {
    results.add({ "first = depth", "scene units", { file } },
      measure([&](int x, int y, Meter& row) { check.firstDepth(*depth, x, y, row); }));
  }
  const PicturePointer color = picture.quietly([&] { return picture.image("color", { ".png" }); });
  if (color && color->type() == PixelType::UInt8 && showsFirstSurface(picture))
  {
    results.add({ "first = color", "1/255", { file } },
      measure([&](int x, int y, Meter& row) { check.firstColor(*color, x, y, row); }));
  }
}

} // namespace dgtk
