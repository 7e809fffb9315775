// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkLayerFile.h"
#include "dgtkRosRecording.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include <zlib.h>

// MCAP (mcap.dev/spec), profile "ros1": chunks that are not compressed, with sums, indices and statistics.

namespace dgtk
{

namespace
{
const std::string mcapMagic("\x89MCAP0\r\n", 8);

enum class Op : std::uint8_t
{
  Header = 1,
  Footer,
  Schema,
  Channel,
  Message,
  Chunk,
  MessageIndex,
  ChunkIndex,
  Statistics = 0x0B,
  SummaryOffset = 0x0E,
  DataEnd
};

std::uint32_t sumOf(std::uint32_t before, const std::string& text)
{
  return static_cast<std::uint32_t>(crc32_z(before, reinterpret_cast<const unsigned char*>(text.data()), text.size()));
}

/// A record up to a part of its content that follows.
std::string head(Op op, const std::string& content, std::uint64_t following)
{
  std::string all(1, static_cast<char>(op));
  putLittle(all, std::uint64_t(content.size() + following));
  return all + content;
}
std::string record(Op op, const std::string& content) { return head(op, content, 0); }

/// Numbers and texts of a record.
class Content
{
public:
  template <typename T>
  Content& number(T value)
  {
    putLittle(this->Text, value);
    return *this;
  }
  Content& text(const std::string& value)
  {
    ros::putText(this->Text, value);
    return *this;
  }
  const std::string& get() const { return this->Text; }

private:
  std::string Text;
};

std::uint16_t channelOf(std::size_t topic) { return static_cast<std::uint16_t>(topic + 1); }

/// The file, its length, and the sum of what has come since the last reset.
class McapText
{
public:
  explicit McapText(ExportFile& file)
    : File(file)
  {
  }
  void put(const std::string& text)
  {
    this->File.write(text);
    this->Position += text.size();
    this->Sum = sumOf(this->Sum, text);
  }
  void reset() { this->Sum = 0; }
  std::uint64_t position() const { return this->Position; }
  std::uint32_t sum() const { return this->Sum; }

private:
  ExportFile& File;
  std::uint64_t Position = 0;
  std::uint32_t Sum = 0;
};

struct McapChunk
{
  std::uint64_t time = 0;
  std::uint64_t position = 0;
  std::uint64_t length = 0;                                     ///< of the record
  std::uint64_t bytes = 0;                                      ///< of the messages
  std::vector<std::pair<std::uint16_t, std::uint64_t>> indices; ///< by channel
  std::uint64_t indexBytes = 0;
};

/// Schemas have numbers from 1, types in the order of their first topics.
class McapWriter
{
public:
  McapWriter(ExportSink& sink, const ros::Recording& recording, ExportFile& file)
    : Sink(sink)
    , Recording(recording)
    , Text(file)
  {
    for (const ros::Topic& topic : recording.topics())
    {
      this->Schemas.emplace(topic.type, static_cast<std::uint16_t>(this->Schemas.size() + 1));
    }
  }

  void write()
  {
    this->Text.put(mcapMagic);
    this->Text.put(record(Op::Header, Content().text("ros1").text("DGTk").get()));
    this->Text.put(this->schemas());
    this->Text.put(this->channels());
    std::vector<McapChunk> chunks;
    for (std::size_t shot = 0; shot < this->Recording.shots().size(); ++shot)
    {
      chunks.push_back(this->putChunk(shot));
    }
    this->Text.put(record(Op::DataEnd, Content().number(this->Text.sum()).get()));
    this->putSummary(chunks);
    this->Text.put(mcapMagic);
  }

private:
  std::string schemas() const
  {
    std::map<std::uint16_t, const ros::Type*> sorted;
    for (const auto& [type, number] : this->Schemas)
    {
      sorted[number] = type;
    }
    std::string all;
    for (const auto& [number, type] : sorted)
    {
      all += record(Op::Schema, Content().number(number).text(type->name).text("ros1msg").text(type->definition).get());
    }
    return all;
  }

  std::string channels() const
  {
    std::string all;
    for (std::size_t i = 0; i < this->Recording.topics().size(); ++i)
    {
      const ros::Topic& topic = this->Recording.topics()[i];
      const std::string metadata = Content().text("md5sum").text(topic.type->md5).text("topic").text(topic.name).get();
      all += record(Op::Channel, Content()
                                   .number(channelOf(i))
                                   .number(this->Schemas.at(topic.type))
                                   .text(topic.name)
                                   .text("ros1")
                                   .text(metadata)
                                   .get());
    }
    return all;
  }

  McapChunk putChunk(std::size_t shot)
  {
    const DatasetShot& one = *this->Recording.shots()[shot];
    const std::vector<ros::Message> messages = this->Recording.messages(shot, this->Sink);
    McapChunk place;
    place.time = this->Recording.nanoseconds(one);
    place.position = this->Text.position();
    std::uint32_t sum = 0;
    std::vector<std::string> heads;
    std::vector<std::uint64_t> offsets;
    for (const ros::Message& message : messages)
    {
      const std::string content = Content()
                                    .number(channelOf(message.topic))
                                    .number(static_cast<std::uint32_t>(one.frame()))
                                    .number(place.time)
                                    .number(place.time)
                                    .get();
      heads.push_back(head(Op::Message, content, message.bytes()) + message.head);
      sum = sumOf(sumOf(sum, heads.back()), message.body);
      offsets.push_back(place.bytes);
      place.bytes += heads.back().size() + message.body.size();
    }
    const std::string content = Content()
                                  .number(place.time)
                                  .number(place.time)
                                  .number(place.bytes)
                                  .number(sum)
                                  .text("")
                                  .number(place.bytes)
                                  .get();
    this->Text.put(head(Op::Chunk, content, place.bytes));
    for (std::size_t i = 0; i < messages.size(); ++i)
    {
      this->Text.put(heads[i]);
      this->Text.put(messages[i].body);
    }
    place.length = this->Text.position() - place.position;
    for (std::size_t i = 0; i < messages.size(); ++i)
    {
      place.indices.emplace_back(channelOf(messages[i].topic), this->Text.position());
      const std::string entry = Content().number(place.time).number(offsets[i]).get();
      this->Text.put(record(Op::MessageIndex, Content().number(channelOf(messages[i].topic)).text(entry).get()));
      ++this->Counts[channelOf(messages[i].topic)];
    }
    std::sort(place.indices.begin(), place.indices.end());
    place.indices.shrink_to_fit();
    place.indexBytes = this->Text.position() - place.position - place.length;
    return place;
  }

  static std::string chunkIndex(const McapChunk& place)
  {
    Content indices;
    for (const auto& [channel, position] : place.indices)
    {
      indices.number(channel).number(position);
    }
    return record(Op::ChunkIndex, Content()
                                    .number(place.time)
                                    .number(place.time)
                                    .number(place.position)
                                    .number(place.length)
                                    .text(indices.get())
                                    .number(place.indexBytes)
                                    .text("")
                                    .number(place.bytes)
                                    .number(place.bytes)
                                    .get());
  }

  std::string statistics(const std::vector<McapChunk>& chunks) const
  {
    std::uint64_t messages = 0;
    Content counts;
    for (const auto& [channel, count] : this->Counts)
    {
      messages += count;
      counts.number(channel).number(count);
    }
    return record(Op::Statistics, Content()
                                    .number(messages)
                                    .number(static_cast<std::uint16_t>(this->Schemas.size()))
                                    .number(static_cast<std::uint32_t>(this->Recording.topics().size()))
                                    .number(std::uint32_t(0))
                                    .number(std::uint32_t(0))
                                    .number(static_cast<std::uint32_t>(chunks.size()))
                                    .number(chunks.front().time)
                                    .number(chunks.back().time)
                                    .text(counts.get())
                                    .get());
  }

  void putSummary(const std::vector<McapChunk>& chunks)
  {
    this->Text.reset();
    const std::uint64_t start = this->Text.position();
    std::string offsets;
    const auto group = [&](Op op, const auto& put)
    {
      const std::uint64_t begin = this->Text.position();
      put();
      offsets += record(Op::SummaryOffset,
        Content().number(static_cast<std::uint8_t>(op)).number(begin).number(this->Text.position() - begin).get());
    };
    group(Op::Schema, [&] { this->Text.put(this->schemas()); });
    group(Op::Channel, [&] { this->Text.put(this->channels()); });
    group(Op::Statistics, [&] { this->Text.put(this->statistics(chunks)); });
    group(Op::ChunkIndex,
      [&]
      {
        for (const McapChunk& place : chunks)
        {
          this->Text.put(chunkIndex(place));
        }
      });
    const std::uint64_t offsetStart = this->Text.position();
    this->Text.put(offsets);
    const std::string content = Content().number(start).number(offsetStart).get();
    this->Text.put(head(Op::Footer, content, sizeof(std::uint32_t))); // the sum has all before it
    this->Text.put(Content().number(this->Text.sum()).get());
  }

  ExportSink& Sink;
  const ros::Recording& Recording;
  McapText Text;
  std::map<const ros::Type*, std::uint16_t> Schemas;
  std::map<std::uint16_t, std::uint64_t> Counts;
};

void writeMcap(ExportSink& sink, const ros::Recording& recording, const std::string& name)
{
  const std::unique_ptr<ExportFile> file = sink.open(name);
  McapWriter(sink, recording, *file).write();
  file->finish();
}

/// Channels have numbers of 16 bits.
constexpr std::size_t mostCameras = 16000;

class McapExporter : public Exporter
{
public:
  ExportNeeds needs(const OptionValues& options) const override { return ros::recordingNeeds(options); }
  void check(const DatasetView& dataset, const OptionValues& options) const override
  {
    ros::requireRecordable(dataset, options, "mcap");
    if (dataset.cameras().size() > mostCameras)
    {
      throw UsageError("mcap: more than " + std::to_string(mostCameras) + " cameras: channels are counted by 16 bits");
    }
  }
  ExportPlan plan(const DatasetView& dataset, const OptionValues& options) const override
  {
    return ros::planRecordings(dataset, options, "mcap", &writeMcap);
  }
};
} // namespace

std::unique_ptr<Exporter> makeMcapExporter() { return std::make_unique<McapExporter>(); }

} // namespace dgtk
