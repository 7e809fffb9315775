// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPickleFile_h
#define dgtkPickleFile_h

#include "dgtkExporter.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// A Python pickle (protocol 4) of dictionaries and NumPy arrays, written piece by piece: benchmarks of video hand
/// their data out so. Nothing but the contents decides its bytes.
class PickleFile
{
public:
  PickleFile(ExportSink& sink, const std::string& name);
  /// An entry of the dictionary that is open, a dictionary itself, until end().
  void beginDictionary(const std::string& key);
  void endDictionary();
  /// An entry that is an array in C order: what is added behind it has to have as many bytes. `type` as NumPy's dtype()
  /// takes it: "u1", "b1", "f4".
  void beginArray(const std::string& key, const std::string& type, const std::vector<std::uint64_t>& shape);
  void add(const void* data, std::size_t bytes);
  void endArray();
  /// Closes the outer dictionary.
  void finish();

private:
  void text(const std::string& utf8);
  std::unique_ptr<ExportFile> File;
};

} // namespace dgtk

#endif
