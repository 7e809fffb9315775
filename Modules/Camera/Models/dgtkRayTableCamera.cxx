// SPDX-License-Identifier: BSD-3-Clause
// Any lens: a table of the rays of an image, which images of other sizes are finer or coarser pictures of.
#include "dgtkCameraEntry.h"
#include "dgtkRayTable.h"

namespace dgtk
{

namespace
{
class RayTableCamera final : public RowsOf<RayTableCamera>
{
public:
  explicit RayTableCamera(const CameraParameters& of)
    : RowsOf(of)
    , Table(RayTable::read(of.files.at("rays")))
    , Scale(double(Table->columns()) / of.width, double(Table->rows()) / of.height)
  {
  }
  std::string name() const override { return "raytable"; }
  CameraRay rayThrough(const Eigen::Vector2d& pixel) const override
  {
    return this->Table->ray(pixel.cwiseProduct(this->Scale));
  }
  bool project(const Eigen::Vector3d& x, Eigen::Vector2d& pixel) const override
  {
    Eigen::Vector2d point;
    if (!this->Table->find(x, point))
    {
      return false;
    }
    pixel = point.cwiseQuotient(this->Scale);
    return true;
  }

  double timeAt(const Eigen::Vector2d& pixel) const override
  {
    return this->Table->time(pixel.cwiseProduct(this->Scale));
  }
  TimeSpan times() const override { return this->Table->times(); }

private:
  std::shared_ptr<const RayTable> Table;
  Eigen::Vector2d Scale; ///< pixels of the table a pixel
};

std::shared_ptr<const CameraModel> makeRayTable(const CameraParameters& of)
{
  return std::make_shared<RayTableCamera>(of);
}

CameraParameter raysParameter()
{
  CameraParameter parameter{ "rays", "",
    "rays of the pixels, camera frame: .npy, height x width x 3 or x 6 (origins first), or one more with times in "
    "frames" };
  parameter.kind = CameraParameter::Kind::File;
  return parameter;
}
} // namespace

extern const CameraEntry cameraRayTable;
const CameraEntry cameraRayTable = { { raysParameter() }, &makeRayTable };

} // namespace dgtk
