// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLayerFile.h"
#include "dgtkRosRecording.h"

#include <set>

// Bags of ROS 1, version 2.0 of their format: records of a header of fields and of data.

namespace dgtk
{

namespace
{
constexpr std::size_t bagHeaderBytes = 4096; // of the record, with its padding

template <typename T>
std::string field(const std::string& name, T value)
{
  std::string text = name + '=';
  putLittle(text, value);
  std::string all;
  ros::putText(all, text);
  return all;
}

std::string textField(const std::string& name, const std::string& value)
{
  std::string all;
  ros::putText(all, name + '=' + value);
  return all;
}

std::string timeField(const std::string& name, std::uint64_t nanoseconds)
{
  std::string text = name + '=';
  ros::putTime(text, nanoseconds);
  std::string all;
  ros::putText(all, text);
  return all;
}

enum class BagOp : std::uint8_t
{
  Message = 2,
  BagHeader = 3,
  Index = 4,
  Chunk = 5,
  ChunkInfo = 6,
  Connection = 7
};

/// A record up to its data.
std::string bagHead(BagOp op, const std::string& fields, std::uint64_t dataBytes)
{
  std::string all;
  ros::putText(all, field("op", static_cast<std::uint8_t>(op)) + fields);
  putLittle(all, static_cast<std::uint32_t>(dataBytes));
  return all;
}

std::string record(BagOp op, const std::string& fields, const std::string& data)
{
  return bagHead(op, fields, data.size()) + data;
}

std::uint32_t connectionOf(std::size_t topic) { return static_cast<std::uint32_t>(topic); }

std::string connectionRecord(const ros::Recording& recording, std::size_t topic)
{
  const ros::Topic& one = recording.topics()[topic];
  const std::string data = textField("topic", one.name) + textField("type", one.type->name) +
                           textField("md5sum", one.type->md5) + textField("message_definition", one.type->definition);
  return record(BagOp::Connection, field("conn", connectionOf(topic)) + textField("topic", one.name), data);
}

/// The bag and its length.
class BagText
{
public:
  explicit BagText(ExportFile& file)
    : File(file)
  {
  }
  void put(const std::string& text)
  {
    this->File.write(text);
    this->Position += text.size();
  }
  std::uint64_t position() const { return this->Position; }

private:
  ExportFile& File;
  std::uint64_t Position = 0;
};

struct ChunkPlace
{
  std::uint64_t position = 0;
  std::uint64_t time = 0;
  std::vector<std::uint32_t> connections; ///< of its messages, one of each
};

/// A chunk of the messages of a shot, each behind the record of its connection where that is the first one.
ChunkPlace putChunk(
  BagText& bag, const ros::Recording& recording, std::size_t shot, std::set<std::size_t>& known, ExportSink& sink)
{
  const std::uint64_t time = recording.nanoseconds(*recording.shots()[shot]);
  const std::vector<ros::Message> messages = recording.messages(shot, sink);
  ChunkPlace place{ bag.position(), time, {} };
  std::vector<std::string> heads;
  std::vector<std::uint32_t> offsets;
  std::uint64_t size = 0;
  for (const ros::Message& message : messages)
  {
    std::string before = known.insert(message.topic).second ? connectionRecord(recording, message.topic) : "";
    offsets.push_back(static_cast<std::uint32_t>(size + before.size()));
    before +=
      bagHead(BagOp::Message, field("conn", connectionOf(message.topic)) + timeField("time", time), message.bytes());
    size += before.size() + message.bytes();
    heads.push_back(before);
    place.connections.push_back(connectionOf(message.topic));
  }
  bag.put(
    bagHead(BagOp::Chunk, textField("compression", "none") + field("size", static_cast<std::uint32_t>(size)), size));
  for (std::size_t i = 0; i < messages.size(); ++i)
  {
    bag.put(heads[i] + messages[i].head);
    bag.put(messages[i].body);
  }
  for (std::size_t i = 0; i < messages.size(); ++i)
  {
    std::string entry;
    ros::putTime(entry, time);
    putLittle(entry, offsets[i]);
    bag.put(record(BagOp::Index,
      field("ver", std::uint32_t(1)) + field("conn", connectionOf(messages[i].topic)) +
        field("count", std::uint32_t(1)),
      entry));
  }
  return place;
}

/// The first record, which says where the index begins.
std::string bagHeader(const ros::Recording& recording, std::uint64_t index)
{
  const std::string fields = field("index_pos", index) +
                             field("conn_count", static_cast<std::uint32_t>(recording.topics().size())) +
                             field("chunk_count", static_cast<std::uint32_t>(recording.shots().size()));
  const std::size_t used = bagHead(BagOp::BagHeader, fields, 0).size();
  return record(BagOp::BagHeader, fields, std::string(bagHeaderBytes - used, ' '));
}

/// Chunks and index behind the first record; returns where the index begins.
std::uint64_t putBag(BagText& bag, const ros::Recording& recording, ExportSink& sink)
{
  const std::size_t shots = recording.shots().size();
  std::set<std::size_t> known;
  std::vector<ChunkPlace> places;
  for (std::size_t shot = 0; shot < shots; ++shot)
  {
    places.push_back(putChunk(bag, recording, shot, known, sink));
  }
  const std::uint64_t position = bag.position();
  for (std::size_t topic = 0; topic < recording.topics().size(); ++topic)
  {
    bag.put(connectionRecord(recording, topic));
  }
  for (const ChunkPlace& place : places)
  {
    std::string counts;
    for (const std::uint32_t connection : place.connections)
    {
      putLittle(counts, connection);
      putLittle(counts, std::uint32_t(1));
    }
    bag.put(record(BagOp::ChunkInfo,
      field("ver", std::uint32_t(1)) + field("chunk_pos", place.position) + timeField("start_time", place.time) +
        timeField("end_time", place.time) + field("count", static_cast<std::uint32_t>(place.connections.size())),
      counts));
  }
  return position;
}

/// The first record says where the last ones are, and is written again when that is known.
void writeBag(ExportSink& sink, const ros::Recording& recording, const std::string& name)
{
  const std::string magic = "#ROSBAG V2.0\n";
  const std::unique_ptr<ExportFile> file = sink.open(name);
  BagText bag(*file);
  bag.put(magic + bagHeader(recording, 0));
  const std::uint64_t index = putBag(bag, recording, sink);
  file->rewrite(magic.size(), bagHeader(recording, index));
  file->finish();
}

class RosbagExporter : public Exporter
{
public:
  ExportNeeds needs(const OptionValues& options) const override { return ros::recordingNeeds(options); }
  void check(const DatasetView& dataset, const OptionValues& options) const override
  {
    ros::requireRecordable(dataset, options, "rosbag");
  }
  ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const override
  {
    return ros::planRecordings(dataset, options, "bag", &writeBag);
  }
};
} // namespace

std::unique_ptr<Exporter> makeRosbagExporter() { return std::make_unique<RosbagExporter>(); }

} // namespace dgtk
