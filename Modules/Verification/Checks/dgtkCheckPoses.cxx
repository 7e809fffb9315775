// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCheck.h"
#include "dgtkUpright.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <set>

namespace dgtk
{

namespace
{
/// Part of the largest number of a matrix: products of two placements.
constexpr double posesTolerance = 1e-12;

class PoseCheck
{
public:
  PoseCheck(const PoseRecord& record, const Instance& instance, Meter& meter)
    : Record(record)
    , World(instance.world_from_object)
    , Visible(instance.visible)
    , TheMeter(meter)
  {
  }

  void run()
  {
    Eigen::Matrix<double, 3, 4> expected;
    expected << this->World.linear, this->World.translation;
    this->matrix("matrix", this->Record.matrix, expected);
    this->matrix("t", this->Record.t, this->World.translation);
    this->TheMeter.equal(this->Record.visible == this->Visible, [&]
      { return this->offender("visible", this->Record.visible ? "true" : "false", this->Visible ? "true" : "false"); });
    const double cosine = largestCosine(this->World.linear);
    this->TheMeter.equal(maySay(this->Record.rigid, cosine),
      [&] { return this->offender("R", this->Record.rigid ? "a rotation" : "null", "the other"); });
    if (this->Record.rigid && cosine < leaning)
    {
      Eigen::Matrix3d axes = this->World.linear.colwise().normalized();
      axes.col(0) *= this->World.linear.determinant() < 0 ? -1 : 1;
      const Eigen::Matrix3d square = this->Record.R.transpose() * this->Record.R;
      this->matrix<Eigen::Matrix3d>("R^T R", square, axes.transpose() * axes);
      this->TheMeter.equal(
        this->Record.R.determinant() > 0, [&] { return this->offender("R", "a mirroring", "a rotation"); });
      const Eigen::Matrix3d linear = this->Record.R * this->Record.scale.asDiagonal();
      this->matrix("R diag(scale)", linear, this->World.linear);
    }
  }

private:
  Offender offender(const std::string& key, const std::string& found, const std::string& expected) const
  {
    const std::string who =
      "object " + std::to_string(this->Record.id) + " frame " + std::to_string(this->Record.frame);
    return { "poses.json", -1, -1, who + ' ' + key + ' ' + found, expected };
  }

  template <typename M>
  void matrix(const char* key, const M& found, const M& expected)
  {
    const double scale = expected.cwiseAbs().maxCoeff();
    for (Eigen::Index i = 0; i < found.size(); ++i)
    {
      const double a = found.data()[i];
      const double b = expected.data()[i];
      this->TheMeter.add(
        a == b ? 0 : (a - b) / scale, [&] { return this->offender(key, numberText(a), numberText(b)); });
    }
  }

  const PoseRecord& Record;
  const Affine3& World;
  bool Visible;
  Meter& TheMeter;
};

std::string placeOf(int frame, std::size_t id)
{
  return "frame " + std::to_string(frame) + " object " + std::to_string(id);
}
} // namespace

void checkPoses(Dataset& dataset, Results& results)
{
  const std::vector<DatasetFile>& files = dataset.manifest().files;
  if (std::none_of(files.begin(), files.end(), [](const DatasetFile& file) { return file.path == posesName; }))
  {
    return; // of a first dataset
  }
  const std::vector<PoseRecord> poses = readPoses(dataset.absolute(posesName));
  std::set<int> frames;
  for (const CameraRecord& camera : dataset.cameras())
  {
    frames.insert(camera.frame);
  }
  Meter meter(posesTolerance);
  auto next = poses.begin();
  for (const int frame : frames)
  {
    const std::shared_ptr<const SceneState> state = dataset.stage().at(frame);
    for (std::size_t i = 0; i < state->instances.size(); ++i)
    {
      const bool isThere = next != poses.end() && next->frame == frame && next->id == i + 1;
      meter.equal(isThere,
        [&]
        {
          const std::string found = next == poses.end() ? "nothing" : placeOf(next->frame, next->id);
          return Offender{ posesName, -1, -1, found, placeOf(frame, i + 1) };
        });
      if (isThere)
      {
        PoseCheck(*next++, state->instances[i], meter).run();
      }
    }
  }
  meter.equal(next == poses.end(),
    [&] {
      return Offender{ posesName, -1, -1, placeOf(next->frame, next->id), "nothing" };
    });
  results.add({ "poses", "relative", { posesName } }, meter);
}

} // namespace dgtk
