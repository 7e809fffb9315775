// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFileSink.h"
#include "dgtkWorkTime.h"

namespace dgtk
{

/// The files of an output.
struct FileSink::Files
{
  LayerOutput output;
  // one a format, of the kind that the first call asks for
  std::vector<std::unique_ptr<LayerWriter>> images;
  std::vector<std::unique_ptr<LdiWriter>> surfaces;
  std::unique_ptr<CryptomatteWriter> coverages;
  std::vector<FileRecord> finished;

  template <typename Writers>
  void finish(Writers& writers)
  {
    for (const auto& writer : writers)
    {
      this->finished.push_back(writer->finish());
    }
    writers.clear();
  }
};

FileSink::FileSink(std::string folder, const JobContext& context, std::vector<LayerOutput> outputs)
  : Folder(std::move(folder))
  , ObjectNames(context.queries.stage().objectNames())
{
  const View& view = context.view;
  this->Context.near = view.near;
  this->Context.far = view.far;
  if (view.model->linear())
  {
    const OpenGLMatrices matrices = openGLMatrices(view);
    this->Context.projection = matrices.projection;
    this->Context.modelView = matrices.modelView;
  }
  for (LayerOutput& output : outputs)
  {
    this->Outputs.push_back(std::make_unique<Files>());
    this->Outputs.back()->output = std::move(output);
  }
}

FileSink::~FileSink() = default;

void FileSink::rows(std::size_t output, const Rows& rows)
{
  const WorkTime encode(WorkStage::Encode);
  Files& files = *this->Outputs[output];
  const LayerOutput& what = files.output;
  const std::vector<std::string> names = rows.y() == 0 ? what.files() : std::vector<std::string>();
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    files.images.push_back(
      makeLayerWriter(what.formats[i], this->place(names[i]), what.spec, what.width, what.height, this->Context));
  }
  for (const auto& writer : files.images)
  {
    writer->write(rows);
  }
  if (what.isOneOfMany && rows.y() + rows.height() == what.height)
  {
    files.finish(files.images);
  }
}

void FileSink::surfaces(std::size_t output, const LdiRows& rows)
{
  const WorkTime encode(WorkStage::Encode);
  Files& files = *this->Outputs[output];
  const LayerOutput& what = files.output;
  const std::vector<std::string> names = rows.y == 0 ? what.files() : std::vector<std::string>();
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    files.surfaces.push_back(makeLdiWriter(what.formats[i], this->place(names[i]), what.width, what.height));
  }
  for (const auto& writer : files.surfaces)
  {
    writer->write(rows);
  }
}

void FileSink::ranks(std::size_t output, const std::vector<CoveredId>& ranks, std::uint32_t pixels)
{
  const WorkTime encode(WorkStage::Encode);
  Files& files = *this->Outputs[output];
  if (!files.coverages)
  {
    const LayerOutput& what = files.output;
    files.coverages = std::make_unique<CryptomatteWriter>(
      this->place(what.files().front()), what.spec, what.width, what.height, this->ObjectNames, what.spec.channels / 2);
  }
  files.coverages->add(ranks, pixels);
}

void FileSink::document(std::size_t output, const std::string& text)
{
  const WorkTime encode(WorkStage::Encode);
  Files& files = *this->Outputs[output];
  const DatasetFile file = writeDocument(this->Folder, files.output.files().front(), text);
  files.finished.push_back({ file.path, file.bytes, file.sha256 });
}

void FileSink::shared(const std::string& layer, const FileRecord& file)
{
  this->Shared.push_back({ file, layer, true });
}

std::vector<FinishedFile> FileSink::finish()
{
  const WorkTime encode(WorkStage::Encode);
  std::vector<FinishedFile> all = std::move(this->Shared);
  for (const std::unique_ptr<Files>& files : this->Outputs)
  {
    files->finish(files->images);
    files->finish(files->surfaces);
    if (files->coverages)
    {
      files->finished.push_back(files->coverages->finish());
    }
    const std::vector<std::string> names = files->output.files();
    for (std::size_t i = 0; i < files->finished.size(); ++i)
    {
      files->finished[i].path = names[i];
      all.push_back({ files->finished[i], files->output.layer });
    }
  }
  return all;
}

} // namespace dgtk
