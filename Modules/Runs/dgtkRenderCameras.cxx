// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRenderCameras.h"

#include "dgtkError.h"
#include "dgtkNumberBox.h"
#include "dgtkNumberRow.h"
#include "dgtkScenePlaces.h"
#include "dgtkStage.h"

#include <QCheckBox>
#include <QGridLayout>
#include <QLabel>
#include <QListWidget>
#include <QSignalBlocker>
#include <QSlider>
#include <QSpinBox>
#include <QVBoxLayout>

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr int largestSlider = 8192;  // sliders stay usable; the numbers go further
constexpr int spacing = 12;          // pixels
constexpr int linesOfResolution = 5; // of text
constexpr int digitsOfResolution = 6;

QString resolutionRow(const QString& where, const Eigen::Vector2d& perPixel, const QString& units)
{
  const auto cell = [&units](double value)
  { return QString("<td align='right'>%1 %2</td>").arg(QString::number(value, 'g', digitsOfResolution), units); };
  return "<tr><td>" + where + "</td>" + cell(perPixel.x()) + cell(perPixel.y()) + "</tr>";
}
} // namespace

RenderCameras::RenderCameras(EditorState& state, QWidget* parent)
  : QWidget(parent)
  , State(state)
{
  auto* layout = new QVBoxLayout(this);
  auto* caption = new QLabel(tr("&Cameras to render:"));
  layout->addWidget(caption);
  this->Cameras = new QListWidget;
  this->Cameras->setObjectName("cameras");
  caption->setBuddy(this->Cameras);
  layout->addWidget(this->Cameras, 1);

  auto* lens = new QGridLayout;
  lens->setHorizontalSpacing(spacing);
  this->FovLabel = new QLabel;
  this->Fov = this->addNumber(lens, 0, 0, this->FovLabel, "renderFov",
    [this](CameraDescription& camera, double value)
    { setTrackAt(hasParameter(camera, "viewHeight") ? camera.viewHeight : camera.fovY, this->State.frame(), value); });
  this->Aspect = this->addNumber(lens, 0, 2, new QLabel(tr("&Aspect (0: square pixels)")), "renderAspect",
    [](CameraDescription& camera, double value) { camera.aspect = value; });
  this->Near = this->addNumber(lens, 1, 0, new QLabel(tr("&Near plane")), "renderNear",
    [](CameraDescription& camera, double value) { camera.near = value; });
  this->Far = this->addNumber(lens, 1, 2, new QLabel(tr("Fa&r plane")), "renderFar",
    [](CameraDescription& camera, double value) { camera.far = value; });
  layout->addLayout(lens);

  this->OwnSize = new QCheckBox(tr("&Every camera in its own size: that of the chosen one is"));
  this->OwnSize->setObjectName("ownSize");
  this->OwnSize->setChecked(true);
  layout->addWidget(this->OwnSize);
  auto* grid = new QGridLayout;
  this->addSizeRow(grid, 0, tr("Image &width"), "width", 0);
  this->addSizeRow(grid, 1, tr("Image &height"), "height", 1);
  layout->addLayout(grid);
  this->Resolution = new QLabel;
  this->Resolution->setObjectName("resolution");
  this->Resolution->setWordWrap(true);
  this->Resolution->setTextInteractionFlags(Qt::TextSelectableByMouse);
  this->Resolution->setMinimumHeight(linesOfResolution * this->fontMetrics().lineSpacing());
  layout->addWidget(this->Resolution);

  connect(this->OwnSize, &QCheckBox::toggled, this, &RenderCameras::showCamera);
  connect(this->Cameras, &QListWidget::currentRowChanged, this,
    [this]
    {
      this->State.document().finishMerging();
      for (NumberRow* field : { this->Fov, this->Aspect, this->Near, this->Far })
      {
        field->forget(); // what stayed as no number was for another camera
      }
      for (QSpinBox* size : this->Size)
      {
        dynamic_cast<TypedNumber&>(*size).forget();
      }
      this->showCamera();
    });
  connect(&state, &EditorState::changed, this, &RenderCameras::refresh);
  connect(&state, &EditorState::frameChanged, this, &RenderCameras::showCamera);
  connect(&state, &EditorState::typingEnds, this, [this] { (void)commitRows(*this); });
  this->refresh();
}

NumberRow* RenderCameras::addNumber(QGridLayout* grid, int row, int column, QLabel* label, const QString& name,
  const std::function<void(CameraDescription&, double)>& set)
{
  auto* field = new NumberRow(name, 1, this);
  label->setBuddy(field);
  grid->addWidget(label, row, column);
  grid->addWidget(field, row, column + 1);
  field->onEdit(
    [this, set](const std::vector<double>& value)
    {
      if (this->chosen() != nullptr)
      {
        const SceneItem item = this->chosenItem();
        this->State.attempt(
          [&]
          {
            this->State.document().editItem(
              "Change the lens", item, [&](SceneDescription& scene) { set(scene.cameras[item.index], value[0]); });
          });
      }
      this->showCamera(); // also what a refusal leaves
    });
  return field;
}

void RenderCameras::addSizeRow(QGridLayout* grid, int row, const QString& label, const QString& name, int axis)
{
  this->Sliders[axis] = new QSlider(Qt::Horizontal);
  this->Sliders[axis]->setRange(1, largestSlider);
  this->Sliders[axis]->setPageStep(64);
  this->Size[axis] = makeNumber(name, 1, largestImage, usualImageSize[axis]);
  this->Sliders[axis]->setValue(this->Size[axis]->value());
  auto* caption = new QLabel(label);
  caption->setBuddy(this->Size[axis]);
  grid->addWidget(caption, row, 0);
  grid->addWidget(this->Sliders[axis], row, 1);
  grid->addWidget(this->Size[axis], row, 2);
  connect(this->Sliders[axis], &QSlider::valueChanged, this->Size[axis], &QSpinBox::setValue);
  connect(this->Size[axis], QOverload<int>::of(&QSpinBox::valueChanged), this,
    [this, axis](int value)
    {
      const QSignalBlocker quiet(this->Sliders[axis]);
      this->Sliders[axis]->setValue(std::min(value, largestSlider));
      this->takeSize();
    });
}

int RenderCameras::count() const { return this->Cameras->count(); }

QStringList RenderCameras::checked() const
{
  QStringList names;
  for (int i = 0; i < this->Cameras->count(); ++i)
  {
    if (this->Cameras->item(i)->checkState() == Qt::Checked)
    {
      names << this->Cameras->item(i)->text();
    }
  }
  return names;
}

std::optional<QSize> RenderCameras::commonSize() const
{
  return this->OwnSize->isChecked() ? std::nullopt
                                    : std::make_optional(QSize(this->CommonSize[0], this->CommonSize[1]));
}

const CameraDescription* RenderCameras::chosen() const
{
  const std::vector<CameraDescription>& cameras = this->State.scene().cameras;
  const int row = this->Cameras->currentRow();
  return row < 0 || row >= int(cameras.size()) ? nullptr : &cameras[std::size_t(row)];
}

SceneItem RenderCameras::chosenItem() const
{
  return { SceneItem::Kind::Camera, std::size_t(this->Cameras->currentRow()) };
}

void RenderCameras::refresh()
{
  const QStringList checkedBefore = this->checked();
  QStringList before;
  for (int i = 0; i < this->Cameras->count(); ++i)
  {
    before << this->Cameras->item(i)->text();
  }
  const int row = this->Cameras->currentRow();
  {
    const QSignalBlocker quiet(this->Cameras);
    this->Cameras->clear();
    for (const CameraDescription& camera : this->State.scene().cameras)
    {
      auto* item = new QListWidgetItem(toText(camera.name), this->Cameras);
      item->setFlags(item->flags() | Qt::ItemIsUserCheckable);
      const bool left = before.contains(item->text()) && !checkedBefore.contains(item->text());
      item->setCheckState(left ? Qt::Unchecked : Qt::Checked);
    }
    this->Cameras->setCurrentRow(std::max(0, std::min(row, this->Cameras->count() - 1)));
  }
  this->showCamera();
}

void RenderCameras::showCamera()
{
  this->showLens();
  this->showSize();
  this->showResolution();
}

void RenderCameras::showLens()
{
  const CameraDescription* const camera = this->chosen();
  const bool parallel = camera != nullptr && hasParameter(*camera, "viewHeight");
  const bool byMatrix = camera != nullptr && camera->K.has_value();
  this->FovLabel->setText(parallel ? tr("&View height") : tr("Field of &view, \u00b0 (vertical)"));
  for (NumberRow* field : { this->Fov, this->Aspect, this->Near, this->Far })
  {
    field->setEnabled(camera != nullptr);
  }
  // The matrix says them.
  const auto has = [&](const char* name) { return camera != nullptr && !byMatrix && hasParameter(*camera, name); };
  this->Fov->setEnabled(has("fovY") || has("viewHeight"));
  this->Aspect->setEnabled(has("aspect"));
  if (camera == nullptr)
  {
    return;
  }
  const int frame = this->State.frame();
  this->Fov->setValues({ byMatrix   ? fieldOfViewOf(*camera).value_or(0)
                         : parallel ? boundedAt(camera->viewHeight, frame)
                                    : boundedAt(camera->fovY, frame) });
  this->Aspect->setValues({ camera->aspect });
  this->Near->setValues({ camera->near });
  this->Far->setValues({ camera->far });
}

void RenderCameras::showSize()
{
  const bool own = this->OwnSize->isChecked();
  const CameraDescription* const camera = this->chosen();
  const int of[2] = { camera ? camera->width : 0, camera ? camera->height : 0 };
  // The size of a camera with a matrix K belongs to that matrix.
  const bool editable = !own || (camera != nullptr && !camera->K);
  for (int axis = 0; axis < 2; ++axis)
  {
    const int size = own && of[axis] > 0 ? of[axis] : own ? usualImageSize[axis] : this->CommonSize[axis];
    const QSignalBlocker quietSize(this->Size[axis]);
    const QSignalBlocker quietSlider(this->Sliders[axis]);
    this->Size[axis]->setValue(size);
    this->Sliders[axis]->setValue(std::min(size, this->Sliders[axis]->maximum()));
    this->Size[axis]->setEnabled(editable);
    this->Sliders[axis]->setEnabled(editable);
  }
}

void RenderCameras::takeSize()
{
  const int size[2] = { this->Size[0]->value(), this->Size[1]->value() };
  if (!this->OwnSize->isChecked())
  {
    std::copy(size, size + 2, this->CommonSize);
    this->showResolution();
    return;
  }
  if (const CameraDescription* const camera = this->chosen())
  {
    const SceneItem item = this->chosenItem();
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

void RenderCameras::showResolution()
{
  const SceneDescription& scene = this->State.scene();
  const CameraDescription* const camera = this->chosen();
  if (camera == nullptr)
  {
    this->Resolution->setText(tr("The scene has no camera. Add one with Tools > Add camera."));
    return;
  }
  const QSize size = this->commonSize().value_or(QSize(0, 0)); // 0: its own
  View view;
  const int frame = this->State.frame();
  try
  {
    view = cameraView(*camera, frame, size.width(), size.height(), scene.folder);
  }
  catch (const Error& error)
  {
    const bool placed = camera->posed || camera->eye.at(frame) != camera->lookAt.at(frame);
    this->Resolution->setText(
      placed ? toText(error.what())
             : tr("%1 has no pose at this frame: its eye is at its look-at point.").arg(toText(camera->name)));
    return;
  }
  const WorldResolution resolution = worldResolution(view);
  const QString units = (scene.units.empty() ? tr("units") : toText(scene.units)).toHtmlEscaped();
  QString rows;
  const std::optional<LinearProjection> linear = view.model->linear();
  if (linear && !linear->perspective)
  {
    rows = resolutionRow(tr("at every depth"), resolution.farPlane, units);
  }
  else
  {
    if (!camera->posed)
    {
      const int frame = this->State.frame();
      const double depth = (camera->lookAt.at(frame) - camera->eye.at(frame)).norm();
      rows = resolutionRow(
        tr("at the look-at point, %1 %2 away").arg(QString::number(depth, 'g', digitsOfResolution), units),
        resolution.farPlane * (depth / view.far), units);
    }
    rows += resolutionRow(tr("at the far plane"), resolution.farPlane, units);
    rows += resolutionRow(tr("between near and far plane (the thesis's number)"), resolution.thesis, units);
  }
  this->Resolution->setText(tr("%1: %2 x %3 pixels. A pixel is, in x and y:")
                              .arg(toText(camera->name).toHtmlEscaped(), QString::number(view.model->width()),
                                QString::number(view.model->height())) +
                            "<table cellspacing='0' cellpadding='3'>" + rows + "</table>");
}

} // namespace dgtk
