// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExportDialog.h"

#include "dgtkEditorState.h"
#include "dgtkExport.h"
#include "dgtkExporterEntry.h"
#include "dgtkNumberBox.h"
#include "dgtkNumberRow.h"
#include "dgtkOptionFields.h"
#include "dgtkUsualFolder.h"
#include "dgtkWindowSize.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QFileDialog>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollArea>
#include <QSettings>
#include <QVBoxLayout>

#include <algorithm>

namespace dgtk
{

/// A field for each option of any format; those of others than the chosen one are grey.
class ExportOptions : public OptionFields
{
public:
  explicit ExportOptions(QWidget* parent)
    : OptionFields("export/options", parent)
  {
    auto* form = new QFormLayout(this);
    for (const OptionRow* row : allExportOptions())
    {
      this->add(*row, form).owners = ownersOf(*row);
    }
  }

private:
  static QStringList ownersOf(const OptionRow& row)
  {
    const std::vector<const OptionRow*>& all = exportOptions();
    QStringList owners;
    for (const ExporterRow& format : exporterRows())
    {
      const std::vector<const OptionRow*> own = format.make()->options();
      const bool has = std::any_of(own.begin(), own.end(), [&](const OptionRow* one) { return one->name == row.name; });
      owners += has ? QStringList(toText(format.info.name)) : QStringList();
    }
    return std::find(all.begin(), all.end(), &row) != all.end() ? QStringList() : owners;
  }
};

namespace
{
QHBoxLayout* withBrowser(QLineEdit* line, QWidget* parent, const QString& title, const QString& kind)
{
  auto* row = new QHBoxLayout;
  row->addWidget(line, 1);
  auto* browse = new QPushButton(ExportDialog::tr("Browse ..."));
  browse->setAutoDefault(false);
  row->addWidget(browse);
  QObject::connect(browse, &QPushButton::clicked, line,
    [=]
    {
      const QString start = line->text().isEmpty() ? usualFolder(kind) : line->text();
      const QString folder = QFileDialog::getExistingDirectory(parent, title, start);
      if (!folder.isEmpty())
      {
        line->setText(folder);
      }
    });
  return row;
}
} // namespace

ExportDialog::ExportDialog(QWidget* parent)
  : QDialog(parent)
  , Process(nullptr)
{
  this->setObjectName("exportDialog");
  this->setWindowTitle(tr("Export a dataset"));
  auto* layout = new QVBoxLayout(this);
  this->makeFields(layout);
  this->makeButtons(layout);
  resizeWithin(*this, 600, 640);
  connect(&this->Process, &RenderProcess::line, this, &ExportDialog::noted);
  connect(&this->Process, &RenderProcess::finished, this, &ExportDialog::finish);
  connect(&this->Process, &RenderProcess::progress, this,
    [this](int done, int total)
    {
      this->Progress->setRange(0, total);
      this->Progress->setValue(done);
    });
  this->chooseFormat();
  this->setRunning(false);
}

void ExportDialog::makeFields(QVBoxLayout* layout)
{
  auto* form = new QFormLayout;
  this->Dataset = new QLineEdit;
  this->Dataset->setObjectName("dataset");
  const auto addFolder = [&](const QString& label, QLineEdit* line, const QString& title, const QString& kind)
  {
    auto* caption = new QLabel(label);
    caption->setBuddy(line);
    form->addRow(caption, withBrowser(line, this, title, kind));
  };
  addFolder(tr("&Dataset"), this->Dataset, tr("Folder of the dataset"), "dataset");
  this->Format = new QComboBox;
  this->Format->setObjectName("format");
  for (const ExporterRow& row : exporterRows())
  {
    this->Format->addItem(toText(row.info.name), toText(row.info.description));
  }
  this->Format->setCurrentText(QSettings().value("export/format").toString());
  form->addRow(tr("&Format"), this->Format);
  this->Description = new QLabel;
  this->Description->setWordWrap(true);
  form->addRow(QString(), this->Description);
  this->Folder = new QLineEdit;
  this->Folder->setObjectName("folder");
  addFolder(tr("F&older"), this->Folder, tr("Folder of the export"), "export");
  layout->addLayout(form);
  auto* area = new QScrollArea;
  area->setWidgetResizable(true);
  this->Options = new ExportOptions(this);
  area->setWidget(this->Options);
  layout->addWidget(area, 1);
  connect(this->Dataset, &QLineEdit::textChanged, this, &ExportDialog::nameFolder);
  connect(this->Format, &QComboBox::currentTextChanged, this, &ExportDialog::chooseFormat);
}

void ExportDialog::makeButtons(QVBoxLayout* layout)
{
  this->Replace = new QCheckBox(tr("&Replace another export in this folder"));
  this->Replace->setObjectName("replace");
  layout->addWidget(this->Replace);
  this->Progress = new QProgressBar;
  this->Progress->setRange(0, 1);
  this->Progress->setValue(0);
  layout->addWidget(this->Progress);
  this->Status = new QLabel;
  this->Status->setTextFormat(Qt::PlainText);
  this->Status->setObjectName("status");
  this->Status->setWordWrap(true);
  layout->addWidget(this->Status);
  tellIn(*this, *this->Status);
  auto* buttons = new QHBoxLayout;
  buttons->addStretch(1);
  this->Start = new QPushButton(tr("&Start"));
  this->Start->setObjectName("start");
  this->Start->setDefault(true);
  this->Cancel = new QPushButton(tr("Cancel"));
  this->Cancel->setObjectName("cancel");
  auto* close = new QPushButton(tr("Close"));
  for (QPushButton* button : { this->Start, this->Cancel, close })
  {
    buttons->addWidget(button);
  }
  this->Cancel->setAutoDefault(false);
  close->setAutoDefault(false);
  layout->addLayout(buttons);
  connect(this->Start, &QPushButton::clicked, this, &ExportDialog::start);
  connect(this->Cancel, &QPushButton::clicked, this, [this] { this->Process.cancel(); });
  connect(close, &QPushButton::clicked, this, &QDialog::hide);
}

void ExportDialog::offer(const QString& dataset)
{
  if (!this->running() && !dataset.isEmpty())
  {
    this->Dataset->setText(dataset);
  }
}

void ExportDialog::chooseFormat()
{
  this->Description->setText(this->Format->currentData().toString());
  this->Options->setOwners({ this->Format->currentText() });
  this->nameFolder();
}

/// Beside the dataset, until somebody names another folder.
void ExportDialog::nameFolder()
{
  const QString dataset = QDir::cleanPath(this->Dataset->text().trimmed());
  if (this->Folder->text() == this->Named && !this->Dataset->text().trimmed().isEmpty())
  {
    this->Named = dataset + '_' + this->Format->currentText();
    this->Folder->setText(this->Named);
  }
}

QStringList ExportDialog::arguments() const
{
  return QStringList{ "export", this->Dataset->text().trimmed(), optionWord("format"), this->Format->currentText(),
    "-o", this->Folder->text().trimmed() } +
         this->Options->words();
}

void ExportDialog::start()
{
  if (this->Dataset->text().trimmed().isEmpty() || this->Folder->text().trimmed().isEmpty())
  {
    this->Status->setText(tr("Name the folders of the dataset and of the export."));
    return;
  }
  if (const QString fault = commitRows(*this); !fault.isEmpty())
  {
    this->Status->setText(fault);
    return;
  }
  this->Options->remember();
  QSettings().setValue("export/format", this->Format->currentText());
  const QStringList words = this->arguments();
  const QStringList how = this->Replace->isChecked() ? QStringList{ optionWord("replace") } : QStringList();
  this->Progress->setRange(0, 0);
  this->Status->setText(tr("Exporting ..."));
  this->setRunning(true);
  emit this->noted("dgtk " + shellLine(words + how));
  this->Process.start({ QDir(this->Folder->text().trimmed()).absolutePath(), words, {} }, how);
}

void ExportDialog::finish(RunLog::End end, const QString& message)
{
  this->Progress->setRange(0, 1);
  this->Progress->setValue(end == RunLog::End::Done ? 1 : 0);
  this->Status->setText(this->Process.cancelled() ? tr("Stopped.") : this->Options->inWindowsWords(message));
  this->setRunning(false);
}

void ExportDialog::setRunning(bool on)
{
  for (QWidget* field :
    { static_cast<QWidget*>(this->Dataset), static_cast<QWidget*>(this->Format), static_cast<QWidget*>(this->Folder),
      static_cast<QWidget*>(this->Options), static_cast<QWidget*>(this->Replace), static_cast<QWidget*>(this->Start) })
  {
    field->setEnabled(!on);
  }
  this->Cancel->setEnabled(on);
}

} // namespace dgtk
