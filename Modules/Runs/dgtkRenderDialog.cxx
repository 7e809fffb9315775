// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRenderDialog.h"

#include "dgtkFolderContents.h"
#include "dgtkGenerator.h"
#include "dgtkNumberRow.h"
#include "dgtkOption.h"
#include "dgtkRenderCameras.h"
#include "dgtkRenderOptions.h"
#include "dgtkUsualFolder.h"
#include "dgtkWindowSize.h"

#include <QCheckBox>
#include <QComboBox>
#include <QCryptographicHash>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QSettings>
#include <QSize>
#include <QSpinBox>
#include <QTabWidget>
#include <QTimer>
#include <QVBoxLayout>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace dgtk
{

namespace
{
constexpr int progressEvery = 200; // milliseconds
constexpr int progressSteps = 100000;

QString durationText(double seconds)
{
  const int s = int(std::min(seconds + 0.5, 1e6));
  const QString minutes =
    QString("%1:%2").arg(s / 60 % 60, s >= 3600 ? 2 : 1, 10, QChar('0')).arg(s % 60, 2, 10, QChar('0'));
  return s >= 3600 ? QString("%1:%2").arg(s / 3600).arg(minutes) : minutes;
}

QByteArray hashOf(const SceneDocument& document)
{
  return QCryptographicHash::hash(QByteArray::fromStdString(document.json()), QCryptographicHash::Sha1).toHex();
}
} // namespace

RenderDialog::RenderDialog(EditorState& state, QWidget* parent)
  : QDialog(parent)
  , State(state)
  , Process(nullptr)
{
  this->setObjectName("renderDialog");
  this->setWindowTitle(tr("Render configuration"));
  auto* layout = new QVBoxLayout(this);
  this->Tabs = new QTabWidget(this);
  this->Cameras = new RenderCameras(state, this);
  this->Tabs->addTab(this->makeInfo(), tr("Info"));
  this->Tabs->addTab(this->Cameras, tr("Cameras"));
  this->Options = new RenderOptions(this);
  this->Tabs->addTab(this->makeControls(), tr("Controls"));
  this->Tabs->addTab(this->Options, tr("Options"));
  this->Options->setLayers(this->checkedLayers());
  this->Tabs->setCurrentIndex(2);
  layout->addWidget(this->Tabs, 1);
  this->makeRunRow(layout);
  resizeWithin(*this, 640, 724);

  connect(&state, &EditorState::changed, this, &RenderDialog::refresh);
  connect(&state, &EditorState::selectionChanged, this, &RenderDialog::offerSelection);
  this->Clock = new QTimer(this);
  connect(this->Clock, &QTimer::timeout, this, &RenderDialog::showProgress);
  connect(&this->Process, &RenderProcess::progress, this, &RenderDialog::takeProgress);
  connect(&this->Process, &RenderProcess::line, this, &RenderDialog::noted);
  connect(&this->Process, &RenderProcess::finished, this, &RenderDialog::finish);
  this->refresh();
  this->lookAtFolder();
}

void RenderDialog::refresh()
{
  const SceneDescription& scene = this->State.scene();
  if (const std::size_t opened = this->State.document().opened(); opened != this->Opened && !this->Process.running())
  {
    // Another scene: the folder of the one before is not for it.
    this->Opened = opened;
    this->Progress->setValue(0);
    this->Status->clear();
    this->Folder->setText(RunFolder::usual(this->State.document().path()));
    this->lookAtFolder();
  }
  const std::vector<int> keys = scene.keyFrames();
  this->Info->setText(
    tr("<table cellpadding='4'><tr><td>Scene</td><td>%1</td></tr><tr><td>Objects</td><td>%2</td></tr>"
       "<tr><td>Lights</td><td>%3</td></tr><tr><td>Cameras</td><td>%4</td></tr>"
       "<tr><td>Frames</td><td>%5 to %6</td></tr><tr><td>Key frames</td><td>%7</td></tr></table>")
      .arg(this->State.document().path().empty() ? tr("not saved yet")
                                                 : toText(this->State.document().path()).toHtmlEscaped(),
        QString::number(scene.objects.size()), QString::number(scene.lights.size()),
        QString::number(scene.cameras.size()), QString::number(scene.firstFrame()), QString::number(scene.lastFrame()),
        QString::number(keys.size())));
  for (const LayerInfo& layer : generatorLayers())
  {
    if (layer.appliesTo != nullptr)
    {
      this->layerBox(toText(layer.layer))->setEnabled(layer.appliesTo(scene));
    }
  }
  this->offerSelection();
  const int range[2] = { scene.firstFrame(), scene.lastFrame() };
  for (int end = 0; end < 2; ++end)
  {
    // Follows the scene until somebody chooses otherwise.
    if (this->Frames[end]->value() == this->SceneRange[end])
    {
      this->Frames[end]->setValue(range[end]);
    }
    this->SceneRange[end] = range[end];
  }
}

QStringList RenderDialog::checkedLayers() const
{
  QStringList layers;
  for (const QCheckBox* box : this->Layers)
  {
    if (box->isChecked() && box->isEnabledTo(box->parentWidget()))
    {
      layers << box->text();
    }
  }
  return layers;
}

QCheckBox* RenderDialog::layerBox(const QString& layer) const
{
  const auto at = std::find_if(
    this->Layers.begin(), this->Layers.end(), [&layer](const QCheckBox* box) { return box->text() == layer; });
  return at == this->Layers.end() ? nullptr : *at;
}

void RenderDialog::offerSelection()
{
  const SceneDescription& scene = this->State.scene();
  std::vector<std::string> names;
  for (const SceneItem& item : this->State.selection())
  {
    if (item.kind == SceneItem::Kind::Object && item.index < scene.objects.size())
    {
      names.push_back(scene.objects[item.index].name);
    }
  }
  this->Options->offer("matte", toText(joinedNames(names)));
}

QStringList RenderDialog::arguments(const QString& scene) const
{
  const QStringList cameras = this->Cameras->checked();
  QStringList words{ "render", scene, "-o", this->Found.path(), optionWord("layers"), this->checkedLayers().join(',') };
  if (cameras.size() != this->Cameras->count())
  {
    words << optionWord("cameras") << cameras.join(',');
  }
  const SceneDescription& description = this->State.scene();
  const bool allFrames = this->Frames[0]->value() == description.firstFrame() &&
                         this->Frames[1]->value() == description.lastFrame() && this->Frames[2]->value() == 1;
  if (!allFrames)
  {
    words
      << optionWord("frames")
      << QString("%1:%2:%3").arg(this->Frames[0]->value()).arg(this->Frames[1]->value()).arg(this->Frames[2]->value());
  }
  if (const QString format = this->Export->currentData().toString(); !format.isEmpty())
  {
    words << optionWord("for") << format;
  }
  if (const std::optional<QSize> size = this->Cameras->commonSize())
  {
    words << optionWord("size") << QString("%1x%2").arg(size->width()).arg(size->height());
  }
  return words + this->Options->words();
}

QString RenderDialog::sceneFile()
{
  SceneDocument& document = this->State.document();
  if (!document.modified() && !document.path().empty() && !document.isReplaced())
  {
    return QFileInfo(toText(document.path())).absoluteFilePath();
  }
  QString copy = RunLog(this->Found.path()).sceneCopy();
  document.writeCopy(QFile::encodeName(copy).toStdString());
  return copy;
}

void RenderDialog::lookAtFolder()
{
  this->Found = RunFolder(this->Folder->text());
  this->Resume->setChecked(this->Found.unfinished());
  if (this->Status->text().isEmpty())
  {
    this->Status->setText(this->Found.text());
  }
  this->setRunning(false);
}

void RenderDialog::browse()
{
  const QString folder = QFileDialog::getExistingDirectory(this, tr("Folder of the dataset"), this->Folder->text());
  if (!folder.isEmpty())
  {
    this->Folder->setText(folder);
  }
}

QString RenderDialog::missing() const
{
  if (const QString fault = commitRows(*this); !fault.isEmpty())
  {
    return fault;
  }
  if (this->Cameras->count() == 0)
  {
    return tr("The scene has no camera. Add one with Tools > Add camera.");
  }
  if (this->Cameras->checked().isEmpty())
  {
    return tr("Check at least one camera on the page Cameras.");
  }
  if (this->checkedLayers().isEmpty())
  {
    return tr("Check at least one layer.");
  }
  return {};
}

bool RenderDialog::goesOn() const { return this->Resume->isChecked() && this->Found.interrupted(); }

RunRequest RenderDialog::newRequest()
{
  return { this->Found.path(), this->arguments(this->sceneFile()), hashOf(this->State.document()) };
}

void RenderDialog::start()
{
  using Begin = RunFolder::Begin;
  this->State.finishTyping();
  this->Found = RunFolder(this->Folder->text());
  const QString missing = this->Folder->text().trimmed().isEmpty() ? tr("Name a folder for the dataset.")
                          : this->goesOn()                         ? QString()
                                                                   : this->missing();
  if (!missing.isEmpty())
  {
    this->Status->setText(missing);
    return;
  }
  if (this->Found.rendering())
  {
    this->follow(this->Found.path()); // another window's, or an earlier one's
    return;
  }
  // Without a camera there is nothing else that could be meant.
  const QByteArray scene = this->Cameras->count() > 0 ? hashOf(this->State.document()) : QByteArray();
  const Begin begin = this->Found.begin(this->Resume->isChecked(), scene, this);
  RunRequest request;
  if (begin == Begin::Not)
  {
    this->Folder->setFocus();
  }
  else if (begin == Begin::GoOn && this->Found.interrupted())
  {
    request = *this->Found.interrupted();
  }
  else if (!this->State.attempt([&] { request = this->newRequest(); }))
  {
    request = {};
  }
  if (!request.arguments.isEmpty())
  {
    const QStringList how = begin == Begin::GoOn      ? QStringList{ optionWord("resume") }
                            : begin == Begin::Replace ? QStringList{ optionWord("replace") }
                                                      : QStringList();
    this->rememberChoices();
    this->begin();
    emit this->noted("dgtk " + shellLine(request.arguments + how));
    emit this->started();
    this->Process.start(request, how);
  }
}

void RenderDialog::begin()
{
  this->setRunning(true);
  this->Progress->setRange(0, 0);
  this->Estimate = {};
  this->Pictures.clear();
  this->Running.start();
  this->Clock->start(progressEvery);
  this->Status->setText(tr("Rendering ..."));
  emit this->progressed(-1, {});
}

void RenderDialog::follow(const QString& folder)
{
  this->Folder->setText(folder);
  this->begin();
  this->Process.follow(folder);
}

void RenderDialog::offer(const QString& folder)
{
  if (!this->running())
  {
    this->Folder->setText(folder);
    this->lookAtFolder();
  }
}

void RenderDialog::rememberChoices() const
{
  QSettings settings;
  settings.setValue("render/layers", this->checkedLayers());
  this->Options->remember();
}

void RenderDialog::takeProgress(int done, int total)
{
  this->Estimate.report(double(this->Running.elapsed()) / 1000, done, total);
  this->Pictures = tr("Pictures: %1 of %2").arg(done).arg(total);
}

void RenderDialog::showProgress()
{
  if (this->Process.cancelled())
  {
    this->Status->setText(tr("Stopping ... Cancel again ends what is being drawn, too."));
    return;
  }
  if (this->Pictures.isEmpty())
  {
    return; // the models are being read
  }
  const double now = double(this->Running.elapsed()) / 1000;
  const double fraction = this->Estimate.fractionAt(now);
  this->Progress->setRange(0, progressSteps);
  this->Progress->setValue(int(progressSteps * fraction));
  const std::optional<double> left = this->Estimate.secondsLeftAt(now);
  this->Status->setText(left ? tr("%1, %2 left").arg(this->Pictures, durationText(*left)) : this->Pictures);
  emit this->progressed(fraction, left ? durationText(*left) : QString());
}

void RenderDialog::cancel()
{
  this->Process.cancel();
  this->showProgress();
}

QString RenderDialog::endText(RunLog::End end, const QString& message) const
{
  const bool goesOn = this->Resume->isChecked();
  switch (end)
  {
    case RunLog::End::Done:
      return message;
    case RunLog::End::Failed:
      return message.contains(QString::fromStdString(describe(FolderContents::UnfinishedOther)))
               ? tr("The interrupted run in this folder is of another request: untick to replace it, or name another "
                    "folder.")
               : this->Options->inWindowsWords(message);
    case RunLog::End::Lost:
      if (!this->Process.cancelled())
      {
        return goesOn ? tr("The run was ended from outside. Start goes on where it ended.")
                      : tr("The run was ended from outside.");
      }
      [[fallthrough]];
    default:
      return goesOn ? tr("Stopped. Start goes on where it stopped.") : tr("Stopped.");
  }
}

void RenderDialog::finish(RunLog::End end, const QString& message)
{
  this->Clock->stop();
  this->Progress->setRange(0, 1);
  this->Progress->setValue(end == RunLog::End::Done ? 1 : 0);
  this->lookAtFolder();
  if (end == RunLog::End::Done)
  {
    rememberFolder(this->Found.path(), "dataset");
  }
  const QString said = this->endText(end, message);
  this->Status->setText(said);
  emit this->ended(end, said);
}

void RenderDialog::setRunning(bool on)
{
  this->Tabs->setEnabled(!on && !this->goesOn()); // that goes on as it was begun
  this->Resume->setEnabled(!on);
  this->Folder->setEnabled(!on); // the result is there
  this->Browse->setEnabled(!on);
  this->Start->setEnabled(!on);
  this->Cancel->setEnabled(on);
  const bool there = !on && this->Found.finished();
  this->Open->setEnabled(there);
  this->Result->setEnabled(there);
}

void RenderDialog::showEvent(QShowEvent* event)
{
  QDialog::showEvent(event);
  if (!this->running())
  {
    this->lookAtFolder();
  }
  emit this->shown();
}

void RenderDialog::reject()
{
  // The window goes, the run goes on; the dialog shows it when it comes back.
  this->hide();
}

} // namespace dgtk
