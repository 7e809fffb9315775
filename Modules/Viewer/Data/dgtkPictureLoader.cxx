// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPictureLoader.h"

#include <algorithm>
#include <thread>

namespace dgtk
{

namespace
{
constexpr std::uint64_t mostKept = std::uint64_t(512) << 20; // bytes
constexpr std::size_t mostPoints = 400000;                   // of a cloud: what is turned without waiting
constexpr int openSlot = -1;
constexpr int cloudSlot = -2;
constexpr int overlaySlot = -3;
constexpr int prefetchSlots = 100000; // above those of panes
enum Priority
{
  Now,
  Points,
  Later
};

int threadCount() { return std::clamp(static_cast<int>(std::thread::hardware_concurrency()) / 2, 1, 4); }

std::uint64_t bytesOf(const ShownPicture& shown)
{
  return (shown.picture ? shown.picture->bytes() : 0) + shown.colors.pixels.size() * 4;
}

bool sameValues(const PictureAsk& a, PictureAsk b)
{
  b.range = a.range;
  return a == b;
}
} // namespace

PictureLoader::PictureLoader(QObject* parent)
  : QObject(parent)
  , Queue(threadCount(), nullptr)
{
}

void PictureLoader::open(const QString& folder)
{
  const std::string path = folder.toStdString();
  this->Queue.post(openSlot, Now,
    [this, path](const BackgroundQueue::GoOn&) -> BackgroundQueue::Done
    {
      try
      {
        const auto dataset = std::make_shared<const DatasetPictures>(path);
        return [this, dataset]
        {
          const std::lock_guard<std::mutex> lock(this->Mutex);
          this->Dataset = dataset;
          this->Kept.clear();
          this->KeptBytes = 0;
          this->Queue.drop(cloudSlot);
          this->Queue.drop(overlaySlot);
          QMetaObject::invokeMethod(
            this, [this, dataset] { emit this->opened(dataset); }, Qt::QueuedConnection);
        };
      }
      catch (const std::exception& error)
      {
        const QString message = QString::fromStdString(error.what());
        return [this, message] { emit this->refused(message); };
      }
    });
}

void PictureLoader::ask(int pane, const PictureAsk& ask)
{
  std::shared_ptr<const PictureValues> values;
  if (const ShownPointer known = this->find(this->Dataset, ask, values))
  {
    this->Queue.drop(pane);
    emit this->ready(pane, known);
    return;
  }
  this->Queue.post(pane, Now,
    [this, pane, ask, dataset = this->Dataset, budget = this->Budget](const BackgroundQueue::GoOn& goOn)
    {
      const ShownPointer shown = this->load(dataset, ask, budget, goOn);
      return [this, pane, shown] { emit this->ready(pane, shown); };
    });
}

void PictureLoader::prefetch(int pane, const PictureAsk& ask)
{
  this->Queue.post(prefetchSlots + pane, Later,
    [this, ask, dataset = this->Dataset, budget = this->Budget](
      const BackgroundQueue::GoOn& goOn) -> BackgroundQueue::Done
    {
      this->load(dataset, ask, budget, goOn);
      return {};
    });
}

ShownPointer PictureLoader::find(
  const DatasetPointer& dataset, const PictureAsk& ask, std::shared_ptr<const PictureValues>& values)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  for (auto at = this->Kept.begin(); at != this->Kept.end(); ++at)
  {
    if ((*at)->dataset != dataset)
    {
      continue;
    }
    if ((*at)->ask == ask)
    {
      this->Kept.splice(this->Kept.begin(), this->Kept, at);
      return this->Kept.front();
    }
    values = sameValues((*at)->ask, ask) ? (*at)->picture : values;
  }
  return nullptr;
}

void PictureLoader::keep(const ShownPointer& shown)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->Kept.push_front(shown);
  this->KeptBytes += bytesOf(*shown);
  while (this->KeptBytes > mostKept && this->Kept.size() > 1)
  {
    this->KeptBytes -= bytesOf(*this->Kept.back());
    this->Kept.pop_back();
  }
}

ShownPointer PictureLoader::load(
  const DatasetPointer& dataset, const PictureAsk& ask, std::uint64_t budget, const BackgroundQueue::GoOn& goOn)
{
  std::shared_ptr<const PictureValues> values;
  if (ShownPointer known = this->find(dataset, ask, values))
  {
    return known;
  }
  auto shown = std::make_shared<ShownPicture>();
  shown->ask = ask;
  shown->dataset = dataset;
  try
  {
    const std::string path = dataset->file(ask.key);
    const PictureLayer* const layer = dataset->layer(ask.key.layer);
    if (path.empty() || layer == nullptr)
    {
      shown->error = tr("No picture of this layer here");
      return shown;
    }
    if (!values)
    {
      PictureRead read;
      read.window = ask.window;
      read.step = ask.step;
      read.surface = ask.surface;
      read.budget = budget;
      read.goOn = goOn;
      values = std::make_shared<const PictureValues>(readPicture(path, *layer, read));
    }
    if (values->columns() > 0)
    {
      shown->colors = colorPicture(*dataset, *values, ask.range);
      shown->picture = values;
      this->keep(shown);
    }
  }
  catch (const std::exception& error)
  {
    shown->error = QString::fromStdString(error.what());
  }
  return shown;
}

void PictureLoader::askCloud(const CloudAsk& ask)
{
  this->Queue.post(cloudSlot, Points,
    [this, ask, dataset = this->Dataset](const BackgroundQueue::GoOn& goOn) -> BackgroundQueue::Done
    {
      auto cloud = std::make_shared<PointCloud>();
      QString problem;
      for (const std::string& camera : ask.cameras)
      {
        try
        {
          addPoints(*cloud, *dataset, camera, ask.frame, ask.colorLayer, mostPoints / ask.cameras.size() + 1, goOn);
        }
        catch (const std::exception& error)
        {
          problem = QString::fromStdString(error.what());
        }
      }
      return [this, cloud, problem] { emit this->cloudReady(cloud, problem); };
    });
}

void PictureLoader::askOverlays(const OverlayAsk& ask)
{
  if (ask.cameras.empty())
  {
    this->Queue.drop(overlaySlot);
    emit this->overlaysReady(nullptr, {});
    return;
  }
  this->Queue.post(overlaySlot, Now,
    [this, ask, dataset = this->Dataset](const BackgroundQueue::GoOn&) -> BackgroundQueue::Done
    {
      try
      {
        const auto overlays = std::make_shared<const FrameOverlays>(readOverlays(*dataset, ask));
        return [this, overlays] { emit this->overlaysReady(overlays, {}); };
      }
      catch (const std::exception& error)
      {
        const QString message = QString::fromStdString(error.what());
        return [this, message] { emit this->overlaysReady(nullptr, message); };
      }
    });
}

} // namespace dgtk
