// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExport.h"

#include "dgtkExportRun.h"
#include "dgtkItemSink.h"
#include "dgtkSceneFolders.h"

namespace dgtk
{

ExportRequest sceneExport(const ExportRequest& request, const std::string& scene)
{
  ExportRequest one = request;
  one.dataset += '/' + scene;
  one.folder += '/' + scene;
  return one;
}

std::vector<std::string> scenesApart(const ExportRequest& request)
{
  std::vector<std::string> scenes = sceneFoldersIn(request.dataset);
  if (!scenes.empty() && findExporter(request.format).make()->joinsScenes())
  {
    scenes.clear();
  }
  return scenes;
}

ExportCallbacks sceneCallbacks(const ExportCallbacks& callbacks, const ScenePlace& place)
{
  ExportCallbacks own = callbacks;
  own.progress = [callbacks, place](const ExportProgress& state)
  {
    if (callbacks.progress) // of scenes; each counts as many as it has
    {
      const std::size_t before = place.scene * state.total;
      const std::size_t kept = std::min(place.keptScenes * state.total + place.keptItems, before);
      callbacks.progress({ before + state.done, place.scenes * state.total, kept + state.kept });
    }
  };
  return own;
}

void addResult(const ExportResult& one, ExportResult& all)
{
  all.files += one.files;
  all.kept += one.kept;
  all.interrupted = one.interrupted;
  addRounding(all.layers, one.layers);
}

ExportResult exportDataset(const ExportRequest& request, const ExportCallbacks& callbacks)
{
  const std::vector<std::string> scenes = scenesApart(request);
  if (scenes.empty())
  {
    return ExportRun(request, callbacks).execute();
  }
  for (const std::string& scene : scenes) // none is begun before all are known to be sayable
  {
    ExportRun(sceneExport(request, scene), {}).requireOneEach();
  }
  ExportResult all;
  for (std::size_t i = 0; i < scenes.size() && !all.interrupted; ++i)
  {
    addResult(ExportRun(sceneExport(request, scenes[i]), sceneCallbacks(callbacks, { i, scenes.size(), 0, all.kept }))
                .execute(),
      all);
  }
  return all;
}

} // namespace dgtk
