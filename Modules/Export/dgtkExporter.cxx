// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExporter.h"

namespace dgtk
{

void ExportSink::write(const std::string& name, const std::string& bytes, const ExportedPixels& pixels)
{
  const std::unique_ptr<ExportFile> file = this->open(name, pixels);
  file->write(bytes);
  file->finish();
}

void Exporter::check(const DatasetView&, const OptionValues&) const {}

} // namespace dgtk
