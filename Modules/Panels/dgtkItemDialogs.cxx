// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkItemDialogs.h"

#include "dgtkPortableMath.h"
#include "dgtkVectorRows.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>

#include <QCoreApplication>

#include <cmath>

namespace dgtk
{

namespace
{
constexpr int byMatrix = 1; // of the lens's words
constexpr double usualWidth = 640;
constexpr double usualHeight = 480;

QDialogButtonBox* addButtons(QDialog* dialog, QFormLayout* form)
{
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  QPushButton* const add = buttons->addButton(QObject::tr("&Add"), QDialogButtonBox::AcceptRole);
  add->setObjectName("add");
  add->setDefault(true);
  buttons->button(QDialogButtonBox::Cancel)->setAutoDefault(false);
  QObject::connect(buttons, &QDialogButtonBox::accepted, dialog, &QDialog::accept);
  QObject::connect(buttons, &QDialogButtonBox::rejected, dialog, &QDialog::reject);
  form->addRow(buttons);
  dialog->setMinimumWidth(380);
  return buttons;
}

/// What is typed is taken. False where something is no number, after a box that says so.
bool takeRows(QDialog& dialog)
{
  const QString fault = commitRows(dialog);
  if (!fault.isEmpty())
  {
    QMessageBox box(QMessageBox::Warning, QObject::tr("DGTk"), fault, QMessageBox::Ok, &dialog);
    box.setTextFormat(Qt::PlainText);
    box.setObjectName("errorBox");
    box.exec();
  }
  return fault.isEmpty();
}
} // namespace

QStringList lightKindNames()
{
  QStringList names;
  for (const LightTraits& kind : lightKinds())
  {
    names << QCoreApplication::translate("dgtk::LightKind", kind.word);
  }
  return names;
}

int lightKindPlace(LightKind kind) { return static_cast<int>(&traitsOf(kind) - lightKinds().data()); }

CameraDialog::CameraDialog(const CameraDescription& camera, QWidget* parent)
  : QDialog(parent)
{
  this->setObjectName("cameraDialog");
  this->setWindowTitle(tr("Add camera"));
  auto* form = new QFormLayout(this);
  this->Name = new QLineEdit(toText(camera.name));
  this->Name->setObjectName("name");
  form->addRow(tr("&Name"), this->Name);
  this->Eye = addVectorRow(form, tr("&Eye"), "eye", listOf(camera.eye.value));
  this->LookAt = addVectorRow(form, tr("&Look at"), "lookAt", listOf(camera.lookAt.value));
  this->Up = addVectorRow(form, tr("&Up"), "up", listOf(camera.up.value));
  this->Lens = new QComboBox;
  this->Lens->setObjectName("lens");
  this->Lens->addItems({ tr("by its field of view"), tr("by its matrix K") });
  form->addRow(tr("Len&s"), this->Lens);
  this->Fov = addVectorRow(form, tr("&Field of view, \u00b0 (vertical)"), "fovY", { camera.fovY.value });
  this->Aspect = addVectorRow(form, tr("Aspec&t (0: square pixels)"), "aspect", { camera.aspect });
  this->K = addVectorRow(form, tr("f&x, fy, cx, cy, pixels"), "K", { 0, 0, 0, 0 });
  this->Size =
    addVectorRow(form, tr("Si&ze, pixels (0: as asked for)"), "size", { double(camera.width), double(camera.height) });
  connect(this->Lens, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &CameraDialog::showLens);
  this->showLens();
  this->Range = addVectorRow(form, tr("Near, fa&r"), "range", { camera.near, camera.far });
  QDialogButtonBox* const buttons = addButtons(this, form);
  QPushButton* const preview = buttons->addButton(tr("&Preview"), QDialogButtonBox::ActionRole);
  preview->setAutoDefault(false);
  preview->setToolTip(tr("Shows the perspective view from there"));
  connect(preview, &QPushButton::clicked, this,
    [this]
    {
      if (takeRows(*this))
      {
        emit this->previewAsked();
      }
    });
}

void CameraDialog::showLens()
{
  const bool matrix = this->Lens->currentIndex() == byMatrix;
  this->Fov->setEnabled(!matrix);
  this->Aspect->setEnabled(!matrix);
  this->K->setEnabled(matrix);
  if (matrix && this->K->values()[0] == 0)
  {
    std::vector<double> size = this->Size->values();
    size = size[0] > 0 && size[1] > 0 ? size : std::vector<double>{ usualWidth, usualHeight };
    const double focal = size[1] / 2 / std::tan(this->Fov->values()[0] * pi / 360);
    this->Size->setValues(size);
    this->K->setValues({ focal, focal, size[0] / 2, size[1] / 2 });
  }
}

void CameraDialog::accept()
{
  if (takeRows(*this) && (!this->Adder || this->Adder(this->camera())))
  {
    QDialog::accept();
  }
}

CameraDescription CameraDialog::camera() const
{
  CameraDescription camera;
  camera.name = this->Name->text().toStdString();
  camera.eye = vectorOf(this->Eye);
  camera.lookAt = vectorOf(this->LookAt);
  camera.up = vectorOf(this->Up);
  camera.width = pixelsOf(this->Size->values()[0]);
  camera.height = pixelsOf(this->Size->values()[1]);
  if (this->Lens->currentIndex() == byMatrix)
  {
    const std::vector<double>& k = this->K->values();
    camera.K = Eigen::Matrix3d::Identity();
    (*camera.K)(0, 0) = k[0];
    (*camera.K)(1, 1) = k[1];
    (*camera.K)(0, 2) = k[2];
    (*camera.K)(1, 2) = k[3];
  }
  else
  {
    camera.fovY = this->Fov->values()[0];
    camera.aspect = this->Aspect->values()[0];
  }
  camera.near = this->Range->values()[0];
  camera.far = this->Range->values()[1];
  return camera;
}

LightDialog::LightDialog(const LightDescription& light, QWidget* parent)
  : QDialog(parent)
{
  this->setObjectName("lightDialog");
  this->setWindowTitle(tr("Add light"));
  auto* form = new QFormLayout(this);
  this->Name = new QLineEdit(toText(light.name));
  this->Name->setObjectName("name");
  form->addRow(tr("&Name"), this->Name);
  this->Kind = new QComboBox;
  this->Kind->setObjectName("kind");
  this->Kind->addItems(lightKindNames());
  this->Kind->setCurrentIndex(lightKindPlace(light.kind));
  form->addRow(tr("&Kind"), this->Kind);
  this->Position = addVectorRow(form, tr("&Position"), "position", listOf(light.position.value));
  this->Target = addVectorRow(form, tr("&Target (directional, spot)"), "target", listOf(light.target.value));
  this->Diffuse = addVectorRow(form, tr("&Diffuse"), "diffuse", listOf(light.diffuse.value));
  this->Specular = addVectorRow(form, tr("&Specular"), "specular", listOf(light.specular.value));
  this->Ambient = addVectorRow(form, tr("A&mbient"), "ambient", listOf(light.ambient.value));
  this->Intensity = addVectorRow(form, tr("&Intensity"), "intensity", { light.intensity.value });
  this->Attenuation =
    addVectorRow(form, tr("Atten&uation (constant, linear, quadratic)"), "attenuation", listOf(light.attenuation));
  this->Cone = addVectorRow(form, tr("&Cone of a spot, \u00b0"), "coneAngle", { light.coneAngle.value });
  this->Exponent = addVectorRow(form, tr("E&xponent of a spot"), "exponent", { light.exponent.value });
  connect(this->Kind, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &LightDialog::refreshKind);
  this->refreshKind();
  this->Enabled = new QCheckBox(tr("&Enabled"));
  this->Enabled->setObjectName("enabled");
  this->Enabled->setChecked(light.enabled.value);
  form->addRow(QString(), this->Enabled);
  addButtons(this, form);
}

/// What a kind of light does not have cannot be typed.
void LightDialog::refreshKind()
{
  const LightTraits& kind = this->kind();
  this->Position->setEnabled(kind.placed);
  this->Target->setEnabled(kind.aimed);
  this->Attenuation->setEnabled(kind.near);
  this->Cone->setEnabled(kind.cone);
  this->Exponent->setEnabled(kind.cone);
}

const LightTraits& LightDialog::kind() const { return lightKinds()[std::size_t(this->Kind->currentIndex())]; }

void LightDialog::accept()
{
  if (takeRows(*this) && (!this->Adder || this->Adder(this->light())))
  {
    QDialog::accept();
  }
}

LightDescription LightDialog::light() const
{
  LightDescription light;
  light.name = this->Name->text().toStdString();
  light.kind = this->kind().kind;
  light.enabled = this->Enabled->isChecked();
  light.position = vectorOf(this->Position);
  light.target = vectorOf(this->Target);
  light.diffuse = vectorOf(this->Diffuse);
  light.specular = vectorOf(this->Specular);
  light.ambient = vectorOf(this->Ambient);
  light.intensity = this->Intensity->values()[0];
  light.attenuation = vectorOf(this->Attenuation);
  light.coneAngle = this->Cone->values()[0];
  light.exponent = this->Exponent->values()[0];
  return light;
}

} // namespace dgtk
