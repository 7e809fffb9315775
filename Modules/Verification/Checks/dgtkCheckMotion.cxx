// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCheck.h"
#include "dgtkPair.h"

#include <cmath>
#include <limits>

namespace dgtk
{

namespace
{
/// Pixels, beyond the rounding of float32 files: places of some 1000 pixels have 1e-13 in double precision, and lose
/// some digits on the way from one camera and frame to the other.
constexpr double motionTolerance = 1e-9;
/// Part of the depth: nearer to the plane of the other camera, whether a point projects is a matter of rounding.
constexpr double planeSlack = 1e-9;

int channelsOf(PairKind kind)
{
  return kind == PairKind::Motion ? 3 : kind == PairKind::Place || kind == PairKind::Displacement ? 2 : 1;
}

class MotionCheck
{
public:
  MotionCheck(Picture& picture, const Pair& pair, const PictureFile& file)
    : Owner(picture)
    , ThePair(pair)
    , File(file)
    , Targets(picture, pair)
    , Channels(channelsOf(pair.kind))
  {
  }

  void pixel(int x, int y, Meter& meter) const
  {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    double found[3] = { none, none, none };
    double expected[3] = { 0, 0, 0 };
    for (int c = 0; c < this->Channels; ++c)
    {
      found[c] = this->File.at(x, y, c);
    }
    const Hit& own = this->Targets.hit(x, y);
    double error = this->measure(x, y, own, found, expected);
    if (!(error <= meter.Tolerance) && own.object != 0 && meter.Bad < usualPatience)
    {
      // Beside an edge of a deforming model the files may follow the neighbour.
      for (const Hit& neighbour : this->Owner.nearby(x, y))
      {
        const bool follows =
          neighbour.object == own.object && this->measure(x, y, neighbour, found, expected) <= meter.Tolerance;
        error = follows ? -1 : error;
      }
      this->measure(x, y, own, found, expected);
    }
    if (error < 0)
    {
      meter.skip();
      return;
    }
    meter.add(error, [&]
      { return this->File.offender(x, y, numbersText(found, this->Channels), numbersText(expected, this->Channels)); });
  }

private:
  /// The residual in pixels, beyond the rounding of the file's type; negative: open.
  double measure(int x, int y, const Hit& hit, const double* found, double* expected) const
  {
    const Target target = this->Targets.at(x, y, hit);
    const bool still = this->ThePair.kind == PairKind::Motion && !this->ThePair.timed->rolls();
    const bool exists = target.surface && (still || target.projects);
    if (target.surface && !target.ok)
    {
      return -1;
    }
    if (!exists && !target.timed && this->ThePair.kind == PairKind::Motion && !std::isnan(found[0]))
    {
      return -1; // seen at a time that cannot be found from the picture's own
    }
    if (!exists)
    {
      std::fill(expected, expected + 3, std::nan(""));
      const bool near = target.surface && std::abs(target.there.z()) <= planeSlack * target.here.z();
      return near ? -1 : std::all_of(found, found + 3, [](double v) { return std::isnan(v); }) ? 0 : infinite;
    }
    this->derive(x, y, target, expected);
    const EyeLens* const lens = this->ThePair.kind == PairKind::Motion ? nullptr : this->ThePair.other->eye().lens();
    const double seam = lens != nullptr ? lens->seam(target.pixel) : 0;
    double error = 0;
    for (int c = 0; c < this->Channels; ++c)
    {
      double difference = std::abs(found[c] - expected[c]);
      difference = c == 0 ? std::min(difference, std::abs(difference - seam)) : difference;
      error =
        std::isnan(difference) ? infinite : std::max(error, difference - this->File.rounding(found[c]) - target.slack);
    }
    const double unit = this->scale(target) * this->Owner.eye().farness(target.here) *
                        (this->ThePair.kind == PairKind::Motion ? 1 : this->ThePair.other->eye().farness(target.there));
    // What moves fast, or is seen by many pixels, moves in the time that its own time may be off.
    return error > motionTolerance * unit && error < infinite
             ? std::max(0.0, error - this->Targets.moves(x, y, hit, target)) / unit
             : error / unit;
  }

  void derive(int x, int y, const Target& target, double* expected) const
  {
    const Eigen::Vector2d centre = centreOf(x, y);
    const Eye& here = this->Owner.sight(x, y).eye();
    Eigen::Map<Eigen::Vector2d> two(expected);
    switch (this->ThePair.kind)
    {
      case PairKind::Place:
        two = target.pixel;
        break;
      case PairKind::Displacement:
        two = target.pixel - centre;
        break;
      case PairKind::FromLeft:
        *expected = this->own(target, centre).x() - target.pixel.x();
        break;
      case PairKind::FromRight:
        *expected = target.pixel.x() - this->own(target, centre).x();
        break;
      case PairKind::Motion:
        Eigen::Map<Eigen::Vector3d>(expected, 3) = here.record().R * (target.world - here.toWorld(target.here));
        break;
    }
  }

  /// Where the picture's camera sees the point at the time of the disparity.
  Eigen::Vector2d own(const Target& target, const Eigen::Vector2d& centre) const
  {
    Eigen::Vector2d pixel = centre;
    if (this->ThePair.ownThen)
    {
      const Eye& eye = this->ThePair.ownThen->eye();
      eye.project(eye.toCamera(target.world), pixel);
    }
    return pixel;
  }

  /// What a unit of the residual is worth in pixels. Beside the image, where a point nears the camera's plane, its
  /// place grows with the square of 1 / depth, and so does every rounding.
  double scale(const Target& target) const
  {
    if (this->ThePair.kind == PairKind::Motion)
    {
      const Eye& eye = this->Owner.eye();
      const double away = eye.pinhole() ? target.here.z() : eye.linear() ? 1 : target.here.norm();
      return away / eye.record().K.topLeftCorner<2, 2>().diagonal().maxCoeff();
    }
    const double size = std::max(this->ThePair.other->eye().width(), this->ThePair.other->eye().height());
    const double far = target.pixel.cwiseAbs().maxCoeff() / size;
    return std::max(1.0, far * far);
  }

  Picture& Owner;
  const Pair& ThePair;
  const PictureFile& File;
  PairTargets Targets;
  int Channels;
};
} // namespace

void checkMotion(Picture& picture, Results& results)
{
  for (const Pair& pair : pairsOf(picture))
  {
    for (const char* suffix : { ".npy", ".flo", ".pfm", ".exr" })
    {
      const PicturePointer file = picture.image(pair.layer, { suffix });
      if (!file || file->channels() < channelsOf(pair.kind))
      {
        continue;
      }
      const MotionCheck check(picture, pair, *file);
      const Meter meter = meterRows(picture.pool(), picture.height(), motionTolerance,
        [&](int y, Meter& row)
        {
          for (int x = 0; x < picture.width(); ++x)
          {
            check.pixel(x, y, row);
          }
        });
      results.add({ pair.layer, "pixel", { file->file() } }, meter);
    }
  }
}

} // namespace dgtk
