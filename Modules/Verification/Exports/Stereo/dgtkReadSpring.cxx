// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkExportPixels.h"
#include "dgtkHdf5Contents.h"
#include "dgtkReadTexts.h"
#include "dgtkText.h"

// spring-benchmark.org, and cv-stuttgart/flow_library, flow_IO.py.

namespace dgtk
{

DecodedPixels decodeHdf5(const std::string& path, const PixelEncoding&)
{
  const auto members = readHdf5(path);
  const bool flow = extensionOf(path) == "flo5";
  const auto found = members.find(flow ? "flow" : "disparity");
  const std::size_t rank = flow ? 3 : 2;
  if (members.size() != 1 || found == members.end() || found->second.kind != Hdf5Dataset::Kind::Real ||
      found->second.dimensions.size() != rank || (flow && found->second.dimensions[2] != 2) || found->second.hasTime)
  {
    throw InputError(path, flow ? "expected real numbers `flow` of a shape (H, W, 2) alone"
                                : "expected real numbers `disparity` of a shape (H, W) alone");
  }
  return { static_cast<int>(found->second.dimensions[1]), static_cast<int>(found->second.dimensions[0]), flow ? 2 : 1,
    found->second.values };
}

namespace
{
void judgeSpringSequence(ExportJudge& judge, const std::string& folder)
{
  const ExportedFrom& source = judge.source();
  const std::string intrinsics = folder + "cam_data/intrinsics.txt";
  const std::string extrinsics = folder + "cam_data/extrinsics.txt";
  const auto lines = linesOf(source.path(intrinsics));
  const auto poses = linesOf(source.path(extrinsics));
  std::size_t pictures = 0;
  while (source.named(folder + "frame_left/frame_left_" + digitsOf(pictures + 1, 4) + ".png"))
  {
    ++pictures;
  }
  judge.exact("intrinsics", "lines", intrinsics, "lines", double(lines.size()), double(pictures));
  judge.exact("pose", "lines", extrinsics, "lines", double(poses.size()), double(pictures));
  for (std::size_t i = 0; i < std::min({ lines.size(), poses.size(), pictures }); ++i)
  {
    const ExportedName& left = *source.named(folder + "frame_left/frame_left_" + digitsOf(i + 1, 4) + ".png");
    const ExportedName* right = source.named(folder + "frame_right/frame_right_" + digitsOf(i + 1, 4) + ".png");
    judge.holds(
      "pairs", intrinsics, left.name, right && right->frame == left.frame, "no right picture", "one of the same frame");
    const std::vector<double> k = numbersIn(source.path(intrinsics), i + 1, lines[i], 4);
    Eigen::Matrix3d K;
    K << 2 * k[0], 0, 2 * k[2], 0, 2 * k[1], 2 * k[3], 0, 0, 1;
    judge.intrinsics(intrinsics, left.camera, left.frame, K, 1e-9);
    const std::vector<double> n = numbersIn(source.path(extrinsics), i + 1, poses[i], 16);
    const Eigen::Vector3d t = Eigen::Vector3d(n[3], n[7], n[11]) / metresOf(source);
    judge.pose(extrinsics, left.camera, left.frame, matrixOf(n, 4), t, 1e-9);
    judge.holds("last row", extrinsics, std::to_string(i + 1), n[12] == 0 && n[13] == 0 && n[14] == 0 && n[15] == 1,
      "another", "0 0 0 1");
  }
}
} // namespace

void readSpring(ExportJudge& judge)
{
  for (const ExportedFile* one : filesIn(judge.source(), "train/", "txt"))
  {
    const std::string& file = one->file.path;
    if (stemOf(file) == "intrinsics")
    {
      judgeSpringSequence(judge, file.substr(0, file.find("cam_data/")));
    }
  }
}

} // namespace dgtk
