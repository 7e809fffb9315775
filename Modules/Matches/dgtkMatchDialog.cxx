// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMatchDialog.h"

#include "dgtkFile.h"
#include "dgtkMatchPane.h"
#include "dgtkNamedFile.h"
#include "dgtkSaveName.h"

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QFileDialog>
#include <QLabel>
#include <QMessageBox>
#include <QPushButton>
#include <QShowEvent>
#include <QSignalBlocker>
#include <QSpinBox>

#include <algorithm>
#include <cmath>
#include <exception>

namespace dgtk
{

namespace
{
bool isSame(const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  return (a.array() == b.array() || (a.array().isNaN() && b.array().isNaN())).all();
}

/// Nothing where the scene has no such view.
std::optional<MatchView> viewIn(const SceneDescription& scene, const SparseView& view)
{
  for (const CameraDescription& camera : scene.cameras)
  {
    if (camera.name == view.camera)
    {
      const MatchView found{ cameraView(camera, view.frame, 0, 0, scene.folder), view.frame };
      const CameraModel& model = *found.view.model;
      return model.width() == view.width && model.height() == view.height ? std::make_optional(found) : std::nullopt;
    }
  }
  return std::nullopt;
}

/// Whether the scene has the pair as the list has it.
bool isStillThere(const LiveScene& scene, const MatchRow& pair)
{
  try
  {
    const std::optional<MatchView> from = viewIn(scene.description(), pair.from);
    const std::optional<MatchView> to = viewIn(scene.description(), pair.to);
    const LiveMatch now = from && to ? liveMatch(scene, *from, pair.match.from, *to) : LiveMatch();
    return from && to && isSame(now.to.pixel, pair.match.to.pixel) && now.to.visibility == pair.match.to.visibility &&
           now.hit.object == pair.match.hit.object && toText(now.object) == pair.object;
  }
  catch (const std::exception&) // a point outside the image, a camera without a pose
  {
    return false;
  }
}
} // namespace

MatchDialog::~MatchDialog() = default;

void MatchDialog::showEvent(QShowEvent* event)
{
  QDialog::showEvent(event);
  this->refresh();
  if (!event->spontaneous())
  {
    this->chooseSelected();
  }
}

/// The first selected camera at left, the second at right; one alone keeps the other side, if that is another camera.
void MatchDialog::chooseSelected()
{
  std::vector<int> chosen;
  for (const SceneItem& item : this->State.selection())
  {
    if (item.kind == SceneItem::Kind::Camera && chosen.size() < 2)
    {
      chosen.push_back(int(item.index));
    }
  }
  if (chosen.empty())
  {
    return;
  }
  if (chosen.size() == 1)
  {
    const int cameras = this->Sides[1].camera->count();
    const int right = this->Sides[1].camera->currentIndex();
    chosen.push_back(right != chosen[0] ? right : (right + 1) % cameras);
  }
  for (std::size_t i = 0; i < 2; ++i)
  {
    this->Sides[i].camera->setCurrentIndex(chosen[i]);
  }
}

void MatchDialog::refresh()
{
  if (!this->isVisible())
  {
    return;
  }
  if (this->Changed)
  {
    this->Changed = false;
    this->Scene = std::make_shared<LiveScene>(this->State.scene(), this->State.document().models(), this->Scene.get());
    this->refreshCameras();
    this->showView(0);
    this->showView(1);
    this->refreshButtons();
    this->checkPairs();
  }
}

void MatchDialog::refreshCameras()
{
  const SceneDescription& scene = this->Scene->description();
  for (std::size_t i = 0; i < 2; ++i)
  {
    Side& side = this->Sides[i];
    const QSignalBlocker still(side.camera);
    const QSignalBlocker stillFrame(side.frame);
    const QString chosen = side.camera->currentText();
    const bool first = side.camera->count() == 0;
    side.camera->clear();
    for (const CameraDescription& camera : scene.cameras)
    {
      side.camera->addItem(toText(camera.name));
    }
    const int found = side.camera->findText(chosen);
    const int usual = std::min(int(i), side.camera->count() - 1);
    side.camera->setCurrentIndex(first || found < 0 ? usual : found);
    side.frame->setRange(this->Scene->firstFrame(), this->Scene->lastFrame());
    if (first)
    {
      side.frame->setValue(this->State.frame());
    }
  }
}

void MatchDialog::showView(std::size_t index)
{
  Side& side = this->Sides[index];
  side.view.reset();
  const int camera = this->Scene ? side.camera->currentIndex() : -1;
  if (camera < 0)
  {
    side.pane->setImageSize({ 640, 480 });
    side.pane->setMessage(
      tr("The scene has no cameras yet. Tools > Add camera array > Stereo pair makes two that see the same."));
  }
  else
  {
    try
    {
      const int frame = side.frame->value();
      const SceneDescription& scene = this->Scene->description();
      const View view = cameraView(scene.cameras[std::size_t(camera)], frame, 0, 0, scene.folder);
      side.view = MatchView{ view, frame };
      side.pane->setImageSize({ view.model->width(), view.model->height() });
      side.pane->setMessage({});
      this->askPicture(index);
    }
    catch (const std::exception& error)
    {
      side.pane->setImageSize({ 640, 480 });
      side.pane->setMessage(QString::fromUtf8(error.what()));
    }
  }
  this->askMatch();
}

void MatchDialog::askPicture(std::size_t index)
{
  Side& side = this->Sides[index];
  if (!side.view || !this->Scene)
  {
    return;
  }
  LiveQuestion question;
  question.scene = this->Scene;
  question.frame = side.view->frame;
  question.camera = this->Scene->description().cameras[std::size_t(side.camera->currentIndex())];
  const QString layer = this->Layer->currentData().toString();
  side.pane->findChild<QLabel*>("draft")->setVisible(layer == draftLayer);
  side.truth->askPicture(question, layer.toStdString(),
    [this, index, name = side.view->view.name, frame = question.frame](const LivePicture& picture)
    {
      const auto show = [this, index, name, frame, picture]
      {
        const Side& its = this->Sides[index];
        if (its.view && its.view->view.name == name && its.view->frame == frame)
        {
          its.pane->setPicture(picture);
        }
      };
      QMetaObject::invokeMethod(this, show, Qt::QueuedConnection);
    });
}

void MatchDialog::pick(std::size_t side, const Eigen::Vector2d& pixel)
{
  if (!this->Sides[side].view)
  {
    return;
  }
  const CameraModel& model = *this->Sides[side].view->view.model;
  Eigen::Vector2d point(
    std::clamp(pixel.x(), 0.0, double(model.width())), std::clamp(pixel.y(), 0.0, double(model.height())));
  if (this->Centers->isChecked())
  {
    point.x() = std::min(std::floor(point.x()), model.width() - 1.0) + 0.5;
    point.y() = std::min(std::floor(point.y()), model.height() - 1.0) + 0.5;
  }
  this->Active = Point{ side, point };
  this->askMatch();
}

void MatchDialog::move(std::size_t side, const Eigen::Vector2d& step)
{
  if (this->Active && this->Active->side == side)
  {
    const Eigen::Vector2d target = this->Active->pixel + step;
    if (step.cwiseAbs().maxCoeff() < 1)
    {
      this->Centers->setChecked(false);
    }
    this->pick(side, target);
  }
}

void MatchDialog::askMatch()
{
  this->Match.reset();
  if (this->Active)
  {
    const std::optional<MatchView>& view = this->Sides[this->Active->side].view;
    const bool inside = view && this->Active->pixel.x() <= view->view.model->width() &&
                        this->Active->pixel.y() <= view->view.model->height();
    if (!inside)
    {
      this->Active.reset();
    }
  }
  this->showMatch();
  if (!this->Scene || !this->Active || !this->Sides[0].view || !this->Sides[1].view)
  {
    return;
  }
  const Point point = *this->Active;
  this->Matcher.start(
    [this, scene = this->Scene, point, from = *this->Sides[point.side].view, to = *this->Sides[1 - point.side].view](
      const NewestTask::Outdated& outdated)
    {
      LiveMatch match;
      try
      {
        match = liveMatch(*scene, from, point.pixel, to);
      }
      catch (const std::exception& error)
      {
        match.message = error.what();
      }
      if (!outdated())
      {
        QMetaObject::invokeMethod(
          this, [this, point, match] { this->receive(point, match); }, Qt::QueuedConnection);
      }
    });
}

void MatchDialog::receive(const Point& point, const LiveMatch& match)
{
  if (this->Active && this->Active->side == point.side && this->Active->pixel == point.pixel)
  {
    this->Match = match;
    this->showMatch();
  }
}

SparseView MatchDialog::sparseView(std::size_t index) const
{
  const Side& side = this->Sides[index];
  if (!side.view)
  {
    return {};
  }
  return { side.view->view.name, side.view->frame, side.view->view.model->width(), side.view->view.model->height() };
}

void MatchDialog::showPair(int row)
{
  if (row < 0 || row >= int(this->Table->pairs().size()))
  {
    return;
  }
  const MatchRow pair = this->Table->pairs()[std::size_t(row)];
  const std::size_t side = pair.from == this->sparseView(1) && pair.to == this->sparseView(0) ? 1 : 0;
  const SparseView* const wanted[2] = { &pair.from, &pair.to };
  for (std::size_t i = 0; i < 2; ++i)
  {
    Side& its = this->Sides[i == 0 ? side : 1 - side];
    const int camera = its.camera->findText(toText(wanted[i]->camera));
    if (camera >= 0)
    {
      its.camera->setCurrentIndex(camera);
      its.frame->setValue(wanted[i]->frame);
    }
  }
  for (std::size_t i = 0; i < 2; ++i)
  {
    const SparseView& view = *wanted[i];
    if (!(this->sparseView(i == 0 ? side : 1 - side) == view))
    {
      this->Active.reset();
      this->askMatch();
      this->findChild<QLabel*>("match.from")
        ->setText(tr("The scene has no view of %1, frame %2, with %3 x %4 pixels.")
                    .arg(toText(view.camera), QString::number(view.frame), QString::number(view.width),
                      QString::number(view.height)));
      return;
    }
  }
  const bool centers = this->Centers->isChecked();
  this->Centers->setChecked(false);
  this->pick(side, pair.match.from);
  this->Centers->setChecked(centers);
}

void MatchDialog::checkPairs()
{
  const std::size_t check = ++this->Checks;
  if (!this->Scene || this->Table->pairs().empty())
  {
    return;
  }
  this->Checker.start(
    [this, check, scene = this->Scene, pairs = this->Table->pairs()](const NewestTask::Outdated& outdated)
    {
      std::vector<bool> marks;
      for (auto pair = pairs.begin(); pair != pairs.end() && !outdated(); ++pair)
      {
        marks.push_back(!isStillThere(*scene, *pair));
      }
      const auto show = [this, check, marks]
      {
        if (check == this->Checks)
        {
          this->Table->mark(marks);
        }
      };
      if (marks.size() == pairs.size())
      {
        QMetaObject::invokeMethod(this, show, Qt::QueuedConnection);
      }
    });
}

void MatchDialog::swapSides()
{
  const int cameras[2] = { this->Sides[0].camera->currentIndex(), this->Sides[1].camera->currentIndex() };
  const int frames[2] = { this->Sides[0].frame->value(), this->Sides[1].frame->value() };
  const bool chosen = this->Active.has_value();
  const Point active = this->Active.value_or(Point{});
  for (std::size_t i = 0; i < 2; ++i)
  {
    const QSignalBlocker stillCamera(this->Sides[i].camera);
    const QSignalBlocker stillFrame(this->Sides[i].frame);
    this->Sides[i].camera->setCurrentIndex(cameras[1 - i]);
    this->Sides[i].frame->setValue(frames[1 - i]);
  }
  this->Active.reset();
  this->showView(0);
  this->showView(1);
  if (chosen)
  {
    this->Active = Point{ 1 - active.side, active.pixel };
    this->askMatch();
  }
}

bool MatchDialog::openPairs(const QString& path)
{
  return this->State.attempt(
    [&]
    {
      const bool empty = this->Table->pairs().empty();
      const std::vector<std::string> names = this->Scene ? this->Scene->objectNames() : std::vector<std::string>();
      std::vector<MatchRow> rows;
      const std::vector<SparseSet> sets = parseSparseText(readFile(path.toStdString()), path.toStdString());
      for (const SparseSet& set : sets)
      {
        // A list without names of views is of those that are shown.
        const bool named = !set.from.camera.empty() && !set.to.camera.empty();
        for (const SparseMatch& match : set.matches)
        {
          const std::uint32_t id = match.hit.object;
          const QString object = id == 0 ? QString() : id <= names.size() ? toText(names[id - 1]) : tr("id %1").arg(id);
          rows.push_back(
            { named ? set.from : this->sparseView(0), named ? set.to : this->sparseView(1), match, object });
        }
      }
      this->Table->add(rows);
      this->Saved = empty ? this->Table->text() : std::string();
    });
}

bool MatchDialog::savePairs(const QString& path)
{
  return this->State.attempt(
    [&]
    {
      const std::string text = this->Table->text();
      writeNamedFile(path.toStdString(), text);
      this->Saved = text;
    });
}

bool MatchDialog::mayDiscard()
{
  if (this->Table->pairs().empty() || this->Table->text() == this->Saved)
  {
    return true;
  }
  QMessageBox box(QMessageBox::Question, QStringLiteral("DGTk"), tr("The list of correspondences is not saved."),
    QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, this);
  box.setObjectName("unsavedPairsBox");
  box.setDefaultButton(QMessageBox::Save);
  const int choice = box.exec();
  return choice == QMessageBox::Discard || (choice == QMessageBox::Save && this->askSave());
}

void MatchDialog::askOpen()
{
  const QString path =
    QFileDialog::getOpenFileName(this, tr("Open correspondences"), {}, tr("Correspondences (*.txt);;All files (*)"));
  if (!path.isEmpty())
  {
    this->openPairs(path);
  }
}

bool MatchDialog::askSave()
{
  const QString path = askSaveName(this, tr("Save correspondences"), {}, tr("Correspondences (*.txt)"));
  return !path.isEmpty() && this->savePairs(path);
}

void MatchDialog::refreshButtons()
{
  const bool any = !this->Table->pairs().empty();
  this->findChild<QPushButton*>("addPair")->setEnabled(
    this->Match && this->Match->message.empty() && this->Match->hit.object != 0);
  this->findChild<QPushButton*>("deletePairs")->setEnabled(!this->Table->selectedItems().isEmpty());
  this->findChild<QPushButton*>("clearPairs")->setEnabled(any);
  this->findChild<QPushButton*>("savePairs")->setEnabled(any);
  this->findChild<QAction*>("undoPairs")->setEnabled(this->Table->canUndo());
  this->findChild<QAction*>("redoPairs")->setEnabled(this->Table->canRedo());
}

} // namespace dgtk
