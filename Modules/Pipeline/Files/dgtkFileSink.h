// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFileSink_h
#define dgtkFileSink_h

// Private to Pipeline.

#include "dgtkLayers.h"

#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// A file of the dataset that is complete.
struct FinishedFile
{
  FileRecord record; ///< its path is relative to the dataset's folder
  std::string layer;
  bool shared = false; ///< of no camera and frame; other jobs may have finished it, too
};

/// Files of a dataset: each output in its formats. A file is opened with its first
/// rows; it is there when finish() is done.
class FileSink final : public LayerSink
{
public:
  /// `folder`: the dataset.
  FileSink(std::string folder, const JobContext& context, std::vector<LayerOutput> outputs);
  ~FileSink() override;

  void rows(std::size_t output, const Rows& rows) override;
  void surfaces(std::size_t output, const LdiRows& rows) override;
  void ranks(std::size_t output, const std::vector<CoveredId>& ranks, std::uint32_t pixels) override;
  void document(std::size_t output, const std::string& text) override;
  void shared(const std::string& layer, const FileRecord& file) override;

  /// All files, after the pass has finished.
  std::vector<FinishedFile> finish();

private:
  struct Files;
  FilePlace place(const std::string& name) const { return { this->Folder, name }; }
  std::string Folder;
  LayerWriterContext Context;
  std::vector<std::string> ObjectNames;
  std::vector<std::unique_ptr<Files>> Outputs; // one an output
  std::vector<FinishedFile> Shared;
};

} // namespace dgtk

#endif
