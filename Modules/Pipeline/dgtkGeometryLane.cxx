// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkOutputLanes.h"

#include "dgtkSurfaceRows.h"

#include <algorithm>

namespace dgtk
{

namespace
{
// Pixels whose surfaces are computed at once: fits a core's cache, large enough to be worth a job.
constexpr int stripPixels = 1 << 16;

class GeometryLane : public OutputLane
{
public:
  GeometryLane(const WorkPlan& plan, const Job& job, const std::string& camera, std::shared_ptr<const SceneState> state,
    const View& view, ThreadPool& pool)
    : State(std::move(state))
    , ViewOfJob(view)
    , Pool(pool)
  {
    LayerWriterContext context;
    context.near = view.near;
    context.far = view.far;
    if (view.model->linear())
    {
      const OpenGLMatrices matrices = openGLMatrices(view);
      context.projection = matrices.projection;
      context.modelView = matrices.modelView;
    }
    for (const PlannedLayer& planned : plan.representations)
    {
      Layer layer{ planned.representation, planned.spec, {} };
      this->Barycentrics = this->Barycentrics || planned.representation->needsBarycentrics();
      for (const std::string& format : planned.formats)
      {
        const std::string name = WorkPlan::fileName(camera, planned.spec.name, job.frame, formatExtension(format));
        layer.files.push_back({ makeLayerWriter(format, FilePlace(plan.request.folder, name), planned.spec,
                                  view.model->width(), view.model->height(), context),
          name });
      }
      this->Layers.push_back(std::move(layer));
    }
  }

  void write(const Band& band) override
  {
    const int stripRows = std::max(1, stripPixels / band.rect.width);
    const int strips = (band.rect.height + stripRows - 1) / stripRows;
    const int batch = std::max(1, this->Pool.threads());
    for (int first = 0; first < strips; first += batch)
    {
      const int count = std::min(batch, strips - first);
      std::vector<std::vector<Rows>> done(count);
      this->Pool.parallelFor(count, [&](int i) { done[i] = this->derive(band, (first + i) * stripRows, stripRows); });
      for (const std::vector<Rows>& rows : done)
      {
        this->append(rows);
      }
    }
  }

  std::vector<FinishedFile> finish() override
  {
    std::vector<FinishedFile> files;
    for (Layer& layer : this->Layers)
    {
      for (File& file : layer.files)
      {
        FileRecord record = file.writer->finish();
        record.path = file.name;
        files.push_back({ record, layer.spec.name });
      }
    }
    return files;
  }

private:
  struct File
  {
    std::unique_ptr<LayerWriter> writer;
    std::string name;
  };
  struct Layer
  {
    std::shared_ptr<const Representation> representation;
    LayerSpec spec;
    std::vector<File> files;
  };

  std::vector<Rows> derive(const Band& band, int offset, int stripRows) const
  {
    PixelRect rect = band.rect;
    rect.y += offset;
    rect.height = std::min(stripRows, band.rect.height - offset);
    SurfaceRows surface;
    computeSurfaceRows(*this->State, this->ViewOfJob, rect, band.hits.data() + std::size_t(offset) * rect.width,
      this->Barycentrics, surface);
    std::vector<Rows> out;
    for (const Layer& layer : this->Layers)
    {
      Rows rows(layer.spec.type, layer.spec.channels, rect.width, rect.y, rect.height);
      layer.representation->compute(surface, rows);
      out.push_back(std::move(rows));
    }
    return out;
  }

  void append(const std::vector<Rows>& rows)
  {
    for (std::size_t i = 0; i < this->Layers.size(); ++i)
    {
      for (File& file : this->Layers[i].files)
      {
        file.writer->write(rows[i]);
      }
    }
  }

  std::shared_ptr<const SceneState> State;
  View ViewOfJob;
  ThreadPool& Pool;
  bool Barycentrics = false;
  std::vector<Layer> Layers;
};
} // namespace

std::unique_ptr<OutputLane> makeGeometryLane(const WorkPlan& plan, const Job& job, const std::string& camera,
  std::shared_ptr<const SceneState> state, const View& view, ThreadPool& pool)
{
  return std::make_unique<GeometryLane>(plan, job, camera, std::move(state), view, pool);
}

} // namespace dgtk
