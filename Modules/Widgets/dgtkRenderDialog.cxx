// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRenderDialog.h"

#include "dgtkCameraModel.h"
#include "dgtkScenePlaces.h"
#include "dgtkWindowSize.h"

#include <QCheckBox>
#include <QCryptographicHash>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMessageBox>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QSpinBox>
#include <QStandardPaths>
#include <QTabWidget>
#include <QTimer>
#include <QVBoxLayout>

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr int progressEvery = 200; // milliseconds
constexpr int progressSteps = 100000;
constexpr int usualSize[2] = { 640, 480 }; // of a camera that has none

QString durationText(double seconds)
{
  const int s = int(std::min(seconds + 0.5, 1e6));
  const QString minutes =
    QString("%1:%2").arg(s / 60 % 60, s >= 3600 ? 2 : 1, 10, QChar('0')).arg(s % 60, 2, 10, QChar('0'));
  return s >= 3600 ? QString("%1:%2").arg(s / 3600).arg(minutes) : minutes;
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
  this->Tabs->addTab(this->makeInfo(), tr("Info"));
  this->Tabs->addTab(this->makeCameras(), tr("Cameras"));
  this->Tabs->addTab(this->makeControls(), tr("Controls"));
  this->Tabs->setCurrentIndex(2);
  layout->addWidget(this->Tabs, 1);
  this->makeRunRow(layout);
  resizeWithin(*this, 640, 680);

  connect(&state, &EditorState::changed, this, &RenderDialog::refresh);
  this->Clock = new QTimer(this);
  connect(this->Clock, &QTimer::timeout, this, &RenderDialog::showProgress);
  connect(&this->Process, &RenderProcess::progress, this, &RenderDialog::takeProgress);
  connect(&this->Process, &RenderProcess::line, this, &RenderDialog::noted);
  connect(&this->Process, &RenderProcess::finished, this, &RenderDialog::finish);
  this->refresh();
  this->setRunning(false);
}

QString RenderDialog::usualFolder() const
{
  const std::string& path = this->State.document().path();
  const QFileInfo file(toText(path));
  return path.empty() ? QDir::home().filePath("dataset") : file.dir().filePath(file.completeBaseName() + "_dataset");
}

void RenderDialog::refresh()
{
  const SceneDescription& scene = this->State.scene();
  if (const std::size_t opened = this->State.document().opened(); opened != this->Opened && !this->Process.running())
  {
    // Another scene: the folder of the one before is not for it.
    this->Opened = opened;
    this->Folder->setText(this->usualFolder());
    this->Resume->setChecked(false);
    this->Progress->setValue(0);
    this->Status->clear();
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
  QStringList left;
  for (int i = 0; i < this->Cameras->count(); ++i)
  {
    if (this->Cameras->item(i)->checkState() == Qt::Unchecked)
    {
      left << this->Cameras->item(i)->text();
    }
  }
  const int row = this->Cameras->currentRow();
  const QSignalBlocker quiet(this->Cameras);
  this->Cameras->clear();
  for (const CameraDescription& camera : scene.cameras)
  {
    auto* item = new QListWidgetItem(toText(camera.name), this->Cameras);
    item->setFlags(item->flags() | Qt::ItemIsUserCheckable);
    item->setCheckState(left.contains(item->text()) ? Qt::Unchecked : Qt::Checked);
  }
  this->Cameras->setCurrentRow(std::max(0, std::min(row, this->Cameras->count() - 1)));
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
  this->showResolution();
}

const CameraDescription* RenderDialog::chosenCamera() const
{
  const std::vector<CameraDescription>& cameras = this->State.scene().cameras;
  const int row = this->Cameras->currentRow();
  return row < 0 || row >= int(cameras.size()) ? nullptr : &cameras[std::size_t(row)];
}

void RenderDialog::showSize()
{
  const bool own = this->OwnSize->isChecked();
  const CameraDescription* const camera = this->chosenCamera();
  const int of[2] = { camera ? camera->width : 0, camera ? camera->height : 0 };
  // The size of a camera with a matrix K belongs to that matrix.
  const bool editable = !own || (camera != nullptr && !camera->K);
  for (int axis = 0; axis < 2; ++axis)
  {
    const int size = own && of[axis] > 0 ? of[axis] : own ? usualSize[axis] : this->CommonSize[axis];
    const QSignalBlocker quietSize(this->Size[axis]);
    const QSignalBlocker quietSlider(this->Sliders[axis]);
    this->Size[axis]->setValue(size);
    this->Sliders[axis]->setValue(std::min(size, this->Sliders[axis]->maximum()));
    this->Size[axis]->setEnabled(editable);
    this->Sliders[axis]->setEnabled(editable);
  }
}

void RenderDialog::takeSize()
{
  const int size[2] = { this->Size[0]->value(), this->Size[1]->value() };
  if (!this->OwnSize->isChecked())
  {
    std::copy(size, size + 2, this->CommonSize);
    this->showResolution();
    return;
  }
  if (const CameraDescription* const camera = this->chosenCamera())
  {
    const SceneItem item{ SceneItem::Kind::Camera, std::size_t(this->Cameras->currentRow()) };
    this->State.attempt(
      [&]
      {
        this->State.document().editItem(
          "Set image size", item,
          [&](SceneDescription& scene)
          {
            scene.cameras[item.index].width = size[0];
            scene.cameras[item.index].height = size[1];
          },
          "size of " + camera->name);
      });
  }
}

void RenderDialog::showResolution()
{
  const SceneDescription& scene = this->State.scene();
  this->showSize();
  const CameraDescription* const chosen = this->chosenCamera();
  if (chosen == nullptr)
  {
    this->Resolution->setText(tr("The scene has no camera. Add one with Tools > Add camera."));
    return;
  }
  SceneDescription alone;
  alone.cameras.push_back(*chosen);
  CameraDescription& camera = alone.cameras.front();
  if (!this->OwnSize->isChecked() && !camera.K)
  {
    camera.width = this->Size[0]->value();
    camera.height = this->Size[1]->value();
  }
  const CameraPlace place = placeScene(alone, ModelStore(), this->State.frame()).cameras.front();
  if (!place.valid)
  {
    this->Resolution->setText(
      tr("%1 has no pose at this frame: its eye is at its look-at point.").arg(toText(camera.name)));
    return;
  }
  const WorldResolution resolution = worldResolution(place.view);
  const QString units = scene.units.empty() ? tr("units") : toText(scene.units);
  const auto number = [](double value) { return QString::number(value, 'g', 6); };
  this->Resolution->setText(
    tr("%1: %2 x %3 pixels\nA pixel is %5 %4 in x, %6 in y; at the far plane %7 and %8")
      .arg(toText(camera.name), QString::number(place.view.model->width()), QString::number(place.view.model->height()),
        units, number(resolution.thesis.x()), number(resolution.thesis.y()), number(resolution.farPlane.x()),
        number(resolution.farPlane.y())));
}

QStringList RenderDialog::arguments(const QString& scene) const
{
  QStringList layers;
  for (const QCheckBox* box : this->Layers)
  {
    if (box->isChecked())
    {
      layers << box->text();
    }
  }
  QStringList cameras;
  for (int i = 0; i < this->Cameras->count(); ++i)
  {
    if (this->Cameras->item(i)->checkState() == Qt::Checked)
    {
      cameras << this->Cameras->item(i)->text();
    }
  }
  QStringList words{ "render", scene, "-o", this->Folder->text(), "--layers", layers.join(',') };
  if (cameras.size() != this->Cameras->count())
  {
    words << "--cameras" << cameras.join(',');
  }
  const SceneDescription& description = this->State.scene();
  const bool allFrames = this->Frames[0]->value() == description.firstFrame() &&
                         this->Frames[1]->value() == description.lastFrame() && this->Frames[2]->value() == 1;
  if (!allFrames)
  {
    words
      << "--frames"
      << QString("%1:%2:%3").arg(this->Frames[0]->value()).arg(this->Frames[1]->value()).arg(this->Frames[2]->value());
  }
  if (!this->OwnSize->isChecked())
  {
    words << "--size" << QString("%1x%2").arg(this->CommonSize[0]).arg(this->CommonSize[1]);
  }
  words << "--tile" << QString("%1x%2").arg(this->Tile[0]->value()).arg(this->Tile[1]->value());
  words << "--samples" << QString::number(this->Samples->value());
  if (this->Resume->isChecked())
  {
    words << "--resume";
  }
  return words;
}

QString RenderDialog::sceneFile()
{
  SceneDocument& document = this->State.document();
  if (!document.modified() && !document.path().empty())
  {
    return toText(document.path());
  }
  const QByteArray target = QDir::cleanPath(QDir::current().absoluteFilePath(this->Folder->text())).toUtf8();
  const QDir folder(QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) + "/rendered/" +
                    QString::fromLatin1(QCryptographicHash::hash(target, QCryptographicHash::Sha1).toHex().left(16)));
  folder.mkpath(".");
  const QString copy = folder.filePath("scene.json");
  document.writeCopy(QFile::encodeName(copy).toStdString());
  return copy;
}

void RenderDialog::browse()
{
  const QString folder = QFileDialog::getExistingDirectory(this, tr("Folder of the dataset"), this->Folder->text());
  if (!folder.isEmpty())
  {
    this->Folder->setText(folder);
  }
}

bool RenderDialog::mayReplace()
{
  if (this->Resume->isChecked() || !QDir(this->Folder->text()).exists("manifest.json"))
  {
    return true;
  }
  QMessageBox box(QMessageBox::Question, QStringLiteral("DGTk"),
    tr("%1 holds a finished dataset.").arg(QDir::toNativeSeparators(this->Folder->text())), QMessageBox::Cancel, this);
  box.setObjectName("replaceBox");
  box.setInformativeText(tr("Replace it by this run? Cancel to name another folder."));
  QPushButton* const replace = box.addButton(tr("Replace"), QMessageBox::DestructiveRole);
  replace->setObjectName("replace");
  box.setDefaultButton(QMessageBox::Cancel);
  box.exec();
  return box.clickedButton() == replace;
}

void RenderDialog::start()
{
  this->State.finishTyping();
  QString missing;
  const QStringList words = this->arguments({});
  if (this->Cameras->count() == 0)
  {
    missing = tr("The scene has no camera. Add one with Tools > Add camera.");
  }
  else if (words.contains("--cameras") && words[words.indexOf("--cameras") + 1].isEmpty())
  {
    missing = tr("Check at least one camera on the page Cameras.");
  }
  else if (words[words.indexOf("--layers") + 1].isEmpty())
  {
    missing = tr("Check at least one layer.");
  }
  else if (this->Folder->text().trimmed().isEmpty())
  {
    missing = tr("Name a folder for the dataset.");
  }
  if (!missing.isEmpty())
  {
    this->Status->setText(missing);
    return;
  }
  QString scene;
  if (this->mayReplace() && this->State.attempt([&] { scene = this->sceneFile(); }))
  {
    this->setRunning(true);
    this->Progress->setRange(0, 0);
    this->Estimate = {};
    this->Pictures.clear();
    this->Running.start();
    this->Clock->start(progressEvery);
    this->Status->setText(tr("Rendering ..."));
    emit this->noted("dgtk " + shellLine(this->arguments(scene)));
    this->Process.start(this->arguments(scene));
  }
}

void RenderDialog::takeProgress(int done, int total)
{
  this->Estimate.report(double(this->Running.elapsed()) / 1000, done, total);
  this->Pictures = tr("%1 of %2 pictures").arg(done).arg(total);
}

void RenderDialog::showProgress()
{
  if (this->Pictures.isEmpty())
  {
    return; // the models are being read
  }
  const double now = double(this->Running.elapsed()) / 1000;
  this->Progress->setRange(0, progressSteps);
  this->Progress->setValue(int(progressSteps * this->Estimate.fractionAt(now)));
  const std::optional<double> left = this->Estimate.secondsLeftAt(now);
  this->Status->setText(left ? tr("%1, %2 left").arg(this->Pictures, durationText(*left)) : this->Pictures);
}

void RenderDialog::finish(bool ok, bool cancelled, const QString& message)
{
  this->setRunning(false);
  this->Clock->stop();
  this->Progress->setRange(0, 1);
  this->Progress->setValue(ok ? 1 : 0);
  this->Resume->setChecked(cancelled);
  this->Status->setText(cancelled ? tr("Stopped. Start goes on where it stopped.") : message);
  if (!ok && !cancelled)
  {
    emit this->State.failed(message);
  }
}

void RenderDialog::setRunning(bool on)
{
  this->Tabs->setEnabled(!on);
  this->Folder->setEnabled(!on); // the result is there
  this->Browse->setEnabled(!on);
  this->Start->setEnabled(!on);
  this->Cancel->setEnabled(on);
  const bool there = !on && QDir(this->Folder->text()).exists("manifest.json");
  this->Open->setEnabled(there);
  this->Result->setEnabled(there);
}

void RenderDialog::reject()
{
  // The window goes, the run goes on; the dialog shows it when it comes back.
  this->hide();
}

} // namespace dgtk
