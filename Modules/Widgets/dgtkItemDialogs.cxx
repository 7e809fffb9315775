// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkItemDialogs.h"

#include "dgtkNumberRow.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLineEdit>
#include <QPushButton>

namespace dgtk
{

namespace
{
NumberRow* addRow(QFormLayout* form, const QString& label, const QString& name, const std::vector<double>& values)
{
  auto* row = new NumberRow(name, static_cast<int>(values.size()), nullptr);
  row->setValues(values);
  form->addRow(label, row);
  return row;
}

std::vector<double> listOf(const Eigen::Vector3d& v) { return { v.x(), v.y(), v.z() }; }
Eigen::Vector3d vectorOf(const NumberRow* row) { return { row->values()[0], row->values()[1], row->values()[2] }; }

QDialogButtonBox* addButtons(QDialog* dialog, QFormLayout* form)
{
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  QPushButton* const add = buttons->addButton(QObject::tr("Add"), QDialogButtonBox::AcceptRole);
  add->setObjectName("add");
  add->setDefault(true);
  buttons->button(QDialogButtonBox::Cancel)->setAutoDefault(false);
  QObject::connect(buttons, &QDialogButtonBox::accepted, dialog, &QDialog::accept);
  QObject::connect(buttons, &QDialogButtonBox::rejected, dialog, &QDialog::reject);
  form->addRow(buttons);
  dialog->setMinimumWidth(380);
  return buttons;
}
} // namespace

CameraDialog::CameraDialog(const CameraDescription& camera, QWidget* parent)
  : QDialog(parent)
{
  this->setObjectName("cameraDialog");
  this->setWindowTitle(tr("Add camera"));
  auto* form = new QFormLayout(this);
  this->Name = new QLineEdit(toText(camera.name));
  this->Name->setObjectName("name");
  form->addRow(tr("Name"), this->Name);
  this->Eye = addRow(form, tr("Eye"), "eye", listOf(camera.eye.value));
  this->LookAt = addRow(form, tr("Look at"), "lookAt", listOf(camera.lookAt.value));
  this->Up = addRow(form, tr("Up"), "up", listOf(camera.up.value));
  this->Fov = addRow(form, tr("Field of view, \u00b0 (vertical)"), "fovY", { camera.fovY.value });
  this->Aspect = addRow(form, tr("Aspect (0: square pixels)"), "aspect", { camera.aspect });
  this->Range = addRow(form, tr("Near, far"), "range", { camera.near, camera.far });
  QDialogButtonBox* const buttons = addButtons(this, form);
  QPushButton* const preview = buttons->addButton(tr("Preview"), QDialogButtonBox::ActionRole);
  preview->setAutoDefault(false);
  preview->setToolTip(tr("Shows the perspective view from there"));
  connect(preview, &QPushButton::clicked, this, &CameraDialog::previewAsked);
}

CameraDescription CameraDialog::camera() const
{
  CameraDescription camera;
  camera.name = this->Name->text().toStdString();
  camera.eye = vectorOf(this->Eye);
  camera.lookAt = vectorOf(this->LookAt);
  camera.up = vectorOf(this->Up);
  camera.fovY = this->Fov->values()[0];
  camera.aspect = this->Aspect->values()[0];
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
  form->addRow(tr("Name"), this->Name);
  this->Kind = new QComboBox;
  this->Kind->setObjectName("kind");
  this->Kind->addItems({ tr("point"), tr("head"), tr("directional"), tr("spot") });
  this->Kind->setCurrentIndex(static_cast<int>(light.kind));
  form->addRow(tr("Kind"), this->Kind);
  this->Position = addRow(form, tr("Position"), "position", listOf(light.position.value));
  this->Target = addRow(form, tr("Target (directional, spot)"), "target", listOf(light.target.value));
  this->Diffuse = addRow(form, tr("Diffuse"), "diffuse", listOf(light.diffuse));
  this->Specular = addRow(form, tr("Specular"), "specular", listOf(light.specular));
  this->Ambient = addRow(form, tr("Ambient"), "ambient", listOf(light.ambient));
  this->Enabled = new QCheckBox(tr("Enabled"));
  this->Enabled->setObjectName("enabled");
  this->Enabled->setChecked(light.enabled);
  form->addRow(QString(), this->Enabled);
  addButtons(this, form);
}

LightDescription LightDialog::light() const
{
  LightDescription light;
  light.name = this->Name->text().toStdString();
  light.kind = static_cast<LightKind>(this->Kind->currentIndex());
  light.enabled = this->Enabled->isChecked();
  light.position = vectorOf(this->Position);
  light.target = vectorOf(this->Target);
  light.diffuse = vectorOf(this->Diffuse);
  light.specular = vectorOf(this->Specular);
  light.ambient = vectorOf(this->Ambient);
  return light;
}

} // namespace dgtk
