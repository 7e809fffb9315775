// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCameraArrayDialog.h"

#include "dgtkNumberRow.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QPushButton>
#include <QSpinBox>

namespace dgtk
{

namespace
{
constexpr int mostCameras = 10000;
constexpr int mostInARow = 100;

std::vector<double> listOf(const Eigen::Vector3d& v) { return { v.x(), v.y(), v.z() }; }
Eigen::Vector3d vectorOf(const NumberRow* row) { return { row->values()[0], row->values()[1], row->values()[2] }; }

NumberRow* addNumbers(QFormLayout* form, const QString& label, const QString& name, const std::vector<double>& values)
{
  auto* row = new NumberRow(name, static_cast<int>(values.size()), nullptr);
  row->setValues(values);
  form->addRow(label, row);
  return row;
}

QSpinBox* addCount(QFormLayout* form, const QString& label, const QString& name, int most, int value)
{
  auto* box = new QSpinBox;
  box->setObjectName(name);
  box->setRange(1, most);
  box->setValue(value);
  form->addRow(label, box);
  return box;
}
} // namespace

CameraArrayDialog::CameraArrayDialog(const CameraDescription& first, QWidget* parent)
  : QDialog(parent)
  , First(first)
{
  this->setObjectName("cameraArrayDialog");
  this->setWindowTitle(tr("Add camera array"));
  auto* form = new QFormLayout(this);
  this->Kind = new QComboBox;
  this->Kind->setObjectName("kind");
  this->Kind->addItems({ tr("Ring"), tr("Hemisphere"), tr("Grid"), tr("Stereo pair") });
  form->addRow(tr("Kind"), this->Kind);
  const CameraArrayOptions usual;
  this->Eye = addNumbers(form, tr("Eye"), "eye", listOf(first.eye.value));
  this->LookAt = addNumbers(form, tr("Look at"), "lookAt", listOf(first.lookAt.value));
  this->Fov = addNumbers(form, tr("Field of view, \u00b0 (vertical)"), "fovY", { first.fovY.value });
  this->Count = addCount(form, tr("Cameras"), "count", mostCameras, usual.count);
  this->Columns = addCount(form, tr("Columns"), "columns", mostInARow, usual.columns);
  this->Rows = addCount(form, tr("Rows"), "rows", mostInARow, usual.rows);
  this->Spacing = addNumbers(form, tr("Spacing, baseline"), "spacing", { usual.spacing });
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  QPushButton* const add = buttons->addButton(tr("Add"), QDialogButtonBox::AcceptRole);
  add->setObjectName("add");
  add->setDefault(true);
  buttons->button(QDialogButtonBox::Cancel)->setAutoDefault(false);
  form->addRow(buttons);
  this->setMinimumWidth(380);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(this->Kind, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &CameraArrayDialog::showKind);
  this->showKind();
}

void CameraArrayDialog::showKind()
{
  const auto kind = static_cast<CameraArrayKind>(this->Kind->currentIndex());
  const bool around = kind == CameraArrayKind::Ring || kind == CameraArrayKind::Hemisphere;
  this->Count->setEnabled(around);
  this->Columns->setEnabled(kind == CameraArrayKind::Grid);
  this->Rows->setEnabled(kind == CameraArrayKind::Grid);
  this->Spacing->setEnabled(!around);
}

CameraArrayOptions CameraArrayDialog::options() const
{
  CameraArrayOptions options;
  options.kind = static_cast<CameraArrayKind>(this->Kind->currentIndex());
  options.first = this->First;
  options.first.eye = vectorOf(this->Eye);
  options.first.lookAt = vectorOf(this->LookAt);
  options.first.fovY = this->Fov->values()[0];
  options.count = this->Count->value();
  options.columns = this->Columns->value();
  options.rows = this->Rows->value();
  options.spacing = this->Spacing->values()[0];
  return options;
}

} // namespace dgtk
