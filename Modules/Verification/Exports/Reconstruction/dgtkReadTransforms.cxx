// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExportPixels.h"
#include "dgtkJsonFile.h"
#include "dgtkReadTexts.h"

#include <algorithm>
#include <cmath>
#include <cstring>

// The keys that nerfstudio ("Data conventions") and instant-ngp (nerf_loader.cu) read.

namespace dgtk
{

namespace
{
using Json = nlohmann::json;

/// A number of the frame, else of the document.
double numberOf(const Json& document, const Json& frame, const char* key)
{
  return frame.contains(key) ? frame.at(key).get<double>() : document.at(key).get<double>();
}

void judgeLens(
  ExportJudge& judge, const std::string& file, const Json& document, const Json& frame, const ExportedName& picture)
{
  const CameraRecord* camera = judge.source().camera(picture.camera, picture.frame);
  if (!camera)
  {
    return;
  }
  const auto number = [&](const char* key) { return numberOf(document, frame, key); };
  const Eigen::Matrix3d K = matrixOf({ number("fl_x"), 0, number("cx"), 0, number("fl_y"), number("cy"), 0, 0, 1 });
  judge.intrinsics(file, picture.camera, picture.frame, K, 1e-9);
  judge.size(file, picture.camera, picture.frame, int(number("w")), int(number("h")));
  const double angle = 2 * std::atan(0.5 * number("w") / number("fl_x"));
  judge.number("angle", "rad", file, picture.name, number("camera_angle_x"), angle, 1e-12);
  const double high = 2 * std::atan(0.5 * number("h") / number("fl_y"));
  judge.number("angle", "rad", file, picture.name, number("camera_angle_y"), high, 1e-12);
  const bool fisheye = camera->model == "fisheye";
  const bool same =
    document.at("camera_model") == (fisheye ? "OPENCV_FISHEYE" : "OPENCV") && document.at("is_fisheye") == fisheye;
  judge.holds("model", file, picture.name, same, document.at("camera_model"), camera->model);
  const auto known = camera->numbers.find("distortion");
  std::vector<double> expected = known == camera->numbers.end() ? std::vector<double>() : known->second;
  expected.resize(std::max<std::size_t>(expected.size(), 4));
  const std::vector<const char*> keys =
    fisheye ? std::vector<const char*>{ "k1", "k2", "k3", "k4" } : std::vector<const char*>{ "k1", "k2", "p1", "p2" };
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    judge.exact("distortion", "1", file, picture.name, i < keys.size() ? number(keys[i]) : 0, expected[i]);
  }
}

void judgePose(ExportJudge& judge, const std::string& file, const Json& rows, const ExportedName& picture)
{
  Eigen::Matrix4d M;
  for (std::size_t i = 0; i < requireSize(rows, 4); ++i)
  {
    const std::vector<double> row = numberList(rows[i], 4);
    M.row(Eigen::Index(i)) = Eigen::Map<const Eigen::RowVector4d>(row.data());
  }
  Eigen::Matrix3d turn = M.topLeftCorner<3, 3>();
  turn.col(1) *= -1; // y up, z back
  turn.col(2) *= -1;
  const Eigen::Matrix3d R = turn.transpose();
  judge.pose(file, picture.camera, picture.frame, R, -(R * M.topRightCorner<3, 1>()), 1e-9);
  judge.holds("pose", file, picture.name, M.row(3) == Eigen::RowVector4d(0, 0, 0, 1), "another last row", "0 0 0 1");
}

void judgeFrame(ExportJudge& judge, const std::string& file, const Json& document, const Json& frame)
{
  const std::string path = frame.at("file_path");
  const ExportedName* picture = pictureOf(judge, file, path);
  if (!picture)
  {
    return;
  }
  judgeLens(judge, file, document, frame, *picture);
  judgePose(judge, file, frame.at("transform_matrix"), *picture);
  for (const auto& [key, folder] : { std::pair<const char*, const char*>{ "depth_path", "depth/" },
         { "depth_file_path", "depth/" }, { "mask_path", "masks/" } })
  {
    const std::string expected = folder + stemOf(path) + ".png";
    const std::string found = frame.value(key, "");
    const bool there = judge.source().exported(expected) != nullptr;
    judge.holds("names", file, path + ' ' + key, found == (there ? expected : ""), found, expected);
    if (there && found == expected && folder == std::string("depth/"))
    {
      const double step = numberOf(judge.source().exported(expected)->encoding, "scale", 0);
      judge.exact("depth scale", "scene units", file, key, document.at("integer_depth_scale"), step);
      judge.holds("depth scale", file, key, document.at("enable_depth_loading") == true, "not enabled", "enabled");
    }
  }
}

void judgePoints(ExportJudge& judge, const std::string& name)
{
  const std::string bytes = readFile(judge.source().path(name));
  const std::size_t head = std::min(bytes.find("end_header\n"), bytes.size()) + 11;
  std::vector<TrackPoint> points = trackPointsOf(judge.source());
  points.erase(
    std::remove_if(points.begin(), points.end(), [](const TrackPoint& one) { return !one.isStatic; }), points.end());
  constexpr std::size_t row = 15; // three float32, three bytes
  std::string expected = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(points.size()) + '\n';
  for (const char* property : { "float x", "float y", "float z", "uchar red", "uchar green", "uchar blue" })
  {
    expected += std::string("property ") + property + '\n';
  }
  judge.holds("points", name, "head", bytes.substr(0, head) == expected + "end_header\n", "another", expected);
  judge.exact("points", "", name, "bytes", double(bytes.size()), double(head + row * points.size()));
  for (std::size_t i = 0; i < points.size() && head + row * (i + 1) <= bytes.size(); ++i)
  {
    float x[3];
    std::memcpy(x, bytes.data() + head + row * i, sizeof x);
    const Eigen::Vector3d found = Eigen::Map<const Eigen::Vector3f>(x).cast<double>();
    judge.number("points", "scene units", name, "point " + std::to_string(i + 1), apart(found, points[i].x), 0,
      6e-8 * std::max(1.0, points[i].x.cwiseAbs().maxCoeff()));
    const bool same = std::memcmp(bytes.data() + head + row * i + 12, points[i].color, 3) == 0;
    judge.holds("colors", name, "point " + std::to_string(i + 1), same, "another", "that of tracks/points.json");
  }
}
} // namespace

void readTransforms(ExportJudge& judge)
{
  const std::string file = "transforms.json";
  const std::string path = judge.source().path(file);
  const Json document = readJsonFile(path);
  useJson(path,
    [&]
    {
      const Json& frames = document.at("frames");
      judge.exact("frames", "", file, "", double(frames.size()), double(judge.source().record().names.size()));
      for (const Json& frame : frames)
      {
        judgeFrame(judge, file, document, frame);
      }
      const int scale = document.at("aabb_scale");
      judge.holds("aabb_scale", file, "", scale > 0 && scale <= 128 && (scale & (scale - 1)) == 0,
        std::to_string(scale), "a power of two up to 128");
      for (const char* key : { "train_filenames", "val_filenames", "test_filenames" })
      {
        for (const Json& name : document.value(key, Json::array()))
        {
          pictureOf(judge, file, name);
        }
      }
      judgePoints(judge, document.at("ply_file_path"));
    });
}

// load_blender.py of the original NeRF: focal = w / 2 / tan(angle / 2), the middle at w/2, h/2.
void readNerfSynthetic(ExportJudge& judge)
{
  std::size_t frames = 0;
  for (const char* split : { "train", "val", "test" })
  {
    const std::string file = std::string("transforms_") + split + ".json";
    if (!judge.source().exported(file))
    {
      continue;
    }
    const std::string path = judge.source().path(file);
    const Json document = readJsonFile(path);
    useJson(path,
      [&]
      {
        for (const Json& frame : document.at("frames"))
        {
          ++frames;
          const std::string name = frame.at("file_path").get<std::string>().substr(2) + ".png";
          const ExportedName* picture = pictureOf(judge, file, name);
          const CameraRecord* camera = picture ? judge.source().camera(picture->camera, picture->frame) : nullptr;
          if (camera)
          {
            const double focal = camera->width / 2.0 / std::tan(document.at("camera_angle_x").get<double>() / 2);
            Eigen::Matrix3d K;
            K << focal, 0, camera->width / 2.0, 0, focal, camera->height / 2.0, 0, 0, 1;
            judge.intrinsics(file, picture->camera, picture->frame, K, 1e-6);
            judgePose(judge, file, frame.at("transform_matrix"), *picture);
          }
        }
      });
  }
  judge.exact("frames", "", "", "all parts", double(frames), double(judge.source().record().names.size()));
}

} // namespace dgtk
