// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkReadRos.h"

#include "dgtkError.h"
#include "dgtkExportPixels.h"
#include "dgtkHash.h"
#include "dgtkReadTexts.h"

#include <algorithm>
#include <cmath>
#include <sstream>

// ROS 1: how messages are serialised (wiki.ros.org/msg), sensor_msgs, tf2_msgs; REP 103 (axes), REP 118 (depth).

namespace dgtk
{

namespace
{
constexpr double second = 1e9;

std::string optionOf(const ExportedFrom& source, const std::string& name)
{
  for (const auto& [key, value] : source.record().request)
  {
    if (key == name)
    {
      return value;
    }
  }
  return {};
}

struct KnownType
{
  const char* name;
  const char* md5;
  const char* fields; ///< all numbers and texts in their order
};
constexpr const char* headerFields = "uint32 header.seq;time header.stamp;string header.frame_id;";
constexpr KnownType knownTypes[] = {
  { "sensor_msgs/CompressedImage", "8f7a12909da2c9d3332d540a0977563f", "%string format;uint8[] data;" },
  { "sensor_msgs/Image", "060021388200f6f0f447d0fcd9c64743",
    "%uint32 height;uint32 width;string encoding;uint8 is_bigendian;uint32 step;uint8[] data;" },
  { "sensor_msgs/CameraInfo", "c9a58c1b0b154e0e6da7578cb991d214",
    "%uint32 height;uint32 width;string distortion_model;float64[] D;float64[9] K;float64[9] R;float64[12] P;"
    "uint32 binning_x;uint32 binning_y;uint32 roi.x_offset;uint32 roi.y_offset;uint32 roi.height;uint32 roi.width;"
    "bool roi.do_rectify;" },
  { "tf2_msgs/TFMessage", "94810edda583a504dfda3829e70d7eec",
    "uint32 transforms[].header.seq;time transforms[].header.stamp;string transforms[].header.frame_id;"
    "string transforms[].child_frame_id;float64 transforms[].transform.translation.x;"
    "float64 transforms[].transform.translation.y;float64 transforms[].transform.translation.z;"
    "float64 transforms[].transform.rotation.x;float64 transforms[].transform.rotation.y;"
    "float64 transforms[].transform.rotation.z;float64 transforms[].transform.rotation.w;" },
};

/// The parts of a definition by the last word of their names; "" is the first.
std::map<std::string, std::string> partsOf(const std::string& definition)
{
  std::map<std::string, std::string> parts;
  std::istringstream lines(definition);
  std::string line;
  std::string part;
  while (std::getline(lines, line))
  {
    if (line.rfind("MSG: ", 0) == 0)
    {
      part = line.substr(line.rfind('/') + 1);
    }
    else if (!line.empty() && line[0] != '=')
    {
      parts[part] += line + '\n';
    }
  }
  return parts;
}

/// `left`: letters, far more than any known type has, so that types that name each other come to an end.
std::string flattened(const std::map<std::string, std::string>& parts, const std::string& part,
  const std::string& prefix, int depth, std::size_t& left)
{
  std::string all;
  std::istringstream words(parts.at(part));
  std::string type;
  std::string name;
  while (left > 0 && words >> type >> name)
  {
    left -= std::min(left, prefix.size() + type.size() + name.size());
    const std::size_t bracket = type.find('[');
    const std::string base = type.substr(0, bracket);
    const std::string key = base.substr(base.rfind('/') + 1);
    const std::string array = bracket == std::string::npos ? "" : "[]";
    all += parts.count(key) > 0 && depth < 8 ? flattened(parts, key, prefix + name + array + '.', depth + 1, left)
                                             : type + ' ' + prefix + name + ';';
  }
  return all;
}

std::vector<double> takeNumbers(RosBytes& bytes, std::size_t count)
{
  std::vector<double> numbers;
  std::generate_n(std::back_inserter(numbers), count, [&] { return bytes.take<double>(); });
  return numbers;
}

/// Metres that b lies to the right of a, of parallel pinholes with rows in common; 0 for others.
double rightwards(const CameraRecord& a, const CameraRecord& b, double metres)
{
  const auto plain = [](const CameraRecord& camera)
  {
    const auto found = camera.numbers.find("distortion");
    return camera.model == "pinhole" && camera.rollingShutter.duration == 0 &&
           (found == camera.numbers.end() ||
             std::all_of(found->second.begin(), found->second.end(), [](double k) { return k == 0; }));
  };
  const Eigen::Vector3d apart = a.t - b.t;
  const double slack = 1e-9 * std::max({ 1e-300, a.t.norm(), b.t.norm() });
  Eigen::Matrix3d lenses = a.K - b.K;
  lenses(0, 2) = 0; // the columns of their centres are no concern of rows
  const bool parallel = plain(a) && plain(b) && a.width == b.width && a.height == b.height &&
                        (a.R - b.R).cwiseAbs().maxCoeff() <= 1e-9 &&
                        lenses.cwiseAbs().maxCoeff() <= 1e-9 * std::max(1.0, a.K(0, 0));
  return parallel && apart.x() > slack && std::hypot(apart.y(), apart.z()) <= 2 * slack ? apart.x() * metres : 0;
}
} // namespace

const char* RosBytes::skip(std::size_t bytes)
{
  if (this->Size - this->At < bytes)
  {
    throw InputError(this->File, "ends too early");
  }
  this->At += bytes;
  return this->Data + this->At - bytes;
}

std::uint64_t RosBytes::time()
{
  const std::uint64_t seconds = this->take<std::uint32_t>();
  return seconds * std::uint64_t(second) + this->take<std::uint32_t>();
}

RosBytes RosBytes::part()
{
  const auto bytes = this->take<std::uint32_t>();
  return { this->File, this->skip(bytes), bytes };
}

RosFile::RosFile(const std::string& path)
  : Path(path)
  , Stream(path, std::ios::binary | std::ios::ate)
  , Size(this->Stream ? static_cast<std::uint64_t>(this->Stream.tellg()) : 0)
{
}

std::string RosFile::read(std::uint64_t position, std::uint64_t bytes)
{
  if (position > this->Size || bytes > this->Size - position)
  {
    throw InputError(this->Path, "ends too early");
  }
  std::string text(bytes, '\0');
  this->Stream.seekg(static_cast<std::streamoff>(position));
  this->Stream.read(&text[0], static_cast<std::streamsize>(bytes));
  return text;
}

RosReferee::RosReferee(ExportJudge& judge, const std::string& file)
  : Judge(judge)
  , File(file)
  , Color(optionOf(judge.source(), "color"))
  , Depth(optionOf(judge.source(), "depth"))
  , Metres(metresOf(judge.source()))
{
  for (const ExportedName& name : judge.source().record().names)
  {
    if (name.name.rfind(file + ':', 0) == 0)
    {
      this->Names[name.name] = &name;
    }
  }
  const std::string poses = judge.source().dataset() + '/' + posesName;
  if (std::ifstream(poses))
  {
    for (const PoseRecord& pose : readPoses(poses))
    {
      this->Poses[{ pose.frame, pose.id }] = pose;
    }
  }
}

void RosReferee::holds(const std::string& where, bool right, const std::string& found, const std::string& expected)
{
  this->Judge.holds("recording", this->File, where, right, found, expected);
}

void RosReferee::topic(
  const std::string& topic, const std::string& type, const std::string& md5, const std::string& definition)
{
  const auto* known =
    std::find_if(std::begin(knownTypes), std::end(knownTypes), [&](const KnownType& one) { return type == one.name; });
  if (known == std::end(knownTypes))
  {
    this->holds(topic, false, type, "a type of the dataset's messages");
    return;
  }
  const std::string fields = known->fields;
  const std::string expected = fields[0] == '%' ? headerFields + fields.substr(1) : fields;
  const auto parts = partsOf(definition);
  std::size_t left = 4096;
  const std::string found = parts.count("") > 0 ? flattened(parts, "", "", 0, left) : "nothing";
  this->holds(topic, md5 == known->md5, md5, known->md5);
  this->holds(topic, found == expected, found, expected);
}

const ExportedName* RosReferee::nameOf(const std::string& camera, std::uint64_t time) const
{
  const std::string rest = std::to_string(time % std::uint64_t(second));
  const std::string name = this->File + ':' + camera + '@' + std::to_string(time / std::uint64_t(second)) + '.' +
                           std::string(9 - rest.size(), '0') + rest;
  const auto found = this->Names.find(name);
  return found == this->Names.end() ? nullptr : found->second;
}

void RosReferee::header(RosBytes& bytes, const std::string& topic, std::uint64_t time, const std::string& frame)
{
  bytes.take<std::uint32_t>();
  const std::uint64_t stamp = bytes.time();
  this->holds(topic, stamp == time, std::to_string(stamp), std::to_string(time));
  const std::string found = bytes.text();
  this->holds(topic, found == frame, found, frame);
}

void RosReferee::message(const std::string& topic, const std::string& type, std::uint64_t time, RosBytes bytes)
{
  const bool once = topic == "/tf" || this->Seen.insert({ topic, time }).second;
  this->holds(topic, once, "a time twice", "each once");
  if (topic == "/tf")
  {
    this->transforms(bytes, time);
    this->holds(topic, !bytes.more(), "more bytes", "the end of the message");
    return;
  }
  const std::size_t slash = topic.find('/', 1);
  const std::string camera = topic.substr(1, slash == std::string::npos ? slash : slash - 1);
  const std::string what = slash == std::string::npos ? "" : topic.substr(slash + 1);
  const ExportedName* name = this->nameOf(camera, time);
  this->holds(topic, name != nullptr, "a time without a picture", "one of export.json");
  if (!name)
  {
    return;
  }
  this->header(bytes, topic, time, camera + "_optical_frame");
  this->Judge.number(
    "time", "s", this->File, topic, double(time) / second, name->frame / this->Judge.source().manifest().fps + 1, 1e-9);
  if (type == "sensor_msgs/CompressedImage" && what == "image_raw/compressed")
  {
    this->picture(bytes, *name);
  }
  else if (type == "sensor_msgs/Image" && what == "depth/image_raw")
  {
    this->depth(bytes, *name);
  }
  else if (type == "sensor_msgs/CameraInfo" && (what == "camera_info" || what == "depth/camera_info"))
  {
    this->info(bytes, *name);
  }
  else
  {
    this->holds(topic, false, type, "another type");
    return;
  }
  this->holds(topic, !bytes.more(), "more bytes", "the end of the message");
}

void RosReferee::picture(RosBytes& bytes, const ExportedName& name)
{
  const ExportedFrom& source = this->Judge.source();
  const std::string format = bytes.text();
  const std::string data = bytes.text();
  const std::string where = name.camera + " at frame " + std::to_string(name.frame);
  if (format == "png")
  {
    Sha256 hash;
    hash.update(data.data(), data.size());
    const std::optional<DatasetFile> own = source.listed(source.file(name.camera, name.frame, this->Color, { "png" }));
    const bool same = own && own->sha256 == hash.hex();
    this->Judge.holds(this->Color, this->File, where, same, "other bytes", "the dataset's file");
    return;
  }
  this->holds(where, format == "jpeg", format, "jpeg");
  const DecodedPixels found = decodeJpeg(this->File, data);
  const PicturePointer expected = source.picture(name.camera, name.frame, this->Color, { "png" });
  this->Judge.size(this->File, name.camera, name.frame, found.width, found.height);
  double largest = 0;
  for (int y = 0; y < std::min(found.height, expected->height()); ++y)
  {
    for (int x = 0; x < std::min(found.width, expected->width()); ++x)
    {
      for (int c = 0; c < std::min(found.channels, expected->channels()); ++c)
      {
        const double level = expected->type() == PixelType::UInt16 ? 257 : 1;
        const double slack = level > 1 ? 0.5 : 0;
        largest = larger(largest, std::abs(found.at(x, y, c) - expected->at(x, y, c) / level) - slack);
      }
    }
  }
  double stated = 0;
  for (const LayerRounding& one : source.record().layers)
  {
    stated = one.layer == this->Color && one.unit == "levels" ? one.largest : stated;
  }
  this->Judge.number(this->Color, "levels", this->File, where, largest, 0, stated);
}

void RosReferee::depth(RosBytes& bytes, const ExportedName& name)
{
  const std::string where = name.camera + " at frame " + std::to_string(name.frame);
  const auto height = bytes.take<std::uint32_t>();
  const auto width = bytes.take<std::uint32_t>();
  this->Judge.size(this->File, name.camera, name.frame, int(width), int(height));
  const std::string encoding = bytes.text();
  const auto big = bytes.take<std::uint8_t>();
  const auto step = bytes.take<std::uint32_t>();
  RosBytes data = bytes.part();
  const bool plain = encoding == "32FC1" && big == 0 && step == 4 * width;
  this->holds(where, plain && data.size() == std::size_t(step) * height, encoding, "32FC1, little-endian");
  const PicturePointer expected = this->Judge.source().picture(name.camera, name.frame, this->Depth);
  if (!plain || int(width) != expected->width() || int(height) != expected->height())
  {
    return;
  }
  double largest = 0; // of half the distance of float32
  for (int y = 0; y < int(height); ++y)
  {
    for (int x = 0; x < int(width); ++x)
    {
      const double found = double(data.take<float>());
      const double want = expected->at(x, y) * this->Metres;
      const bool there = want <= double(std::numeric_limits<float>::max()) && static_cast<float>(want) > 0;
      const double apart = there ? std::abs(found - want) / (5.97e-8 * std::abs(want) + 1e-45) : 0;
      largest = std::max(largest, std::isnan(found) == there ? infinite : apart);
    }
  }
  this->Judge.number(this->Depth, "roundings to float32", this->File, where, largest, 0, 1);
}

void RosReferee::info(RosBytes& bytes, const ExportedName& name)
{
  const std::string where = name.camera + " at frame " + std::to_string(name.frame);
  const auto height = bytes.take<std::uint32_t>();
  const auto width = bytes.take<std::uint32_t>();
  this->Judge.size(this->File, name.camera, name.frame, int(width), int(height));
  const std::string model = bytes.text();
  std::vector<double> D = takeNumbers(bytes, bytes.take<std::uint32_t>());
  const Eigen::Matrix3d K = matrixOf(takeNumbers(bytes, 9));
  const Eigen::Matrix3d R = matrixOf(takeNumbers(bytes, 9));
  const std::vector<double> P = takeNumbers(bytes, 12);
  const std::string rest = bytes.rest();
  bytes.skip(rest.size());
  this->holds(where, rest == std::string(25, '\0'), "binning or a region", "the whole picture");
  this->holds(where, R == Eigen::Matrix3d::Identity() && matrixOf(P, 4) == K, "another R or P", "no rectification");
  this->Judge.intrinsics(this->File, name.camera, name.frame, fromWholeCentres(K), 1e-9);
  this->baseline(name, -P[3] / P[0]);
  this->Judge.exact("baseline", "m", this->File, where, std::abs(P[7]) + std::abs(P[11]), 0);
  const CameraRecord* camera = this->Judge.source().camera(name.camera, name.frame);
  const auto numbers =
    camera ? camera->numbers.find("distortion") : std::map<std::string, std::vector<double>>::iterator();
  std::vector<double> k = camera && numbers != camera->numbers.end() ? numbers->second : std::vector<double>();
  k.resize(std::max<std::size_t>(k.size(), 14));
  const bool bent = std::any_of(k.begin() + 5, k.end(), [](double one) { return one != 0; });
  const bool fish = camera && camera->model == "fisheye";
  const std::string expected = fish ? "equidistant" : bent ? "rational_polynomial" : "plumb_bob";
  const std::size_t count = fish ? 4 : bent ? 8 : 5;
  this->Judge.holds("lens", this->File, where, model == expected && D.size() == count, model, expected);
  D.resize(14);
  this->Judge.holds("lens", this->File, where, D == k, "other coefficients", "the camera's");
}

/// A baseline leads to a camera on the left.
void RosReferee::baseline(const ExportedName& name, double metres)
{
  const ExportedFrom& source = this->Judge.source();
  const CameraRecord* own = source.camera(name.camera, name.frame);
  if (metres == 0 || !own)
  {
    return;
  }
  double nearest = infinite;
  for (const auto& entry : this->Names)
  {
    const CameraRecord* other =
      entry.second->frame == name.frame ? source.camera(entry.second->camera, name.frame) : nullptr;
    const double apart = other && other->name != name.camera ? rightwards(*other, *own, this->Metres) : 0;
    if (apart > 0 && std::abs(apart - metres) < std::abs(nearest - metres))
    {
      nearest = apart;
      this->Partners[name.camera] = other->name;
    }
  }
  const double size = std::isfinite(nearest) ? std::max(1.0, nearest) : 1; // what leads to no camera is no rounding
  this->Judge.number("baseline", "m", this->File, name.camera, metres, nearest, 1e-9 * size);
}

/// A camera that could be the right one of a pair, and is not, belongs to another pair, or the left one does.
void RosReferee::judgePartners()
{
  const ExportedFrom& source = this->Judge.source();
  std::map<std::string, std::set<int>> frames;
  for (const auto& [name, picture] : this->Names)
  {
    if (source.camera(picture->camera, picture->frame))
    {
      frames[picture->camera].insert(picture->frame);
    }
  }
  std::set<std::string> paired;
  for (const auto& [right, left] : this->Partners)
  {
    paired.insert({ right, left });
  }
  for (const auto& [right, at] : frames)
  {
    for (const auto& [left, others] : frames)
    {
      const bool pair = left != right && paired.count(left) == 0 && paired.count(right) == 0 && others == at &&
                        std::all_of(at.begin(), at.end(),
                          [&, &l = left, &r = right](int frame)
                          { return rightwards(*source.camera(l, frame), *source.camera(r, frame), this->Metres) > 0; });
      this->Judge.holds("baseline", this->File, right, !pair, "none", "that of " + left);
    }
  }
}

void RosReferee::transforms(RosBytes& bytes, std::uint64_t time)
{
  const ExportedFrom& source = this->Judge.source();
  constexpr const char* ending = "_optical_frame";
  for (auto left = bytes.take<std::uint32_t>(); left > 0; --left)
  {
    this->header(bytes, "/tf", time, "world");
    const std::string child = bytes.text();
    const std::vector<double> n = takeNumbers(bytes, 7);
    const Eigen::Vector3d t(n[0], n[1], n[2]);
    const Eigen::Vector4d q(n[3], n[4], n[5], n[6]);
    this->Judge.number("quaternion", "1", this->File, child, q.norm(), 1, 1e-12);
    const Eigen::Matrix3d R = rotationOf(q);
    const std::size_t at = child.rfind(ending);
    const ExportedName* name = at == std::string::npos ? nullptr : this->nameOf(child.substr(0, at), time);
    if (name)
    {
      this->holds(child, this->Seen.insert({ "/tf " + name->camera, time }).second, "a time twice", "each once");
      this->Judge.pose(this->File, name->camera, name->frame, R.transpose(), -(R.transpose() * t) / this->Metres, 1e-9);
      continue;
    }
    const double frame = (double(time) / second - 1) * source.manifest().fps;
    this->object(child, int(std::lround(frame)), R, t);
  }
}

void RosReferee::object(const std::string& child, int frame, const Eigen::Matrix3d& R, const Eigen::Vector3d& t)
{
  const std::string digits = child.substr(child.rfind('_') + 1);
  const bool number =
    !digits.empty() && digits.size() < 10 && digits.find_first_not_of("0123456789") == std::string::npos;
  const auto pose = number ? this->Poses.find({ frame, std::uint32_t(std::stoul(digits)) }) : this->Poses.end();
  const std::string where = child + " at frame " + std::to_string(frame);
  const bool known = pose != this->Poses.end() && pose->second.rigid && pose->second.visible;
  this->Judge.holds("object pose", this->File, where, known, "a pose", "no such object, or none that is there");
  if (known)
  {
    this->Objects[frame].insert(pose->first.second);
    const double size = std::max(1.0, pose->second.t.norm());
    const double error = larger(apart(R, pose->second.R), apart(t / this->Metres, pose->second.t) / size);
    this->Judge.number("pose of objects", "1", this->File, where, error, 0, 1e-9);
  }
}

void RosReferee::finish()
{
  std::set<int> frames;
  for (const auto& entry : this->Names)
  {
    frames.insert(entry.second->frame);
  }
  this->Judge.exact(
    "messages", "messages", this->File, "of pictures", double(this->Seen.size()), 5.0 * double(this->Names.size()));
  for (const int frame : frames)
  {
    const auto there = std::count_if(this->Poses.begin(), this->Poses.end(),
      [&](const auto& one) { return one.first.first == frame && one.second.rigid && one.second.visible; });
    this->Judge.exact("objects", "objects", this->File, "frame " + std::to_string(frame),
      double(this->Objects[frame].size()), double(there));
  }
  this->judgePartners();
}

} // namespace dgtk
