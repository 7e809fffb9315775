// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkHdf5Contents.h"
#include "dgtkJsonFile.h"
#include "dgtkReadTexts.h"
#include "dgtkUtf8.h"

#include <cmath>
#include <set>
#include <utility>

// BlenderProc's container: blenderproc/python/writer/WriterUtility.py and renderer/RendererUtility.py.

namespace dgtk
{

namespace
{
using Json = nlohmann::json;

/// What a key's numbers mean.
struct Key
{
  const char* name;
  const char* layer;
  double nothing; ///< stands for no value; NaN
  Hdf5Dataset::Kind kind;
  bool isLength;
};
constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double farAway = 1e10;
constexpr Key keys[] = { { "colors", "", notANumber, Hdf5Dataset::Kind::Whole, false },
  { "depth", "", farAway, Hdf5Dataset::Kind::Real, true },
  { "distance", "distance", farAway, Hdf5Dataset::Kind::Real, true },
  { "normals", "normal", 0.5, Hdf5Dataset::Kind::Real, false },
  { "nocs", "objectcoords", 0, Hdf5Dataset::Kind::Real, false },
  { "instance_segmaps", "objects", notANumber, Hdf5Dataset::Kind::Whole, false },
  { "class_segmaps", "classes", notANumber, Hdf5Dataset::Kind::Whole, false },
  { "forward_flow", "flow_forward", notANumber, Hdf5Dataset::Kind::Real, false },
  { "backward_flow", "flow_backward", notANumber, Hdf5Dataset::Kind::Real, false },
  { "disparity", "disparity", notANumber, Hdf5Dataset::Kind::Real, false } };

std::string requested(const ExportedFrom& source, const std::string& option)
{
  for (const auto& [name, value] : source.record().request)
  {
    if (name == option)
    {
      return value;
    }
  }
  return option;
}

class FrameReader
{
public:
  FrameReader(ExportJudge& judge, const std::string& file)
    : Judge(judge)
    , File(file)
    , Members(readHdf5(judge.source().path(file)))
  {
  }

  /// `shown` are the cameras and frames of all pictures.
  void eye(const ExportedName& picture, const std::string& suffix, const std::set<std::pair<std::string, int>>& shown)
  {
    const ExportedFrom& source = this->Judge.source();
    std::set<double> seen;
    for (const Key& key : keys)
    {
      const std::string layer = std::string(key.name) == "colors"  ? requested(source, "color")
                                : std::string(key.name) == "depth" ? requested(source, "depth")
                                                                   : key.layer;
      const int step = layer == "flow_forward" ? 1 : layer == "flow_backward" ? -1 : 0;
      const bool leads =
        layer == "disparity" ? !suffix.empty() : shown.count({ picture.camera, picture.frame + step }) > 0;
      const bool has = leads && !source.file(picture.camera, picture.frame, layer).empty();
      const Hdf5Dataset* found = this->take(key.name + suffix, has);
      if (found && has)
      {
        this->compare(picture, key, layer, *found);
      }
      if (found && layer == "objects")
      {
        seen.insert(found->values.begin(), found->values.end());
      }
    }
    this->attributes(this->take("instance_attribute_maps" + suffix, true), seen);
    this->pose(picture, this->take("camera_pose" + suffix, true));
  }

  void finish()
  {
    for (const auto& [name, member] : this->Members)
    {
      this->Judge.holds("keys", this->File, name, this->Taken.count(name) > 0, "a member", "none of this name");
      this->Judge.holds("times", this->File, name, !member.hasTime, "a time", "none");
    }
  }

private:
  const Hdf5Dataset* take(const std::string& name, bool expected)
  {
    const auto found = this->Members.find(name);
    const bool there = found != this->Members.end();
    this->Taken.insert(name);
    this->Judge.holds(
      "keys", this->File, name, there == expected, there ? "a member" : "none", expected ? "one" : "none");
    return there ? &found->second : nullptr;
  }

  /// What stands in the file for a pixel of the dataset.
  double expected(const PictureFile& layer, const Key& key, int x, int y, int c) const
  {
    const std::string name = key.name;
    if (name == "instance_segmaps" || name == "class_segmaps")
    {
      return layer.id(x, y);
    }
    if (name == "nocs" && c == 3)
    {
      return std::isfinite(layer.at(x, y, 0)) ? 1 : 0; // alpha
    }
    const double value = layer.at(x, y, c);
    if (name == "colors")
    {
      return layer.type() == PixelType::UInt16 ? std::round(value / 257) : value;
    }
    if (!std::isfinite(value))
    {
      return key.nothing;
    }
    if (name == "normals")
    {
      return 0.5 + (c == 0 ? value : -value) / 2; // x right, y up, z back
    }
    if (name == "nocs")
    {
      return 0.5 + value / 2;
    }
    const double length = value * metresOf(this->Judge.source());
    return !key.isLength ? value : length > 0 && static_cast<float>(length) == 0 ? key.nothing : length;
  }

  void compare(const ExportedName& picture, const Key& key, const std::string& layer, const Hdf5Dataset& found)
  {
    const PicturePointer values = this->Judge.source().picture(picture.camera, picture.frame, layer,
      std::string(key.name) == "colors" ? std::vector<std::string>{ "png" } : std::vector<std::string>());
    const PicturePointer classes = this->Judge.source().classesOf(picture.camera, picture.frame, layer);
    const bool ids = layer == "objects" || layer == "classes";
    const int channels = ids ? 1 : values->channels() + (layer == "objectcoords" ? 1 : 0);
    std::vector<std::uint64_t> shape{ std::uint64_t(values->height()), std::uint64_t(values->width()) };
    if (channels > 1)
    {
      shape.push_back(std::uint64_t(channels));
    }
    this->Judge.holds(
      "shape", this->File, key.name, found.kind == key.kind && found.dimensions == shape, "another", "the picture's");
    if (found.kind != key.kind || found.dimensions != shape)
    {
      return;
    }
    std::size_t at = 0;
    constexpr double half = 5.97e-8; // of the distance of neighbouring float32
    double largest = 0;
    std::string worst;
    for (int y = 0; y < values->height(); ++y)
    {
      for (int x = 0; x < values->width(); ++x)
      {
        for (int c = 0; c < channels; ++c, ++at)
        {
          const bool gone = classes && classes->at(x, y) == 0;
          const double want = gone ? key.nothing : this->expected(*values, key, x, y, c);
          const double value = found.values[at];
          const bool same = value == want || (std::isnan(value) && std::isnan(want));
          const double slack = key.kind == Hdf5Dataset::Kind::Real ? half * std::abs(want) : 0;
          const double apart = same ? 0 : std::isnan(value - want) ? infinite : beyond(std::abs(value - want), slack);
          if (apart > largest)
          {
            largest = apart;
            worst = key.name + (" at " + std::to_string(x) + ", " + std::to_string(y));
          }
        }
      }
    }
    this->Judge.exact(layer, "", this->File, worst, largest, 0);
  }

  void attributes(const Hdf5Dataset* text, const std::set<double>& seen)
  {
    if (!text)
    {
      return;
    }
    useJson(this->Judge.source().path(this->File),
      [&]
      {
        std::set<double> listed;
        for (const Json& one : Json::parse(text->text))
        {
          const auto id = one.at("idx").get<std::uint32_t>();
          listed.insert(id);
          const ObjectRecord* object = this->Judge.source().object(id);
          const Json expected{ { "idx", id }, { "category_id", object ? object->classId : 0 },
            { "name", object ? utf8FromBytes(object->name) : "background" } };
          this->Judge.holds("attributes", this->File, std::to_string(id), one == expected, one.dump(), expected.dump());
        }
        this->Judge.holds("attributes", this->File, "ids", listed == seen, "others", "those that are seen");
      });
  }

  void pose(const ExportedName& picture, const Hdf5Dataset* text)
  {
    if (!text)
    {
      return;
    }
    useJson(this->Judge.source().path(this->File),
      [&]
      {
        const Json document = Json::parse(text->text);
        const auto matrix = [&](const char* key) { return matrixOf(document.at(key)); };
        this->Judge.intrinsics(this->File, picture.camera, picture.frame, fromWholeCentres(matrix("cam_K")), 1e-9);
        const auto t = document.at("cam_t_w2c").get<std::vector<double>>();
        this->Judge.pose(this->File, picture.camera, picture.frame, matrix("cam_R_w2c"),
          Eigen::Vector3d(t.at(0), t.at(1), t.at(2)) / metresOf(this->Judge.source()), 1e-9);
      });
  }

  ExportJudge& Judge;
  std::string File;
  std::map<std::string, Hdf5Dataset> Members;
  std::set<std::string> Taken;
};
} // namespace

void readHdf5Frames(ExportJudge& judge)
{
  std::set<std::pair<std::string, int>> shown;
  for (const ExportedName& one : judge.source().record().names)
  {
    shown.emplace(one.camera, one.frame);
  }
  std::size_t pictures = 0;
  for (const ExportedFile* one : filesIn(judge.source(), "", "hdf5"))
  {
    const std::string& file = one->file.path;
    FrameReader reader(judge, file);
    for (const char* suffix : { "", "_0", "_1" })
    {
      if (const ExportedName* picture = judge.source().named(file + suffix))
      {
        reader.eye(*picture, suffix, shown);
        ++pictures;
      }
    }
    reader.finish();
  }
  judge.exact("pictures", "", "", "", double(pictures), double(judge.source().record().names.size()));
}

} // namespace dgtk
