// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSampleWriter.h"

#include "dgtkNumberBox.h"
#include "dgtkNumberRow.h"
#include "dgtkOptionFields.h"
#include "dgtkSampler.h"
#include "dgtkUsualFolder.h"

#include <QCheckBox>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QSpinBox>
#include <QVBoxLayout>

namespace dgtk
{

namespace
{
constexpr int usualLast = 9;

QSpinBox* addNumber(QHBoxLayout* row, const QString& text, const char* name, int value)
{
  QSpinBox* const box = makeNumber(name, 0, largestSample, value);
  auto* caption = new QLabel(text);
  caption->setBuddy(box);
  row->addWidget(caption);
  row->addWidget(box, 1);
  return box;
}
} // namespace

SampleWriter::SampleWriter(QWidget* parent)
  : QGroupBox(tr("Write samples"), parent)
  , Process(nullptr)
{
  this->setObjectName("sampleWriter");
  auto* layout = new QVBoxLayout(this);
  this->makeFields(layout);
  this->makeButtons(layout);
  connect(&this->Process, &RenderProcess::line, this, &SampleWriter::noted);
  connect(&this->Process, &RenderProcess::finished, this, &SampleWriter::finish);
  connect(&this->Process, &RenderProcess::progress, this,
    [this](int done, int total)
    {
      this->Progress->setRange(0, total);
      this->Progress->setValue(done);
    });
  this->setRunning(false);
}

void SampleWriter::makeFields(QVBoxLayout* layout)
{
  auto* numbers = new QHBoxLayout;
  this->First = addNumber(numbers, tr("&From"), "first", 0);
  this->Last = addNumber(numbers, tr("&to"), "last", usualLast);
  layout->addLayout(numbers);
  auto* row = new QHBoxLayout;
  this->Folder = new QLineEdit;
  this->Folder->setObjectName("folder");
  auto* caption = new QLabel(tr("Fol&der"));
  caption->setBuddy(this->Folder);
  row->addWidget(caption);
  row->addWidget(this->Folder, 1);
  auto* other = new QPushButton(tr("Browse ..."));
  other->setAutoDefault(false);
  row->addWidget(other);
  layout->addLayout(row);
  connect(other, &QPushButton::clicked, this, &SampleWriter::browse);
}

void SampleWriter::makeButtons(QVBoxLayout* layout)
{
  this->Replace = new QCheckBox(tr("&Replace other samples in this folder"));
  this->Replace->setObjectName("replace");
  layout->addWidget(this->Replace);
  auto* row = new QHBoxLayout;
  this->Progress = new QProgressBar;
  this->Progress->setObjectName("writing");
  row->addWidget(this->Progress, 1);
  this->Write = new QPushButton(tr("&Write"));
  this->Write->setObjectName("write");
  this->Cancel = new QPushButton(tr("&Cancel"));
  this->Cancel->setObjectName("cancel");
  for (QPushButton* button : { this->Write, this->Cancel })
  {
    button->setAutoDefault(false);
    row->addWidget(button);
  }
  layout->addLayout(row);
  this->Status = new QLabel;
  this->Status->setTextFormat(Qt::PlainText);
  this->Status->setObjectName("writerStatus");
  this->Status->setWordWrap(true);
  layout->addWidget(this->Status);
  tellIn(*this, *this->Status);
  connect(this->Write, &QPushButton::clicked, this, &SampleWriter::start);
  connect(this->Cancel, &QPushButton::clicked, this, [this] { this->Process.cancel(); });
}

void SampleWriter::browse()
{
  const QString now = this->Folder->text().trimmed();
  const QString folder =
    QFileDialog::getExistingDirectory(this, tr("Folder of the samples"), now.isEmpty() ? usualFolder() : now);
  if (!folder.isEmpty())
  {
    this->Folder->setText(folder);
  }
}

void SampleWriter::setScene(const QString& path)
{
  this->Scene = path;
  if (this->Folder->text() == this->Named)
  {
    const QFileInfo file(path);
    this->Named = file.dir().filePath(file.completeBaseName() + "_samples");
    this->Folder->setText(this->Named);
  }
}

void SampleWriter::start()
{
  if (const QString fault = commitRows(*this); !fault.isEmpty())
  {
    this->Status->setText(fault);
    return;
  }
  const QString folder = this->Folder->text().trimmed();
  if (folder.isEmpty() || this->First->value() > this->Last->value())
  {
    this->Status->setText(
      folder.isEmpty() ? tr("Name the folder of the samples.") : tr("The first number is greater than the last."));
    return;
  }
  const QString numbers = QString("%1:%2").arg(this->First->value()).arg(this->Last->value());
  QStringList words{ "sample", this->Scene, optionWord("samples"), numbers, "-o", folder };
  if (this->Seed)
  {
    words << optionWord("seed") << QString::number(*this->Seed);
  }
  const QStringList how = this->Replace->isChecked() ? QStringList{ optionWord("replace") } : QStringList();
  this->Progress->setRange(0, 0);
  this->Status->setText(tr("Writing samples ..."));
  this->setRunning(true);
  emit this->noted("dgtk " + shellLine(words + how));
  this->Process.start({ QDir(folder).absolutePath(), words, {} }, how);
}

void SampleWriter::finish(RunLog::End end, QString message)
{
  this->Progress->setRange(0, 1);
  this->Progress->setValue(end == RunLog::End::Done ? 1 : 0);
  message.replace(" (" + optionWord("replace") + " removes them)", tr("; Replace removes them"));
  this->Status->setText(this->Process.cancelled() ? tr("Stopped.") : message);
  this->setRunning(false);
}

void SampleWriter::setRunning(bool on)
{
  for (QWidget* field :
    { static_cast<QWidget*>(this->First), static_cast<QWidget*>(this->Last), static_cast<QWidget*>(this->Folder),
      static_cast<QWidget*>(this->Replace), static_cast<QWidget*>(this->Write) })
  {
    field->setEnabled(!on);
  }
  this->Cancel->setEnabled(on);
  this->Progress->setVisible(on);
}

} // namespace dgtk
