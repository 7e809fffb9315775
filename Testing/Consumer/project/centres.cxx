// SPDX-License-Identifier: BSD-3-Clause
// A format of exports of a program of its own: where the cameras are, as a table.
#include <dgtkExporterEntry.h>

#include <cstdio>

namespace
{
using namespace dgtk;

class CentresExporter : public Exporter
{
public:
  ExportNeeds needs(const OptionValues&) const override { return { { "depth" } }; }

  ExportPlan plan(const DatasetView& dataset, const OptionValues&) const override
  {
    ExportPlan plan;
    for (const DatasetShot& shot : dataset.shots())
    {
      plan.items.push_back({ {}, [&shot](ExportSink& sink) { sink.note("rows", rowOf(shot)); } });
    }
    plan.documents.push_back({ { "centres.csv" }, [](ExportSink& sink)
      {
        const std::unique_ptr<ExportFile> file = sink.open("centres.csv");
        file->write("camera,frame,x,y,z\n");
        sink.notes("rows", [&](const std::string& row) { file->write(row); });
        file->finish();
      } });
    return plan;
  }

private:
  static std::string rowOf(const DatasetShot& shot)
  {
    const Eigen::Vector3d centre = cameraFromWorld(shot.camera).inverse().translation;
    char text[256];
    std::snprintf(text, sizeof text, "%s,%d,%.17g,%.17g,%.17g\n", shot.name().c_str(), shot.frame(), centre.x(),
      centre.y(), centre.z());
    return text;
  }
};

std::unique_ptr<Exporter> makeCentres() { return std::make_unique<CentresExporter>(); }

const bool added = addExporter({ "centres", "where the cameras are" }, &makeCentres); // the row
} // namespace
