// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCheck.h"

#include <cmath>

namespace dgtk
{

namespace
{
/// Part of a matrix's largest entry: the file holds the doubles that the projection is computed in.
constexpr double depthMatrixTolerance = 1e-12;

double relativeDepth(double found, double expected)
{
  return found == expected ? 0 : std::abs(found - expected) / std::min(std::abs(expected), std::abs(found));
}

/// Every depth file of the picture, in its own format, against the triangles that Embree meets.
void checkFile(Picture& picture, const std::string& suffix, Results& results)
{
  const PicturePointer depth = picture.image("depth", { suffix });
  const Surfaces& surfaces = picture.surfaces();
  const double tolerance = depthTolerance(*depth);
  const Meter meter = meterRows(picture.pool(), picture.height(), tolerance,
    [&](int y, Meter& row)
    {
      for (int x = 0; x < picture.width(); ++x)
      {
        const std::size_t i = surfaces.index(x, y);
        const double found = depth->at(x, y);
        const double expected = picture.sight(x, y).depthOf(surfaces.hits[i], centreOf(x, y));
        const double error = relativeDepth(found, expected) / (found == expected ? 1 : picture.eye().farness(expected));
        if (surfaces.marks[i] == Mark::Edge && error <= tolerance)
        {
          row.skip();
          continue;
        }
        row.add(error, [&] { return depth->offender(x, y, numberText(found), numberText(expected)); });
      }
    });
  const bool narrow = tolerance != wideDepthTolerance;
  results.add({ narrow ? "depth" + suffix : "depth", "relative", { depth->file() } }, meter);
}

/// The matrices of a .dgd file against cameras.json.
void checkMatrices(Picture& picture, Results& results)
{
  const PicturePointer depth = picture.image("depth", { ".dgd" });
  const OpenGLMatrices expected = openGLMatrices(picture.eye().view());
  Meter meter(depthMatrixTolerance);
  const auto compare = [&](const char* name, const Eigen::Matrix4d& found, const Eigen::Matrix4d& right)
  {
    int i = 0;
    int j = 0;
    const double error = (found - right).cwiseAbs().maxCoeff(&i, &j) / std::max(1.0, right.cwiseAbs().maxCoeff());
    meter.add(error, [&]
      { return depth->offender(-1, -1, std::string(name) + ' ' + numberText(found(i, j)), numberText(right(i, j))); });
  };
  compare("projection", depth->matrices().projection, expected.projection);
  compare("model-view", depth->matrices().modelView, expected.modelView);
  results.add({ "depth.dgd", "relative", { depth->file() } }, meter);
}
} // namespace

void checkDepth(Picture& picture, Results& results)
{
  for (const char* suffix : { ".npy", ".dgd", ".exr", ".pfm" })
  {
    if (!picture.dataset().find(picture.camera(), "depth", picture.frame(), { suffix }).empty())
    {
      checkFile(picture, suffix, results);
    }
  }
  if (!picture.dataset().find(picture.camera(), "depth", picture.frame(), { ".dgd" }).empty())
  {
    checkMatrices(picture, results);
  }
}

} // namespace dgtk
