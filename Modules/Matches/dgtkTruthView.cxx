// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTruthView.h"

#include "dgtkEditorLanguage.h"
#include "dgtkStage.h"
#include "dgtkTruthPanel.h"
#include "dgtkTruthPicture.h"

#include <QAction>
#include <QActionGroup>
#include <QComboBox>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QMouseEvent>
#include <QTimer>

#include <algorithm>
#include <cmath>
#include <exception>

namespace dgtk
{

namespace
{
constexpr const char* noisyDepth = "depth_noisy";
} // namespace

TruthView::TruthView(EditorState& state, SceneViews& views, QObject* parent)
  : QObject(parent)
  , State(state)
  , Views(views)
  , View3D(views.view(ViewKind::Perspective))
  , Picture(new TruthPicture(this->View3D))
  , Panel(new TruthPanel(nullptr))
  , Choice(new QComboBox)
  , Subject(new QLabel)
  , Group(new QActionGroup(this))
{
  QHBoxLayout* const title = views.title(ViewKind::Perspective);
  this->Subject->setObjectName("truthSubject");
  this->Subject->setTextFormat(Qt::PlainText);
  this->Choice->setObjectName("truthLayer");
  this->Choice->setToolTip(tr("What the perspective view shows"));
  this->Choice->addItem(tr("Colour"), QString());
  for (const LiveLayer& layer : liveLayers())
  {
    this->Choice->addItem(layerText(layer.name), toText(layer.name));
    this->Choice->setItemData(this->Choice->count() - 1, toText(layer.description), Qt::ToolTipRole);
  }
  title->addSpacing(8);
  title->addWidget(this->Subject);
  title->addStretch(1);
  title->addWidget(this->Choice);
  connect(this->Choice, QOverload<int>::of(&QComboBox::activated), this,
    [this](int index) { this->setLayer(this->Choice->itemData(index).toString()); });
  connect(&state, &EditorState::changed, this,
    [this]
    {
      this->Scene.reset();
      if (const std::size_t opened = this->State.document().opened(); opened != this->Opened)
      {
        this->Before.reset(); // its models are nobody's any more
        this->Opened = opened;
      }
      const bool listed = this->isListed();
      if (this->Listed && !listed)
      {
        this->Through.reset();
      }
      this->Listed = listed;
      this->showSubject();
      this->seeAnew();
    });
  connect(&state, &EditorState::frameChanged, this, &TruthView::seeAnew);
  connect(this->View3D, &SceneView::cameraMoved, this, &TruthView::leaveCamera);
  connect(&views, &SceneViews::lookedThrough, this, &TruthView::lookThrough);
  this->View3D->installEventFilter(this);
  this->View3D->setMouseTracking(true);
}

TruthView::~TruthView() = default;

void TruthView::fillMenu(QMenu* menu)
{
  for (int i = 0; i < this->Choice->count(); ++i)
  {
    const QString layer = this->Choice->itemData(i).toString();
    QAction* const action = this->Group->addAction(menu->addAction(this->Choice->itemText(i)));
    action->setObjectName("show." + (layer.isEmpty() ? QStringLiteral("colour") : layer));
    action->setData(layer);
    action->setCheckable(true);
    action->setChecked(layer == this->Layer);
    action->setStatusTip(this->Choice->itemData(i, Qt::ToolTipRole).toString());
    if (i < 10)
    {
      action->setShortcut(QKeySequence(QStringLiteral("Ctrl+%1").arg(i)));
    }
    connect(action, &QAction::triggered, this, [this, layer] { this->setLayer(layer); });
  }
}

void TruthView::setLayer(const QString& layer)
{
  const bool other = layer != this->Layer;
  this->Layer = layer;
  this->Choice->setCurrentIndex(std::max(0, this->Choice->findData(layer)));
  for (QAction* action : this->Group->actions())
  {
    action->setChecked(action->data().toString() == layer);
  }
  if (other)
  {
    this->showSubject();
    emit this->layerChosen(layer);
    this->askSoon();
  }
}

void TruthView::lookThrough(const CameraDescription& camera)
{
  this->Through = camera;
  this->Listed = this->isListed();
  this->showSubject();
  this->seeAnew();
}

void TruthView::leaveCamera()
{
  this->Through.reset();
  this->showSubject();
  this->seeAnew();
}

const CameraDescription* TruthView::camera() const
{
  if (!this->Through)
  {
    return nullptr;
  }
  // As it is now, when it belongs to the scene.
  for (const CameraDescription& camera : this->State.scene().cameras)
  {
    if (camera.name == this->Through->name)
    {
      return &camera;
    }
  }
  return &*this->Through;
}

bool TruthView::isListed() const { return this->Through && this->camera() != &*this->Through; }

QString TruthView::shown() const { return this->Through && this->Layer.isEmpty() ? QString(draftLayer) : this->Layer; }

void TruthView::showSubject()
{
  const QString shown = this->shown();
  if (shown != this->Covering)
  {
    this->Covering = shown;
    this->Picture->forgetPicture();
    this->Picture->setGeometry(this->View3D->rect());
    this->Picture->setVisible(!shown.isEmpty());
    this->View3D->setCovered(!shown.isEmpty());
  }
  // Values of a box that stands for a model are nobody's.
  this->View3D->showDraft(shown.isEmpty() || shown == draftLayer || !this->State.document().absent().empty());
  this->View3D->setPictureRays(
    this->Through ? [this](const QPoint& position) { return this->rayAt(position); } : SceneView::PictureRays());
  this->Subject->setText(this->Through ? tr("through camera %1").arg(toText(this->Through->name)) : QString());
}

std::optional<LiveQuestion> TruthView::question()
{
  if (!this->View3D->isVisible() || this->View3D->width() < 2 || this->View3D->height() < 2)
  {
    return std::nullopt;
  }
  if (!this->Scene)
  {
    this->Scene = std::make_shared<LiveScene>(this->State.scene(), this->State.document().models(), this->Before.get());
    this->Before = this->Scene;
  }
  LiveQuestion question;
  question.scene = this->Scene;
  question.frame = this->State.frame();
  if (const CameraDescription* const camera = this->camera())
  {
    question.camera = *camera;
    const View view = viewOf(question);
    const CameraModel& model = *view.model;
    question.finest =
      std::max(1, std::max(model.width() / this->View3D->width(), model.height() / this->View3D->height()));
  }
  else
  {
    question.camera = liveCamera(this->View3D->camera(), this->Views.places().box);
    question.width = this->View3D->width();
    question.height = this->View3D->height();
  }
  return question;
}

void TruthView::seeAnew()
{
  if (!this->Mouse)
  {
    this->Panel->forgetTruth();
  }
  this->askSoon();
}

void TruthView::askSoon()
{
  this->Picture->setSettled(false);
  if (!this->AskWanted)
  {
    this->AskWanted = true;
    QTimer::singleShot(0, this,
      [this]
      {
        this->AskWanted = false;
        this->ask();
      });
  }
}

void TruthView::ask()
{
  const int number = ++this->Asked;
  try
  {
    if (!this->shown().isEmpty())
    {
      if (const std::optional<LiveQuestion> asked = this->question())
      {
        const View view = viewOf(*asked);
        const CameraModel& model = *view.model;
        this->Truth.askPicture(*asked, this->shown().toStdString(),
          [this, layer = this->shown(), size = QSize(model.width(), model.height()), number](const LivePicture& picture)
          {
            QMetaObject::invokeMethod(
              this, [this, picture, layer, size, number] { this->receive(picture, layer, size, number); },
              Qt::QueuedConnection);
          });
      }
    }
    if (this->Mouse)
    {
      this->askPixel(*this->Mouse);
    }
  }
  catch (const std::exception& error)
  {
    LivePicture none;
    none.message = error.what();
    this->receive(none, this->shown(), {}, number);
  }
}

void TruthView::receive(const LivePicture& picture, const QString& layer, const QSize& size, int number)
{
  if (layer != this->shown())
  {
    return;
  }
  QString caption = layer == draftLayer ? tr("the picture, one sample a pixel") : layer;
  if (!picture.message.empty())
  {
    caption += ": " + messageText(picture.message);
  }
  else if (picture.least <= picture.most)
  {
    const bool nearBright = picture.meaning == Meaning::Depth || picture.meaning == Meaning::Distance;
    const double ends[2] = { picture.least, picture.most };
    caption = tr("%1: %2 (bright) to %3 (dark)")
                .arg(layer)
                .arg(ends[nearBright ? 0 : 1], 0, 'g', 5)
                .arg(ends[nearBright ? 1 : 0], 0, 'g', 5);
  }
  else if (picture.meaning == Meaning::Depth && !picture.picture.pixels.empty())
  {
    caption += ": " + (layer == noisyDepth ? tr("all is out of the range of the depth sensor") : tr("nothing is seen"));
  }
  else if (picture.picture.longest > 0)
  {
    caption = tr("%1: full colour at %2 pixels").arg(layer).arg(picture.picture.longest, 0, 'g', 3);
  }
  this->Picture->showPicture(picture, size, caption);
  this->Picture->setSettled(number == this->Asked && !this->AskWanted && picture.coarseness == 1);
}

std::optional<QPoint> TruthView::pixelAt(const QPoint& position, const CameraModel& model) const
{
  const QRectF place = TruthPicture::fitted({ model.width(), model.height() }, this->View3D->size());
  const double scale = model.width() / place.width();
  const int column = static_cast<int>(std::floor((position.x() + 0.5 - place.left()) * scale));
  const int row = static_cast<int>(std::floor((position.y() + 0.5 - place.top()) * scale));
  const bool inside = column >= 0 && row >= 0 && column < model.width() && row < model.height();
  return inside ? std::make_optional(QPoint(column, row)) : std::nullopt;
}

std::optional<WorldRay> TruthView::rayAt(const QPoint& position)
{
  try
  {
    const std::optional<LiveQuestion> asked = this->question();
    const View view = asked ? viewOf(*asked) : View();
    const std::optional<QPoint> pixel = asked ? this->pixelAt(position, *view.model) : std::nullopt;
    if (!pixel)
    {
      return std::nullopt;
    }
    const Eigen::Vector2d centre(pixel->x() + 0.5, pixel->y() + 0.5);
    const CameraRay ray = view.model->rayThrough(centre);
    if (!ray.exists())
    {
      return std::nullopt;
    }
    const double time = asked->frame + view.model->timeAt(centre);
    const View then = cameraView(asked->camera, time, asked->width, asked->height, asked->scene->description().folder);
    const Rigid3 world_from_camera = then.camera_from_world.inverse();
    return WorldRay{ world_from_camera * ray.origin, world_from_camera.rotation * ray.direction, view.near, view.far };
  }
  catch (const std::exception&)
  {
    return std::nullopt; // the picture says what is wrong
  }
}

void TruthView::askPixel(const QPoint& position)
{
  this->Mouse = position;
  if (!this->Panel->isVisible() && this->shown().isEmpty())
  {
    return;
  }
  const std::optional<LiveQuestion> asked = this->question();
  if (!asked)
  {
    return;
  }
  const std::optional<QPoint> pixel = this->pixelAt(position, *viewOf(*asked).model);
  if (!pixel)
  {
    return;
  }
  this->Truth.askPixel(*asked, pixel->x(), pixel->y(),
    [this](const PixelTruth& truth)
    {
      QMetaObject::invokeMethod(
        this, [this, truth] { this->receive(truth); }, Qt::QueuedConnection);
    });
}

void TruthView::receive(const PixelTruth& truth)
{
  if (!this->Mouse)
  {
    return;
  }
  this->Panel->showTruth(this->camera() != nullptr ? toText(this->Through->name) : tr("Perspective"), truth,
    toText(this->State.scene().units));
  QString line = tr("(%1, %2)").arg(truth.column).arg(truth.row);
  if (!truth.object.empty())
  {
    line += ' ' + toText(truth.object);
    bool depthSaid = false; // the exact one comes first
    for (const PixelValue& value : truth.values)
    {
      const QString name = toText(value.name);
      const bool depth = value.spec.meaning == Meaning::Depth && !depthSaid;
      depthSaid = depthSaid || depth;
      if (depth || toText(value.spec.name) == this->Layer)
      {
        line += QStringLiteral("  %1 %2").arg(name, exactText(value, QStringLiteral(", ")));
      }
    }
  }
  emit this->pointed(line);
}

bool TruthView::eventFilter(QObject* object, QEvent* event)
{
  switch (event->type())
  {
    case QEvent::Resize:
      this->Picture->setGeometry(this->View3D->rect());
      this->seeAnew();
      break;
    case QEvent::Show:
      this->askSoon();
      break;
    case QEvent::MouseMove:
      try
      {
        this->askPixel(static_cast<QMouseEvent*>(event)->pos());
      }
      catch (const std::exception&)
      {
        this->Mouse.reset(); // the picture says what is wrong
      }
      break;
    case QEvent::Leave:
      this->Mouse.reset(); // the values stay, to be copied
      emit this->pointed({});
      break;
    default:
      break;
  }
  return QObject::eventFilter(object, event);
}

} // namespace dgtk
