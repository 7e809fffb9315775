// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRosRecording_h
#define dgtkRosRecording_h

// Private to Export: what a robot with the dataset's cameras would have recorded, for bags and MCAP files.

#include "dgtkExport.h"
#include "dgtkRosMessages.h"

#include <map>
#include <string>
#include <vector>

namespace dgtk::ros
{

struct Topic
{
  std::string name;
  const Type* type;
};

/// A message: its bytes are `head`, then `body`.
struct Message
{
  std::size_t topic = 0; ///< index into Recording::topics()
  std::string head = {};
  std::string body = {};
  std::uint64_t bytes() const { return this->head.size() + this->body.size(); }
};

/// Names of cameras in topics and frames: letters, digits and '_'; each camera has its own.
std::map<std::string, std::string> namesOfCameras(const DatasetView& dataset);

/// What ROS cannot say is a UsageError that names it.
void requireRecordable(const DatasetView& dataset, const OptionValues& options, const std::string& format);
ExportNeeds recordingNeeds(const OptionValues& options);
/// A plan of one file a part, which `write` writes.
ExportPlan planRecordings(const DatasetView& dataset, const OptionValues& options, const std::string& extension,
  void (*write)(ExportSink& sink, const class Recording& recording, const std::string& file));

/// The messages of a part of a dataset in the order of their times.
class Recording
{
public:
  Recording(const DatasetView& dataset, const OptionValues& options, const DatasetSplit& split);

  const std::vector<Topic>& topics() const { return this->Topics; }
  /// By frame, then camera.
  const std::vector<const DatasetShot*>& shots() const { return this->Shots; }
  /// Times begin at one second: ROS takes 0 for none.
  std::uint64_t nanoseconds(const DatasetShot& shot) const;
  /// All messages of a shot, each of another topic; with the first one of a frame go the objects. The sink is told what
  /// coding did to the pixels.
  std::vector<Message> messages(std::size_t shot, ExportSink& sink) const;

private:
  CameraInfo infoOf(const DatasetShot& shot) const;
  Message picture(const DatasetShot& shot, const Stamp& stamp, const std::string& frame, ExportSink& sink) const;
  Message depth(const DatasetShot& shot, const Stamp& stamp, const std::string& frame, ExportSink& sink) const;
  std::vector<Transform> placesOf(std::size_t shot, const std::string& frame) const;
  const DatasetView& Dataset;
  OptionValues Options;
  std::map<std::string, std::string> Names;
  std::map<std::string, std::string> LeftOf; ///< of right cameras
  std::map<std::string, std::size_t> FirstTopic;
  std::vector<Topic> Topics;
  std::vector<const DatasetShot*> Shots;
};

} // namespace dgtk::ros

#endif
