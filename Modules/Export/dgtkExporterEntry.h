// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkExporterEntry_h
#define dgtkExporterEntry_h

#include "dgtkExporter.h"

#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// One row of the registry of exporters.
struct ExporterInfo
{
  std::string name;        ///< "coco": as a format is asked for
  std::string description; ///< one line
};

struct ExporterRow
{
  ExporterInfo info;
  std::unique_ptr<Exporter> (*make)(); ///< make<Name>Exporter of dgtk<Name>Exporter.cxx
};

DGTKEXPORT_EXPORT const std::vector<ExporterRow>& exporterRows();

/// Adds a format of a program of its own, before anything asks for formats. True.
DGTKEXPORT_EXPORT bool addExporter(const ExporterInfo& info, std::unique_ptr<Exporter> (*make)());

} // namespace dgtk

#endif
