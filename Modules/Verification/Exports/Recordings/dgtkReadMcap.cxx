// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkReadRos.h"
#include "dgtkReadTexts.h"

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>

// mcap.dev/spec.

namespace dgtk
{

namespace
{
/// CRC-32 of IEEE 802.3.
std::uint32_t sumOf(std::uint32_t before, const std::string& text)
{
  static const std::array<std::uint32_t, 256> table = []
  {
    std::array<std::uint32_t, 256> all{};
    for (std::uint32_t i = 0; i < 256; ++i)
    {
      std::uint32_t value = i;
      for (int bit = 0; bit < 8; ++bit)
      {
        value = (value & 1U) != 0 ? 0xEDB88320U ^ (value >> 1U) : value >> 1U;
      }
      all[i] = value;
    }
    return all;
  }();
  std::uint32_t sum = ~before;
  for (const char c : text)
  {
    sum = table[(sum ^ static_cast<unsigned char>(c)) & 0xFFU] ^ (sum >> 8U);
  }
  return ~sum;
}

struct Schema
{
  std::string name;
  std::string definition;
};
struct McapChannel
{
  std::string topic;
  std::string type;
};
/// A message's channel, time and place in its chunk.
using McapPlace = std::tuple<std::uint16_t, std::uint64_t, std::uint64_t>;

struct Chunk
{
  std::uint64_t start = 0;
  std::uint64_t end = 0;
  std::uint64_t position = 0;
  std::uint64_t length = 0;
  std::uint64_t bytes = 0;
  std::vector<McapPlace> messages;
  std::vector<McapPlace> indexed;
  std::map<std::uint16_t, std::uint64_t> indices;
  std::uint64_t indexBytes = 0;
};

class Mcap
{
public:
  Mcap(ExportJudge& judge, const std::string& file)
    : File(judge.source().path(file))
    , Path(judge.source().path(file))
    , Referee(judge, file)
  {
  }

  void judge()
  {
    const std::string magic = { '\x89', 'M', 'C', 'A', 'P', '0', '\r', '\n' };
    const std::uint64_t size = this->File.size();
    this->holds("magic", this->File.read(0, 8) == magic && this->File.read(size - 8, 8) == magic);
    this->Sum = sumOf(0, magic);
    std::uint64_t at = 8;
    while (at + 8 < size)
    {
      const auto op = static_cast<unsigned char>(this->File.read(at, 1)[0]);
      const std::uint64_t bytes = RosBytes(this->Path, this->File.read(at + 1, 8)).take<std::uint64_t>();
      const std::string content = this->File.read(at + 9, bytes);
      const std::string whole = this->File.read(at, 9) + content;
      this->holds("order", (at == 8) == (op == 1) && this->Footers == 0);
      this->take(op, RosBytes(this->Path, content), at, whole);
      at += whole.size();
      this->Groups[op].second = this->Groups[op].first == 0 ? 0 : at;
    }
    this->holds("end", this->Footers == 1 && this->DataEnds == 1 && at + 8 == size);
    this->count("chunks", this->ChunkIndices, this->Chunks.size());
    for (const Chunk& chunk : this->Chunks)
    {
      this->holds("message index", chunk.messages == chunk.indexed);
    }
    this->Referee.finish();
  }

private:
  void holds(const std::string& where, bool right) { this->Referee.holds(where, right, "another", "as MCAP has it"); }
  void count(const std::string& what, std::uint64_t found, std::uint64_t expected)
  {
    this->Referee.holds(what, found == expected, std::to_string(found), std::to_string(expected));
  }

  void take(int op, RosBytes bytes, std::uint64_t at, const std::string& whole)
  {
    if (op == 15)
    {
      this->count("sum of the data", bytes.take<std::uint32_t>(), this->Sum);
      ++this->DataEnds;
      this->SummaryStart = at + whole.size();
      this->Sum = 0;
      return;
    }
    if (op == 2)
    {
      this->takeFooter(bytes, whole);
      return;
    }
    if (this->DataEnds > 0 && this->Groups[op].first == 0)
    {
      this->Groups[op].first = at;
    }
    this->OffsetStart = op == 14 && this->OffsetStart == 0 ? at : this->OffsetStart;
    this->Sum = sumOf(this->Sum, whole);
    switch (op)
    {
      case 1:
        this->holds("profile", bytes.text() == "ros1");
        break;
      case 3:
        this->takeSchema(bytes);
        break;
      case 4:
        this->takeChannel(bytes);
        break;
      case 6:
        this->takeChunk(bytes, at, whole.size());
        break;
      case 7:
        this->takeMessageIndex(bytes, at, whole.size());
        break;
      case 8:
        this->takeChunkIndex(bytes);
        break;
      case 11:
        this->takeStatistics(bytes);
        break;
      case 14:
        this->takeOffset(bytes);
        break;
      default:
        throw InputError(this->Path, "has a record of opcode " + std::to_string(op) + " where none is");
    }
  }

  void takeFooter(RosBytes bytes, const std::string& whole)
  {
    ++this->Footers;
    this->count("summary", bytes.take<std::uint64_t>(), this->SummaryStart);
    this->count("summary offsets", bytes.take<std::uint64_t>(), this->OffsetStart);
    const std::uint32_t sum = sumOf(this->Sum, whole.substr(0, whole.size() - 4));
    this->count("sum of the summary", bytes.take<std::uint32_t>(), sum);
  }

  void takeSchema(RosBytes bytes)
  {
    const auto id = bytes.take<std::uint16_t>();
    Schema schema;
    schema.name = bytes.text();
    this->holds("schema", bytes.text() == "ros1msg" && id > 0);
    schema.definition = bytes.text();
    const auto known = this->Schemas.emplace(id, schema).first;
    this->holds("schema", known->second.name == schema.name && known->second.definition == schema.definition);
  }

  void takeChannel(RosBytes bytes)
  {
    const auto id = bytes.take<std::uint16_t>();
    const auto schema = this->Schemas.find(bytes.take<std::uint16_t>());
    const std::string topic = bytes.text();
    this->holds("channel", bytes.text() == "ros1" && schema != this->Schemas.end());
    if (schema == this->Schemas.end())
    {
      return;
    }
    std::map<std::string, std::string> metadata;
    RosBytes pairs = bytes.part();
    while (pairs.more())
    {
      const std::string key = pairs.text();
      metadata[key] = pairs.text();
    }
    this->holds("channel", metadata["topic"] == topic);
    this->Referee.topic(topic, schema->second.name, metadata["md5sum"], schema->second.definition);
    const auto known = this->Channels.emplace(id, McapChannel{ topic, schema->second.name }).first;
    this->holds("channel", known->second.topic == topic && known->second.type == schema->second.name);
  }

  void takeChunk(RosBytes bytes, std::uint64_t at, std::uint64_t length)
  {
    Chunk chunk;
    chunk.position = at;
    chunk.length = length;
    chunk.start = bytes.take<std::uint64_t>();
    chunk.end = bytes.take<std::uint64_t>();
    chunk.bytes = bytes.take<std::uint64_t>();
    const auto sum = bytes.take<std::uint32_t>();
    this->holds("chunk", bytes.text().empty());
    this->count("chunk", bytes.take<std::uint64_t>(), chunk.bytes);
    const std::string records = bytes.rest();
    this->count("chunk", records.size(), chunk.bytes);
    this->count("sum of a chunk", sum, sumOf(0, records));
    std::uint64_t first = std::numeric_limits<std::uint64_t>::max();
    std::uint64_t last = 0;
    RosBytes inner(this->Path, records);
    while (inner.more())
    {
      const std::uint64_t place = inner.at();
      const auto op = inner.take<std::uint8_t>();
      const auto size = inner.take<std::uint64_t>();
      RosBytes message(this->Path, inner.skip(size), size);
      const auto id = message.take<std::uint16_t>();
      const auto channel = this->Channels.find(id);
      if (op != 5 || channel == this->Channels.end())
      {
        throw InputError(this->Path, "has a chunk with what is no message of a channel");
      }
      message.take<std::uint32_t>();
      const auto time = message.take<std::uint64_t>();
      this->count("publish time", message.take<std::uint64_t>(), time);
      first = std::min(first, time);
      last = std::max(last, time);
      const std::size_t left = message.size() - message.at();
      this->Referee.message(
        channel->second.topic, channel->second.type, time, { this->Path, message.skip(left), left });
      chunk.messages.emplace_back(id, time, place);
      ++this->Messages[id];
    }
    this->count("first time of a chunk", chunk.start, first);
    this->count("last time of a chunk", chunk.end, last);
    this->Chunks.push_back(chunk);
  }

  void takeMessageIndex(RosBytes bytes, std::uint64_t at, std::uint64_t length)
  {
    const auto id = bytes.take<std::uint16_t>();
    RosBytes entries = bytes.part();
    Chunk& chunk = this->Chunks.at(this->Chunks.size() - 1);
    chunk.indices[id] = at;
    chunk.indexBytes += length;
    while (entries.more())
    {
      const auto time = entries.take<std::uint64_t>();
      chunk.indexed.emplace_back(id, time, entries.take<std::uint64_t>());
    }
  }

  void takeChunkIndex(RosBytes bytes)
  {
    const std::size_t number = this->ChunkIndices++;
    if (number >= this->Chunks.size())
    {
      return;
    }
    const Chunk& chunk = this->Chunks[number];
    for (const std::uint64_t expected : { chunk.start, chunk.end, chunk.position, chunk.length })
    {
      this->count("chunk index", bytes.take<std::uint64_t>(), expected);
    }
    std::map<std::uint16_t, std::uint64_t> indices;
    RosBytes entries = bytes.part();
    while (entries.more())
    {
      const auto id = entries.take<std::uint16_t>();
      indices[id] = entries.take<std::uint64_t>();
    }
    this->holds("chunk index", indices == chunk.indices);
    this->count("chunk index", bytes.take<std::uint64_t>(), chunk.indexBytes);
    this->holds("chunk index", bytes.text().empty());
    this->count("chunk index", bytes.take<std::uint64_t>(), chunk.bytes);
    this->count("chunk index", bytes.take<std::uint64_t>(), chunk.bytes);
  }

  void takeStatistics(RosBytes bytes)
  {
    std::uint64_t messages = 0;
    for (const auto& [id, count] : this->Messages)
    {
      messages += count;
    }
    this->count("messages", bytes.take<std::uint64_t>(), messages);
    this->count("schemas", bytes.take<std::uint16_t>(), this->Schemas.size());
    this->count("channels", bytes.take<std::uint32_t>(), this->Channels.size());
    this->count("attachments", bytes.take<std::uint32_t>(), 0);
    this->count("metadata", bytes.take<std::uint32_t>(), 0);
    this->count("chunks", bytes.take<std::uint32_t>(), this->Chunks.size());
    this->count("first time", bytes.take<std::uint64_t>(), this->Chunks.empty() ? 0 : this->Chunks.front().start);
    this->count("last time", bytes.take<std::uint64_t>(), this->Chunks.empty() ? 0 : this->Chunks.back().end);
    std::map<std::uint16_t, std::uint64_t> counts;
    RosBytes entries = bytes.part();
    while (entries.more())
    {
      const auto id = entries.take<std::uint16_t>();
      counts[id] = entries.take<std::uint64_t>();
    }
    this->holds("messages of channels", counts == this->Messages);
  }

  void takeOffset(RosBytes bytes)
  {
    const auto group = this->Groups[bytes.take<std::uint8_t>()];
    this->count("summary offset", bytes.take<std::uint64_t>(), group.first);
    this->count("summary offset", bytes.take<std::uint64_t>(), group.second - group.first);
  }

  RosFile File;
  std::string Path;
  RosReferee Referee;
  std::uint32_t Sum = 0;
  int Footers = 0;
  int DataEnds = 0;
  std::uint64_t SummaryStart = 0;
  std::uint64_t OffsetStart = 0;
  std::size_t ChunkIndices = 0;
  std::map<int, std::pair<std::uint64_t, std::uint64_t>> Groups; ///< of the summary: begin and end
  std::map<std::uint16_t, Schema> Schemas;
  std::map<std::uint16_t, McapChannel> Channels;
  std::map<std::uint16_t, std::uint64_t> Messages;
  std::vector<Chunk> Chunks;
};
} // namespace

void readMcap(ExportJudge& judge)
{
  for (const ExportedFile* one : filesIn(judge.source(), "", "mcap"))
  {
    Mcap(judge, one->file.path).judge();
  }
}

} // namespace dgtk
