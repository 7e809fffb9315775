// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCameraArrayDialog.h"

#include "dgtkEditorLanguage.h"
#include "dgtkError.h"
#include "dgtkNumberBox.h"
#include "dgtkVectorRows.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QRegularExpression>

#include <exception>
#include <optional>

namespace dgtk
{

namespace
{
constexpr int mostCameras = 10000;
constexpr int mostInARow = 100;
constexpr int pathHeight = 96; // pixels

QString textOf(const CameraPath& path)
{
  QStringList lines;
  for (std::size_t i = 0; i < path.eyes.size(); ++i)
  {
    QStringList numbers;
    for (const double value : listOf(path.eyes[i]))
    {
      numbers << numberText(value);
    }
    for (const double value : listOf(path.targets[i]))
    {
      numbers << numberText(value);
    }
    lines << numbers.join(' ');
  }
  return lines.join('\n');
}

/// Lines of three or six numbers; others throw UsageError.
CameraPath pathOf(const QString& text, const Eigen::Vector3d& lookAt)
{
  CameraPath path;
  int number = 0;
  for (const QString& line : text.split('\n'))
  {
    ++number;
    std::vector<double> values;
    for (const QString& word : line.split(QRegularExpression("[\\s,;]+"), Qt::SkipEmptyParts))
    {
      const std::optional<double> value = numberOf(word);
      if (!value)
      {
        throw UsageError(
          CameraArrayDialog::tr("path: line %1: \"%2\" is no number").arg(QString::number(number), word).toStdString());
      }
      values.push_back(*value);
    }
    if (!values.empty() && values.size() != 3 && values.size() != 6)
    {
      throw UsageError(CameraArrayDialog::tr("path: line %1: expected 3 or 6 numbers, found %2")
                         .arg(number)
                         .arg(values.size())
                         .toStdString());
    }
    if (values.size() >= 3)
    {
      path.eyes.emplace_back(values[0], values[1], values[2]);
      path.targets.push_back(values.size() == 6 ? Eigen::Vector3d(values[3], values[4], values[5]) : lookAt);
    }
  }
  return path;
}

QSpinBox* addCount(QFormLayout* form, const QString& label, const QString& name, int most, int value)
{
  auto* box = new NumberBox<QSpinBox>;
  box->setObjectName(name);
  box->setRange(1, most);
  box->setValue(value);
  form->addRow(label, box);
  return box;
}
} // namespace

CameraArrayDialog::CameraArrayDialog(const CameraDescription& first, const CameraPath& path, QWidget* parent)
  : QDialog(parent)
  , First(first)
{
  this->setObjectName("cameraArrayDialog");
  this->setWindowTitle(tr("Add camera array"));
  auto* form = new QFormLayout(this);
  this->Kind = new QComboBox;
  this->Kind->setObjectName("kind");
  this->Kind->addItems({ tr("Ring"), tr("Hemisphere"), tr("Grid"), tr("Stereo pair"), tr("Along a path") });
  form->addRow(tr("&Kind"), this->Kind);
  const CameraArrayOptions usual;
  this->Eye = addVectorRow(form, tr("&Eye"), "eye", listOf(first.eye.value));
  this->LookAt = addVectorRow(form, tr("&Look at"), "lookAt", listOf(first.lookAt.value));
  this->Fov = addVectorRow(form, tr("&Field of view, \u00b0 (vertical)"), "fovY", { first.fovY.value });
  this->Count = addCount(form, tr("&Cameras"), "count", mostCameras, usual.count);
  this->Columns = addCount(form, tr("C&olumns"), "columns", mostInARow, usual.columns);
  this->Rows = addCount(form, tr("&Rows"), "rows", mostInARow, usual.rows);
  this->Spacing = addVectorRow(form, tr("&Spacing, baseline"), "spacing", { usual.spacing });
  this->Path = new QPlainTextEdit(textOf(path));
  this->Path->setObjectName("path");
  this->Path->setPlaceholderText(tr("A point a line: x y z, and where it looks: x y z"));
  this->Path->setToolTip(
    tr("x, y and z of a point in each line; after them, if it looks elsewhere than the others, those "
       "of its look-at point. A camera with key frames that is selected fills this in."));
  this->Path->setTabChangesFocus(true);
  this->Path->setMaximumHeight(pathHeight);
  form->addRow(tr("&Path"), this->Path);
  this->Fault = new QLabel;
  this->Fault->setTextFormat(Qt::PlainText);
  this->Fault->setObjectName("fault");
  this->Fault->setWordWrap(true);
  this->Fault->hide();
  form->addRow(this->Fault);
  tellIn(*this, *this->Fault);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  QPushButton* const add = buttons->addButton(tr("&Add"), QDialogButtonBox::AcceptRole);
  add->setObjectName("add");
  add->setDefault(true);
  buttons->button(QDialogButtonBox::Cancel)->setAutoDefault(false);
  form->addRow(buttons);
  this->setMinimumWidth(380);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(this->Kind, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &CameraArrayDialog::showKind);
  this->Kind->setCurrentIndex(static_cast<int>(path.eyes.size() > 1 ? CameraArrayKind::Path : usual.kind));
  this->showKind();
}

void CameraArrayDialog::accept()
{
  try
  {
    if (const QString fault = commitRows(*this); !fault.isEmpty())
    {
      throw UsageError(fault.toStdString());
    }
    const std::vector<CameraDescription> cameras = cameraArray(this->options());
    if (this->Adder)
    {
      this->Adder(cameras);
    }
    QDialog::accept();
  }
  catch (const std::exception& error)
  {
    this->Fault->setText(messageText(error.what()));
    this->Fault->show();
  }
}

void CameraArrayDialog::showKind()
{
  const auto kind = static_cast<CameraArrayKind>(this->Kind->currentIndex());
  const bool path = kind == CameraArrayKind::Path;
  this->Eye->setEnabled(!path);
  this->Count->setEnabled(isCounted(kind));
  this->Columns->setEnabled(kind == CameraArrayKind::Grid);
  this->Rows->setEnabled(kind == CameraArrayKind::Grid);
  this->Spacing->setEnabled(isSpaced(kind));
  this->Path->setEnabled(path);
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
  if (options.kind == CameraArrayKind::Path)
  {
    options.path = pathOf(this->Path->toPlainText(), options.first.lookAt.value);
  }
  return options;
}

} // namespace dgtk
