// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLayers.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkPovRenderOptions.h"

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr const char* libraryFolder = "pov";

LayerSpec povSpec()
{
  return { "pov", PixelType::UInt8, 1, "", "world", "",
    "Scene for POV-Ray 3.7 that shows what the camera sees; to be drawn in its folder, or with that folder as +L",
    Meaning::Record };
}

/// Needs no pixels.
class PovPass : public LayerPass
{
public:
  PovPass(const JobContext& context, const PassLayer& layer)
    : Context(context)
    , Library(std::static_pointer_cast<PovLibrary>(layer.planned.shared))
    , Name(layer.outputs.front().files().front())
  {
  }

  void finish(LayerSink& sink) override
  {
    const PovScene scene =
      makePovScene(*this->Context.state, this->Context.view, povOptionsOf(this->Context.plan.request.options),
        *this->Library, {}, this->Name.substr(this->Name.rfind('/') + 1));
    for (const PovFile& file : scene.uses)
    {
      sink.shared("pov", { std::string(libraryFolder) + '/' + file.name, file.bytes, file.sha256 });
    }
    sink.document(0, scene.text);
  }

private:
  JobContext Context;
  std::shared_ptr<PovLibrary> Library;
  std::string Name;
};

class PovLayer final : public Layer
{
public:
  LayerInfo info() const override { return { "pov", { "pov" }, "scene for POV-Ray that shows what the camera sees" }; }
  LayerNeeds needs(const LayerRequest&, const Stage&) const override { return LayerNeeds::ofLinear(); }
  std::vector<const OptionRow*> options() const override { return povOptionRows(); }
  std::vector<LayerRecord> records(const WorkPlan&, const std::string& format) const override
  {
    return { { povSpec(), format } };
  }
  std::vector<LayerOutput> outputs(
    const WorkPlan&, const Stage& stage, const Job& job, const PlannedLayer& planned) const override
  {
    return { documentOutput(stage, job, povSpec(), planned.formats.front()) };
  }
  std::vector<std::string> notes(const WorkPlan& plan, const Stage& stage) const override
  {
    const Job& first = *std::find_if(
      plan.jobs.begin(), plan.jobs.end(), [&](const Job& job) { return plan.curved.count(job.camera) == 0; });
    const LayerRequest& request = plan.request;
    return povLines(
      *stage.at(first.frame), stage.view(first.camera, first.frame, request.width, request.height), request.options);
  }
  std::shared_ptr<void> makeShared(const SharedPlace& place) const override
  {
    const std::string folder = place.folder();
    Folder(folder).makeParents(std::string(libraryFolder) + "/library");
    return std::make_shared<PovLibrary>(folder + '/' + libraryFolder, std::string("../../") + libraryFolder + '/',
      [announce = place.announce](const std::string& name) { announce(std::string(libraryFolder) + '/' + name); });
  }
  std::vector<std::string> sharedFiles(const std::string& path) const override
  {
    std::vector<std::string> names;
    for (const std::string& name : povSceneUses(path))
    {
      names.push_back(std::string(libraryFolder) + '/' + name);
    }
    return names;
  }
  std::unique_ptr<LayerPass> makePass(const JobContext& context, const std::vector<PassLayer>& layers) const override
  {
    return std::make_unique<PovPass>(context, layers.front());
  }
};
} // namespace

LayerList povLayers() { return { std::make_shared<PovLayer>() }; }

} // namespace dgtk
