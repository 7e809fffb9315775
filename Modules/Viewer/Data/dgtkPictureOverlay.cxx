// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPictureOverlay.h"

#include "dgtkError.h"
#include "dgtkObjectDocuments.h"

namespace dgtk
{

namespace
{
/// What one file adds; a damaged one leaves what others added as it is.
template <typename Add>
void attempt(FrameOverlays& overlays, const std::string& file, const Add& add)
{
  try
  {
    if (!file.empty())
    {
      add(file);
    }
  }
  catch (const Error& error)
  {
    overlays.problems.emplace_back(error.what());
  }
}

void addBoxes(PictureOverlay& overlay, const std::vector<BoxRecord>& file)
{
  for (const BoxRecord& record : file)
  {
    overlay.boxes.push_back({ record.id, record.name, record.visible, record.amodal });
  }
}

void addPoints(FrameOverlays& overlays, const TrackedPoints& file)
{
  for (const PointRecord& point : file.points)
  {
    for (const PointRecord::Sight& sight : point.track)
    {
      const auto at =
        sight.camera < file.cameras.size() ? overlays.cameras.find(file.cameras[sight.camera]) : overlays.cameras.end();
      if (at != overlays.cameras.end())
      {
        at->second.points.push_back({ { sight.u, sight.v }, point.object });
      }
    }
  }
}
} // namespace

FrameOverlays readOverlays(const DatasetPictures& dataset, const OverlayAsk& ask)
{
  FrameOverlays overlays;
  overlays.frame = ask.frame;
  for (const std::string& camera : ask.cameras)
  {
    PictureOverlay& overlay = overlays.cameras[camera];
    const std::string boxes = ask.boxes ? dataset.document(DatasetDocument::Boxes, camera, ask.frame) : std::string();
    attempt(overlays, boxes, [&](const std::string& file) { addBoxes(overlay, readBoxes(file)); });
  }
  const std::string points = ask.points ? dataset.document(DatasetDocument::Points, {}, ask.frame) : std::string();
  attempt(overlays, points, [&](const std::string& file) { addPoints(overlays, readPoints(file)); });
  return overlays;
}

} // namespace dgtk
