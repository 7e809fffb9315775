// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkReadRos.h"
#include "dgtkReadTexts.h"

#include <tuple>

// wiki.ros.org/Bags/Format/2.0.

namespace dgtk
{

namespace
{
using Fields = std::map<std::string, std::string>;

Fields fieldsIn(const std::string& file, RosBytes bytes)
{
  Fields fields;
  while (bytes.more())
  {
    const std::string text = bytes.text();
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || !fields.emplace(text.substr(0, equals), text.substr(equals + 1)).second)
    {
      throw InputError(file, "has a header that is none");
    }
  }
  return fields;
}

struct Record
{
  Fields fields;
  std::string data;
  std::uint64_t end = 0; ///< where the next one begins
};

template <typename T>
T numberOf(const std::string& file, const Fields& fields, const std::string& key)
{
  const auto found = fields.find(key);
  if (found == fields.end() || found->second.size() != sizeof(T))
  {
    throw InputError(file, "has a record without the field " + key);
  }
  return RosBytes(file, found->second).take<T>();
}

std::uint64_t timeOf(const std::string& file, const Fields& fields, const std::string& key)
{
  numberOf<std::uint64_t>(file, fields, key);
  return RosBytes(file, fields.at(key)).time();
}

Record recordAt(RosFile& bag, std::uint64_t position)
{
  const auto length = [&](std::uint64_t at) { return RosBytes(bag.path(), bag.read(at, 4)).take<std::uint32_t>(); };
  const std::uint64_t header = length(position);
  const std::uint64_t data = length(position + 4 + header);
  Record record;
  record.fields = fieldsIn(bag.path(), RosBytes(bag.path(), bag.read(position + 4, header)));
  record.data = bag.read(position + 8 + header, data);
  record.end = position + 8 + header + data;
  return record;
}

/// A message's connection, time and place in its chunk.
using BagPlace = std::tuple<std::uint32_t, std::uint64_t, std::uint32_t>;

struct BagChunk
{
  std::uint64_t position = 0;
  std::vector<BagPlace> messages;
  std::vector<BagPlace> indexed;
};

class Bag
{
public:
  Bag(ExportJudge& judge, const std::string& file)
    : File(judge.source().path(file))
    , Path(judge.source().path(file))
    , Referee(judge, file)
  {
  }

  void judge()
  {
    this->Referee.holds("first line", this->File.read(0, 13) == "#ROSBAG V2.0\n", "another", "#ROSBAG V2.0");
    const Record head = recordAt(this->File, 13);
    this->Referee.holds("bag header", this->opOf(head) == 3 && head.end == 13 + 4096, "another", "one of 4096 bytes");
    std::uint64_t at = head.end;
    std::uint64_t index = 0;
    while (at < this->File.size())
    {
      const Record record = recordAt(this->File, at);
      const int op = this->opOf(record);
      index = op == 7 && index == 0 ? at : index;
      this->Referee.holds(
        "order", (op == 7 || op == 6) == (index > 0), "op " + std::to_string(op), "chunks, then the index");
      this->take(record, op, at);
      at = record.end;
    }
    this->count("index", numberOf<std::uint64_t>(this->Path, head.fields, "index_pos"), index);
    this->count("connections", numberOf<std::uint32_t>(this->Path, head.fields, "conn_count"), this->Listed.size());
    this->count("chunks", numberOf<std::uint32_t>(this->Path, head.fields, "chunk_count"), this->Chunks.size());
    this->count("chunks in the index", this->Infos, this->Chunks.size());
    this->Referee.holds("connections", this->Listed == this->Connections, "others", "those of the chunks");
    for (const BagChunk& chunk : this->Chunks)
    {
      this->Referee.holds("index", chunk.messages == chunk.indexed, "others", "the chunk's messages");
    }
    this->Referee.finish();
  }

private:
  int opOf(const Record& record) const { return numberOf<std::uint8_t>(this->Path, record.fields, "op"); }

  void count(const std::string& what, std::uint64_t found, std::uint64_t expected)
  {
    this->Referee.holds(what, found == expected, std::to_string(found), std::to_string(expected));
  }

  void take(const Record& record, int op, std::uint64_t position)
  {
    switch (op)
    {
      case 4:
        this->takeIndex(record);
        break;
      case 5:
        this->takeChunk(record, position);
        break;
      case 6:
        this->takeInfo(record);
        break;
      case 7:
        this->takeConnection(record.fields, record.data, this->Listed);
        break;
      default:
        throw InputError(this->Path, "has a record of op " + std::to_string(op) + " where none is");
    }
  }

  void takeConnection(const Fields& fields, const std::string& data, std::map<std::uint32_t, Fields>& to)
  {
    Fields all = fieldsIn(this->Path, RosBytes(this->Path, data));
    const auto id = numberOf<std::uint32_t>(this->Path, fields, "conn");
    this->Referee.holds("connection", fields.at("topic") == all["topic"], all["topic"], fields.at("topic"));
    this->Referee.topic(all["topic"], all["type"], all["md5sum"], all["message_definition"]);
    this->Referee.holds("connection", to.emplace(id, all).second, "a number twice", "each once");
  }

  void takeChunk(const Record& record, std::uint64_t position)
  {
    const auto size = numberOf<std::uint32_t>(this->Path, record.fields, "size");
    const bool plain = record.fields.at("compression") == "none" && size == record.data.size();
    this->Referee.holds("chunk", plain, "packed, or of another size", "as it is");
    BagChunk chunk{ position, {}, {} };
    RosBytes bytes(this->Path, record.data);
    while (bytes.more())
    {
      const auto at = static_cast<std::uint32_t>(bytes.at());
      const Fields fields = fieldsIn(this->Path, bytes.part());
      RosBytes data = bytes.part();
      if (numberOf<std::uint8_t>(this->Path, fields, "op") == 7)
      {
        this->takeConnection(fields, data.rest(), this->Connections);
        continue;
      }
      const auto id = numberOf<std::uint32_t>(this->Path, fields, "conn");
      const auto connection = this->Connections.find(id);
      if (connection == this->Connections.end())
      {
        throw InputError(this->Path, "has a message before its connection");
      }
      const std::uint64_t time = timeOf(this->Path, fields, "time");
      this->Referee.message(connection->second["topic"], connection->second["type"], time, data);
      chunk.messages.emplace_back(id, time, at);
    }
    this->Chunks.push_back(chunk);
  }

  void takeIndex(const Record& record)
  {
    RosBytes bytes(this->Path, record.data);
    const auto id = numberOf<std::uint32_t>(this->Path, record.fields, "conn");
    const auto entries = numberOf<std::uint32_t>(this->Path, record.fields, "count");
    this->count("index", bytes.size(), std::uint64_t(12) * entries);
    while (bytes.more() && !this->Chunks.empty())
    {
      const std::uint64_t time = bytes.time();
      this->Chunks.back().indexed.emplace_back(id, time, bytes.take<std::uint32_t>());
    }
  }

  void takeInfo(const Record& record)
  {
    const std::size_t number = this->Infos++;
    if (number >= this->Chunks.size())
    {
      return;
    }
    const BagChunk& chunk = this->Chunks[number];
    this->count("chunk", numberOf<std::uint64_t>(this->Path, record.fields, "chunk_pos"), chunk.position);
    std::map<std::uint32_t, std::uint32_t> counts;
    std::set<std::uint64_t> times;
    for (const auto& [id, time, at] : chunk.messages)
    {
      ++counts[id];
      times.insert(time);
    }
    if (times.empty())
    {
      throw InputError(this->Path, "has a chunk without messages");
    }
    this->count("chunk", timeOf(this->Path, record.fields, "start_time"), *times.begin());
    this->count("chunk", timeOf(this->Path, record.fields, "end_time"), *times.rbegin());
    this->count("chunk", numberOf<std::uint32_t>(this->Path, record.fields, "count"), counts.size());
    RosBytes bytes(this->Path, record.data);
    while (bytes.more())
    {
      const auto id = bytes.take<std::uint32_t>();
      this->count("chunk", bytes.take<std::uint32_t>(), counts[id]);
    }
  }

  RosFile File;
  std::string Path;
  RosReferee Referee;
  std::map<std::uint32_t, Fields> Connections; ///< in chunks
  std::map<std::uint32_t, Fields> Listed;      ///< in the index
  std::vector<BagChunk> Chunks;
  std::size_t Infos = 0;
};
} // namespace

void readRosbag(ExportJudge& judge)
{
  for (const ExportedFile* one : filesIn(judge.source(), "", "bag"))
  {
    Bag(judge, one->file.path).judge();
  }
}

} // namespace dgtk
