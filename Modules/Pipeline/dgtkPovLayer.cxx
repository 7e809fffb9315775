// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFrameLayers.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkHash.h"
#include "dgtkPovColorSource.h"

namespace dgtk
{

namespace
{
constexpr const char* LibraryFolder = "pov";

LayerSpec povSpec()
{
  return { "pov", PixelType::UInt8, 1, "", "world", "",
    "Scene for POV-Ray 3.7 that shows what the camera sees; to be drawn in its folder, or with that folder as +L" };
}

/// Writes when the job is finished; needs no pixels.
class PovLane : public OutputLane
{
public:
  explicit PovLane(const JobContext& context)
    : Context(context)
  {
  }
  void write(const Band&) override {}

  std::vector<FinishedFile> finish() override
  {
    const std::string name = WorkPlan::fileName(this->Context.camera, "pov", this->Context.job.frame, "pov");
    const WorkPlan& plan = this->Context.plan;
    const PovScene scene = makePovScene(*this->Context.state, this->Context.view, povOptionsOf(plan.request.pov),
      *plan.povLibrary, {}, name.substr(name.rfind('/') + 1));
    std::vector<FinishedFile> files;
    for (const PovFile& file : scene.uses)
    {
      FinishedFile finished;
      finished.record = { std::string(LibraryFolder) + '/' + file.name, file.bytes, file.sha256 };
      finished.layer = "pov";
      finished.shared = true;
      files.push_back(finished);
    }
    FinishedFile own;
    own.record.path = name;
    own.record.bytes = scene.text.size();
    Sha256 hash;
    hash.update(scene.text.data(), scene.text.size());
    own.record.sha256 = hash.hex();
    own.layer = "pov";
    writeFile(this->Context.path(own.record.path), scene.text);
    files.push_back(own);
    return files;
  }

private:
  JobContext Context;
};

class PovLayer final : public FrameLayer
{
public:
  LayerInfo info() const override { return { "pov", { "pov" }, "scene for POV-Ray that shows what the camera sees" }; }
  void check(const WorkPlan&, const Stage& stage) const override
  {
    const SceneDescription& scene = stage.description();
    for (std::size_t camera = 0; camera < scene.cameras.size(); ++camera)
    {
      if (!stage.view(camera, scene.firstFrame()).model->linear())
      {
        throw UsageError("layer pov: camera " + quoted(scene.cameras[camera].name) + " cannot be written for POV-Ray");
      }
    }
  }
  std::vector<LayerRecord> specs(const std::string& format) const override { return { { povSpec(), format } }; }
  std::vector<std::string> files(const WorkPlan&, const Stage& stage, const Job& job) const override
  {
    return { WorkPlan::fileName(stage.cameraNames()[job.camera], "pov", job.frame, "pov") };
  }
  std::vector<std::string> sharedFiles(const std::string& path) const override
  {
    std::vector<std::string> names;
    for (const std::string& name : povSceneUses(path))
    {
      names.push_back(std::string(LibraryFolder) + '/' + name);
    }
    return names;
  }
  std::unique_ptr<OutputLane> makeLane(const JobContext& context) const override
  {
    const FilePlace library = context.path(std::string(LibraryFolder) + "/library");
    library.folder().makeParents(library.name());
    return std::make_unique<PovLane>(context);
  }
};
} // namespace

std::shared_ptr<PovLibrary> makePovLibrary(
  const std::string& folder, const std::function<void(const std::string& name)>& announce)
{
  return std::make_shared<PovLibrary>(folder + '/' + LibraryFolder, std::string("../../") + LibraryFolder + '/',
    [announce](const std::string& name) { announce(std::string(LibraryFolder) + '/' + name); });
}

std::shared_ptr<const FrameLayer> makePovLayer();
std::shared_ptr<const FrameLayer> makePovLayer() { return std::make_shared<PovLayer>(); }

} // namespace dgtk
