// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkExportJudge_h
#define dgtkExportJudge_h

#include "dgtkDataset.h"
#include "dgtkMeter.h"

#include "dgtkExportDocument.h"
#include "dgtkFileTable.h"
#include "dgtkObjectDocuments.h"

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace dgtk
{

/// The dataset that an export was made from, and the export's own record. Pictures are those of names in export.json.
class ExportedFrom
{
public:
  /// Throws InputError and UsageError as verifyExport().
  ExportedFrom(const std::string& dataset, const std::string& folder);

  const std::string& dataset() const { return this->DatasetFolder; }
  /// What stands before the names of cameras and files of each dataset: "" of one alone, "SCENE/" of many.
  const std::vector<std::string>& parts() const { return this->Parts; }
  /// Of a camera: which of these.
  std::string partOf(const std::string& camera) const;
  /// A document of the first dataset that says what holds for all.
  std::string document(const std::string& name) const { return this->DatasetFolder + '/' + this->Parts[0] + name; }
  const std::string& folder() const { return this->Folder; }
  const ExportRecord& record() const { return this->Record; }
  /// Of the first dataset, without its files.
  const Manifest& manifest() const { return this->Manifests.at(this->Parts[0]); }
  /// Of a camera's dataset. Throws std::out_of_range for a camera of none.
  const Manifest& manifestOf(const std::string& camera) const { return this->Manifests.at(this->partOf(camera)); }
  /// A file of the dataset; none that its manifest does not list.
  std::optional<DatasetFile> listed(const std::string& path) const;
  /// Those of a picture.
  std::vector<DatasetFile> filesOf(const std::string& camera, int frame) const;
  /// A file of the export, or null.
  const ExportedFile* exported(const std::string& name) const;
  std::string path(const std::string& name) const { return this->Folder + '/' + name; } ///< of a file of the export
  /// The text of a convention that the export states; "" for one that it does not.
  std::string convention(const std::string& key) const;
  /// The export's name of a picture, or null; and the picture of a name.
  const ExportedName* nameOf(const std::string& camera, int frame) const;
  const ExportedName* named(const std::string& name) const;
  /// How many pictures have names that begin so.
  std::size_t picturesBelow(const std::string& folder) const;

  const CameraRecord* camera(const std::string& name, int frame) const;
  const std::vector<ObjectRecord>& objects() const { return this->Objects.begin()->second; } ///< of the first dataset
  const ObjectRecord* object(std::uint32_t id) const { return this->object(this->Parts[0], id); }
  /// Of a camera's dataset.
  const ObjectRecord* object(const std::string& camera, std::uint32_t id) const;
  /// Records of the layer `boxes` of a picture; empty without the layer. Kept for the last picture only.
  const std::vector<BoxRecord>& boxes(const std::string& camera, int frame) const;
  /// A layer's file of a picture, exact formats first; "" for none. Of depths a .png is a picture for people, no
  /// values: it is found where it is asked for.
  std::string file(const std::string& camera, int frame, const std::string& layer,
    const std::vector<std::string>& extensions = {}) const;
  /// The same, read. Throws InputError without a file.
  PicturePointer picture(const std::string& camera, int frame, const std::string& layer,
    const std::vector<std::string>& extensions = {}) const;
  /// The class image of a layer, null for none. A surface of class 0 is gone in the other view: of its values, formats
  /// without classes hold none.
  PicturePointer classesOf(const std::string& camera, int frame, const std::string& layer) const;

private:
  void addCameras(const std::string& part);
  void addPart(const std::string& part);
  std::string folderOf(const std::string& part) const;
  std::uint32_t shotOf(const std::string& camera, int frame) const;
  bool holdsDepths(const std::string& camera, const std::string& layer) const;
  DatasetFile fileAt(std::uint32_t number) const;

  std::string DatasetFolder;
  std::vector<std::string> Parts;
  std::string Folder;
  ExportRecord Record;
  std::map<std::string, Manifest> Manifests; ///< by part
  std::vector<CameraRecord> Cameras;         ///< by name and frame; a picture's place is its shot in the table of files
  FileTable Files;
  std::map<std::string, std::vector<ObjectRecord>> Objects; ///< by part
  std::vector<const ExportedName*> ByPlace;                 ///< sorted by camera and frame
  std::vector<const ExportedName*> ByName;                  ///< sorted by name
  std::vector<const ExportedFile*> ByPath;                  ///< sorted by path
  mutable std::mutex Mutex;
  mutable std::pair<std::string, int> BoxesOf;
  mutable std::vector<BoxRecord> Boxes;
};

/// What a format's reader tells of an export's documents; each value is compared with the dataset's at once.
class ExportJudge
{
public:
  ExportJudge(const ExportedFrom& source, Results& results)
    : Source(source)
    , TheResults(results)
  {
  }
  ~ExportJudge();
  const ExportedFrom& source() const { return this->Source; }

  /// `file`: the document that says it, relative to the export. Tolerances are absolute but for K, whose is in pixels;
  /// each value has its own, and the row shows the largest of them.
  /// K with pixel centres at + 0.5.
  void intrinsics(
    const std::string& file, const std::string& camera, int frame, const Eigen::Matrix3d& K, double tolerance);
  void size(const std::string& file, const std::string& camera, int frame, std::int64_t width, std::int64_t height);
  /// x_camera = R x_world + t, x right, y down, z forward, scene units. `tolerance` of R's numbers, and of t's as a
  /// share of the larger of 1 and its length.
  void pose(const std::string& file, const std::string& camera, int frame, const Eigen::Matrix3d& R,
    const Eigen::Vector3d& t, double tolerance);
  /// The visible box of an object, [x0, y0, x1, y1] of pixels' borders.
  void box(const std::string& file, const std::string& camera, int frame, std::uint32_t object,
    const Eigen::Vector4d& box, double tolerance);
  /// The pixels that show an object, rows top to bottom.
  void mask(const std::string& file, const std::string& camera, int frame, std::uint32_t object,
    const std::vector<char>& inside);
  /// The same of all its pixels, hidden ones included.
  void amodalMask(const std::string& file, const std::string& camera, int frame, std::uint32_t object,
    const std::vector<char>& inside);
  /// Any number of a document: "what" is the row's layer ("visible fraction"), `where` says which in words.
  void number(const std::string& what, const std::string& unit, const std::string& file, const std::string& where,
    double found, double expected, double tolerance);
  /// One that is exact, such as a count.
  void exact(const std::string& what, const std::string& unit, const std::string& file, const std::string& where,
    double found, double expected)
  {
    this->number(what, unit, file, where, found, expected, 0);
  }
  /// Something that is right or wrong.
  void holds(const std::string& what, const std::string& file, const std::string& where, bool right,
    const std::string& found, const std::string& expected);

private:
  Meter& meter(const std::string& what, const std::string& unit, double tolerance, const std::string& file);
  struct Line
  {
    std::string unit;
    Meter meter{ 0 };
    double tolerance = 0; ///< the largest
    std::set<std::string> files;
  };
  const ExportedFrom& Source;
  Results& TheResults;
  std::map<std::string, Line> Lines;
};

/// A format's reader: reads its documents from the specification and tells the judge.
using ReadExport = void (*)(ExportJudge& judge);
/// Null for a format all of whose contents are pixels.
ReadExport exportReader(const std::string& exporter);

} // namespace dgtk

#endif
