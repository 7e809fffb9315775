// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRenderDialog.h"

#include "dgtkRenderCameras.h"
#include "dgtkUsualFolder.h"
#include "dgtkWindowSize.h"

#include <QCheckBox>
#include <QCryptographicHash>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QProgressBar>
#include <QPushButton>
#include <QSettings>
#include <QSize>
#include <QSpinBox>
#include <QStandardPaths>
#include <QTabWidget>
#include <QTimer>
#include <QVBoxLayout>

#include <algorithm>
#include <optional>

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
  this->Tabs->addTab(this->makeControls(), tr("Controls"));
  this->Tabs->setCurrentIndex(2);
  layout->addWidget(this->Tabs, 1);
  this->makeRunRow(layout);
  resizeWithin(*this, 640, 724);

  connect(&state, &EditorState::changed, this, &RenderDialog::refresh);
  connect(&state, &EditorState::selectionChanged, this, &RenderDialog::showMatte);
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
  const bool blurs = std::any_of(scene.cameras.begin(), scene.cameras.end(),
    [](const CameraDescription& camera) { return camera.shutter.blurs() || camera.lens.blurs(); });
  this->layerBox("color_sharp")->setEnabled(blurs); // it is of such cameras only
  this->showMatte();
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

void RenderDialog::showMatte()
{
  this->Matte->setEnabled(this->layerBox("matting")->isChecked());
  if (this->Matte->isModified())
  {
    return;
  }
  const SceneDescription& scene = this->State.scene();
  QStringList names;
  for (const SceneItem& item : this->State.selection())
  {
    if (item.kind == SceneItem::Kind::Object && item.index < scene.objects.size())
    {
      names << toText(scene.objects[item.index].name);
    }
  }
  this->Matte->setText(names.join(','));
}

QStringList RenderDialog::arguments(const QString& scene) const
{
  const QStringList cameras = this->Cameras->checked();
  QStringList words{ "render", scene, "-o", this->Folder->text(), "--layers", this->checkedLayers().join(',') };
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
  if (const std::optional<QSize> size = this->Cameras->commonSize())
  {
    words << "--size" << QString("%1x%2").arg(size->width()).arg(size->height());
  }
  if (this->layerBox("matting")->isChecked())
  {
    words << "--matte" << this->Matte->text();
  }
  words << "--tile" << QString("%1x%2").arg(this->Tile[0]->value()).arg(this->Tile[1]->value());
  words << "--samples" << QString::number(this->Samples->value());
  if (this->Resume->isChecked())
  {
    words << "--resume";
  }
  else if (QDir(this->Folder->text()).exists("manifest.json"))
  {
    words << "--replace"; // it has been asked for
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
  box.setObjectName("replaceDatasetBox");
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
  else if (this->layerBox("matting")->isChecked() && this->Matte->text().trimmed().isEmpty())
  {
    missing = tr("Name the objects of the layer matting, or uncheck it.");
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
    this->rememberChoices();
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

void RenderDialog::rememberChoices() const
{
  QSettings settings;
  settings.setValue("render/layers", this->checkedLayers());
  settings.setValue("render/tile", QSize(this->Tile[0]->value(), this->Tile[1]->value()));
  settings.setValue("render/samples", this->Samples->value());
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
  this->Progress->setRange(0, progressSteps);
  this->Progress->setValue(int(progressSteps * this->Estimate.fractionAt(now)));
  const std::optional<double> left = this->Estimate.secondsLeftAt(now);
  this->Status->setText(left ? tr("%1, %2 left").arg(this->Pictures, durationText(*left)) : this->Pictures);
}

void RenderDialog::cancel()
{
  this->Process.cancel();
  this->showProgress();
}

void RenderDialog::finish(bool ok, bool cancelled, const QString& message)
{
  this->setRunning(false);
  this->Clock->stop();
  this->Progress->setRange(0, 1);
  this->Progress->setValue(ok ? 1 : 0);
  this->Resume->setChecked(cancelled);
  if (ok)
  {
    rememberFolder(this->Folder->text(), "dataset");
  }
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
