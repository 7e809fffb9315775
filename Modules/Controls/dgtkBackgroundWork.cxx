// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkBackgroundWork.h"

#include <QElapsedTimer>
#include <QEventLoop>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QStatusBar>
#include <QTimer>

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>

namespace dgtk
{

namespace
{
constexpr int lookEvery = 5;   // milliseconds
constexpr int showAfter = 150; // milliseconds: short work shows nothing
constexpr int barWidth = 140;  // pixels
} // namespace

struct BackgroundWork::Task
{
  ~Task()
  {
    if (this->thread.joinable())
    {
      this->thread.join();
    }
  }

  std::function<void(const Progress&)> work;
  std::thread thread;
  std::atomic<std::size_t> done{ 0 };
  std::atomic<std::size_t> total{ 0 };
  std::atomic<bool> cancelled{ false };
  std::atomic<bool> ended{ false };
  std::exception_ptr error;
};

BackgroundWork::BackgroundWork(QStatusBar* bar, QObject* parent)
  : QObject(parent)
  , Panel(new QWidget(bar))
{
  this->Panel->setObjectName("backgroundWork");
  this->What = new QLabel(this->Panel);
  this->What->setObjectName("backgroundText");
  this->Bar = new QProgressBar(this->Panel);
  this->Bar->setObjectName("backgroundProgress");
  this->Bar->setFixedWidth(barWidth);
  this->Bar->setTextVisible(false);
  auto* stop = new QPushButton(tr("&Cancel"), this->Panel);
  stop->setObjectName("backgroundCancel");
  auto* layout = new QHBoxLayout(this->Panel);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(this->What);
  layout->addWidget(this->Bar);
  layout->addWidget(stop);
  this->Panel->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Preferred);
  bar->addPermanentWidget(this->Panel);
  this->Panel->hide();
  connect(stop, &QPushButton::clicked, this, &BackgroundWork::cancel);
}

BackgroundWork::~BackgroundWork() { this->cancel(); }

void BackgroundWork::cancel()
{
  if (this->Now)
  {
    this->Now->cancelled = true;
  }
}

void BackgroundWork::setBusy(bool busy)
{
  this->Busy = busy;
  emit this->busyChanged(busy);
}

void BackgroundWork::show(const Task& task)
{
  const std::size_t total = task.total;
  // One file says nothing of how far it is.
  this->Bar->setRange(0, total > 1 ? int(total) : 0);
  this->Bar->setValue(int(task.done));
  this->Panel->show();
}

bool BackgroundWork::run(const QString& what, const std::function<void(const Progress&)>& work)
{
  this->Left.erase(std::remove_if(this->Left.begin(), this->Left.end(),
                     [](const std::shared_ptr<Task>& t) { return t->ended.load(); }),
    this->Left.end());
  const auto task = std::make_shared<Task>();
  task->work = work;
  // The thread is joined before the task is gone.
  task->thread = std::thread(
    [raw = task.get()]
    {
      try
      {
        raw->work(
          [raw](std::size_t done, std::size_t total)
          {
            raw->done = done;
            raw->total = total;
            return !raw->cancelled;
          });
      }
      catch (...)
      {
        raw->error = std::current_exception();
      }
      raw->ended = true;
    });
  this->Now = task;
  this->What->setText(what);
  this->setBusy(true);
  QEventLoop loop;
  QTimer clock;
  QElapsedTimer elapsed;
  elapsed.start();
  connect(&clock, &QTimer::timeout, &loop,
    [&]
    {
      if (task->ended || task->cancelled)
      {
        loop.quit();
      }
      else if (elapsed.elapsed() > showAfter)
      {
        this->show(*task);
      }
    });
  clock.start(lookEvery);
  loop.exec();
  this->Panel->hide();
  this->Now.reset();
  this->setBusy(false);
  if (task->cancelled)
  {
    this->Left.push_back(task);
    return false;
  }
  task->thread.join();
  if (task->error)
  {
    std::rethrow_exception(task->error);
  }
  return true;
}

} // namespace dgtk
