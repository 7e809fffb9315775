// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkDatasetPictures_h
#define dgtkDatasetPictures_h

#include "dgtkViewerModule.h"

#include "dgtkDatasetDocuments.h"
#include "dgtkSceneDescription.h"

#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace dgtk
{

/// A kind of picture of a dataset: its layer, told apart from other pictures that the layer has.
struct PictureLayer
{
  /// As the user chooses it, one for all cameras and frames: "depth", "correspondence_right", "flow_forward class",
  /// "matting_vase alpha", "tiles 0,1", "ldi depth"; with the extension where a layer has several formats: "depth
  /// .dgd".
  std::string label;
  LayerSpec spec;     ///< as the manifest says, with the scene's units by their name and the meaning of the part
  std::string format; ///< of the manifest: "npy", "ldi"
  std::string part{}; ///< of a layered depth image, which is seen in three ways: "color", "depth", "count"
};

/// Files of a dataset that are no pictures.
enum class DatasetDocument
{
  Calibration,
  Boxes,
  Points ///< of no camera
};

/// Which picture of a dataset.
struct PictureKey
{
  std::string camera;
  int frame = 0;
  std::string layer; ///< label
  bool operator<(const PictureKey& o) const
  {
    return std::tie(this->camera, this->frame, this->layer) < std::tie(o.camera, o.frame, o.layer);
  }
  bool operator==(const PictureKey& o) const { return !(*this < o) && !(o < *this); }
};

/// What a finished dataset on disk has to show. Its documents are read here, no picture is. Immutable.
class DGTKVIEWER_EXPORT DatasetPictures
{
public:
  /// `folder`: the dataset, or its manifest.json. Throws InputError, one line that says what to do, for a folder
  /// without a manifest that can be read or without a picture.
  explicit DatasetPictures(const std::string& folder);

  const std::string& folder() const { return this->Folder; }
  /// Whether another dataset stands there by now, or a run that replaces it: nothing of it goes with what was read.
  bool isReplaced() const;
  const Manifest& manifest() const { return this->TheManifest; }
  /// Documents that cannot be used, a line each; pictures can be seen without them.
  const std::vector<std::string>& warnings() const { return this->Warnings; }

  const std::vector<std::string>& cameras() const
  {
    return this->Cameras;
  }                                                               ///< that have pictures, in alphabetical order
  const std::vector<int>& frames() const { return this->Frames; } ///< ascending
  const std::vector<PictureLayer>& layers() const { return this->Layers; } ///< in the manifest's order
  std::vector<std::string> layersOf(const std::string& camera) const;      ///< labels
  const PictureLayer* layer(const std::string& label) const;               ///< null for none
  /// The label of the first layer with a meaning that has this picture; "" for none.
  std::string firstLayer(Meaning meaning, const std::string& camera, int frame) const;
  /// Path of a picture; "" where the dataset has none, such as a flow at the last frame.
  std::string file(const PictureKey& key) const;

  /// Its path; "" for none. Points are of camera "".
  std::string document(DatasetDocument kind, const std::string& camera, int frame) const;
  bool hasDocuments(DatasetDocument kind) const;

  /// Null where cameras.json has no such entry.
  const CameraRecord* camera(const std::string& name, int frame) const;
  const std::vector<CameraRecord>& records() const { return this->Records; }
  const ObjectRecord* object(std::uint32_t id) const; ///< null for none
  std::string className(std::uint32_t id) const;      ///< "" for none
  /// The object whose name has this Cryptomatte hash; 0 for none.
  std::uint32_t objectOfHash(float hash) const;
  const std::vector<ObjectRecord>& objects() const { return this->Objects; }
  UpAxis upAxis() const { return this->Up; } ///< of scene.json; y where it cannot be read
  /// A camera as scene.json has it; null where that cannot be read, or has none of the name.
  const CameraDescription* sceneCamera(const std::string& name) const;

private:
  void readDocuments();
  void index();
  void addDocument(const DatasetFile& file);
  void add(const DatasetFile& file, const std::string& label, const std::string& part,
    std::map<std::string, PictureLayer>& found);
  LayerSpec specOf(const DatasetFile& file) const;
  void sortLayers(std::map<std::string, PictureLayer>& found);

  std::string Folder;
  std::string ManifestHash; ///< before it was read
  Manifest TheManifest;
  std::vector<std::string> Warnings;
  std::vector<std::string> Cameras;
  std::vector<int> Frames;
  std::vector<PictureLayer> Layers;
  std::map<PictureKey, std::string> Files;                                        ///< paths relative to the folder
  std::map<std::tuple<DatasetDocument, std::string, int>, std::string> Documents; ///< by camera and frame
  std::map<std::string, std::set<std::string>> LayersOfCamera;
  std::vector<CameraRecord> Records;
  std::vector<ObjectRecord> Objects;
  std::map<float, std::uint32_t> Hashes; ///< ids
  UpAxis Up = UpAxis::Y;
  std::vector<CameraDescription> SceneCameras;
};

} // namespace dgtk

#endif
