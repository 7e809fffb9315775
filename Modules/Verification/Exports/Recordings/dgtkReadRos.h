// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkReadRos_h
#define dgtkReadRos_h

// Private to Verification: messages of ROS 1, whatever file they come in.

#include "dgtkExportJudge.h"

#include <cstring>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace dgtk
{

/// Little-endian numbers and texts of some bytes, one after another. What ends too early is an InputError of the file.
class RosBytes
{
public:
  RosBytes(const std::string& file, const char* data, std::size_t size)
    : File(file)
    , Data(data)
    , Size(size)
  {
  }
  RosBytes(const std::string& file, const std::string& bytes)
    : RosBytes(file, bytes.data(), bytes.size())
  {
  }
  template <typename T>
  T take()
  {
    T value;
    std::memcpy(&value, this->skip(sizeof(T)), sizeof(T));
    return value;
  }
  std::uint64_t time(); ///< nanoseconds of two numbers of 4 bytes
  RosBytes part();      ///< of a length in 4 bytes
  std::string text() { return this->part().rest(); }
  std::string rest() { return std::string(this->Data + this->At, this->Size - this->At); }
  const char* skip(std::size_t bytes);
  bool more() const { return this->At < this->Size; }
  std::size_t at() const { return this->At; }
  std::size_t size() const { return this->Size; }

private:
  std::string File;
  const char* Data;
  std::size_t Size;
  std::size_t At = 0;
};

/// A file that is read piece by piece.
class RosFile
{
public:
  explicit RosFile(const std::string& path);
  std::uint64_t size() const { return this->Size; }
  std::string read(std::uint64_t position, std::uint64_t bytes);
  const std::string& path() const { return this->Path; }

private:
  std::string Path;
  std::ifstream Stream;
  std::uint64_t Size = 0;
};

/// Compares the messages of a recording with the dataset.
class RosReferee
{
public:
  RosReferee(ExportJudge& judge, const std::string& file);
  void topic(const std::string& topic, const std::string& type, const std::string& md5, const std::string& definition);
  void message(const std::string& topic, const std::string& type, std::uint64_t time, RosBytes bytes);
  /// Whether every picture had all its messages.
  void finish();
  /// Something about the file itself.
  void holds(const std::string& where, bool right, const std::string& found, const std::string& expected);

private:
  const ExportedName* nameOf(const std::string& camera, std::uint64_t time) const;
  void header(RosBytes& bytes, const std::string& topic, std::uint64_t time, const std::string& frame);
  void picture(RosBytes& bytes, const ExportedName& name);
  void depth(RosBytes& bytes, const ExportedName& name);
  void info(RosBytes& bytes, const ExportedName& name);
  void transforms(RosBytes& bytes, std::uint64_t time);
  void object(const std::string& child, int frame, const Eigen::Matrix3d& R, const Eigen::Vector3d& t);
  void baseline(const ExportedName& name, double metres);
  void judgePartners();
  ExportJudge& Judge;
  std::string File;
  std::string Color;
  std::string Depth;
  double Metres;
  std::map<std::string, const ExportedName*> Names; ///< of this file
  std::map<std::pair<int, std::uint32_t>, PoseRecord> Poses;
  std::set<std::pair<std::string, std::uint64_t>> Seen;
  std::map<int, std::set<std::uint32_t>> Objects;
  std::map<std::string, std::string> Partners; ///< the left camera of a right one
};

} // namespace dgtk

#endif
