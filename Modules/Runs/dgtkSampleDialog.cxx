// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSampleDialog.h"

#include "dgtkEditorLanguage.h"
#include "dgtkEditorState.h"
#include "dgtkNewestTask.h"
#include "dgtkNumberBox.h"
#include "dgtkSampleWriter.h"
#include "dgtkWindowSize.h"

#include <QDir>
#include <QDoubleSpinBox>
#include <QFile>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPlainTextEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QStringList>
#include <QTreeWidget>
#include <QVBoxLayout>

#include <algorithm>
#include <utility>

namespace dgtk
{

namespace
{
constexpr double largestSeed = 9007199254740991; // 2^53 - 1
constexpr int notesHeight = 100;                 // pixels

QString measuredOf(const SampleNote& note)
{
  QStringList words;
  for (const auto& [name, value] : note.measured)
  {
    words << toText(name) + ' ' + QString::number(value, 'g', 4);
  }
  return words.join(", ");
}

QString textOf(const SampleNote& note)
{
  const QString attempts = SampleDialog::tr("attempts: %1").arg(note.attempts);
  const QString said = note.kept ? measuredOf(note) : toText(note.why);
  return toText(note.path) + ": " + (said.isEmpty() ? attempts : said + "; " + attempts);
}

QPushButton* addButton(QHBoxLayout* row, const QString& text, const char* name)
{
  auto* button = new QPushButton(text);
  button->setObjectName(name);
  button->setAutoDefault(false); // Return takes a number, and does nothing else
  row->addWidget(button);
  return button;
}
} // namespace

SampleDialog::SampleDialog(SampleDialogHooks hooks, QWidget* parent)
  : QDialog(parent)
  , Hooks(std::move(hooks))
  , Task(std::make_unique<NewestTask>())
{
  this->setObjectName("sampleDialog");
  this->setWindowTitle(tr("Sample a random scene"));
  auto* layout = new QVBoxLayout(this);
  this->makeFields(layout);
  this->makeLists(layout);
  this->Writer = new SampleWriter(this);
  layout->addWidget(this->Writer);
  layout->addWidget(this->makeButtons());
  resizeWithin(*this, 560, 720);
  connect(this->Writer, &SampleWriter::noted, this, &SampleDialog::noted);
  this->allowKeeping(false);
  this->setDrawing(false);
}

SampleDialog::~SampleDialog()
{
  this->Task.reset();
  // A field that loses the focus with the dialog takes what was typed.
  this->Number->disconnect(this);
  this->SeedField->disconnect(this);
}

void SampleDialog::makeFields(QVBoxLayout* layout)
{
  this->File = new QLabel;
  this->File->setTextFormat(Qt::PlainText);
  this->File->setObjectName("file");
  this->Number = new NumberBox<QSpinBox>;
  this->Number->setObjectName("number");
  this->Number->setRange(0, largestSample);
  this->SeedField = new NumberBox<QDoubleSpinBox>;
  this->SeedField->setObjectName("seed");
  this->SeedField->setDecimals(0);
  this->SeedField->setRange(0, largestSeed);
  this->SeedField->setToolTip(tr("The scene's own seed, or another one to draw with"));
  auto* row = new QHBoxLayout;
  this->Previous = addButton(row, tr("&Previous"), "previous");
  row->addWidget(this->Number, 1);
  this->Next = addButton(row, tr("Ne&xt"), "next");
  QPushButton* const again = addButton(row, tr("Dr&aw"), "draw");
  again->setToolTip(tr("Draw this sample of the file as it is now"));
  auto* form = new QFormLayout;
  form->addRow(tr("Random scene"), this->File);
  auto* caption = new QLabel(tr("Sample &number"));
  caption->setBuddy(this->Number);
  form->addRow(caption, row);
  form->addRow(tr("&Seed"), this->SeedField);
  layout->addLayout(form);
  connect(this->Previous, &QPushButton::clicked, this->Number, &QSpinBox::stepDown);
  connect(this->Next, &QPushButton::clicked, this->Number, &QSpinBox::stepUp);
  connect(again, &QPushButton::clicked, this, &SampleDialog::draw);
  connect(this->Number, QOverload<int>::of(&QSpinBox::valueChanged), this, &SampleDialog::draw);
  connect(this->SeedField, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
    [this](double seed)
    {
      this->Seed = std::uint64_t(seed);
      this->draw();
    });
}

void SampleDialog::makeLists(QVBoxLayout* layout)
{
  auto* row = new QHBoxLayout;
  this->Progress = new QProgressBar;
  this->Progress->setObjectName("drawing");
  this->Progress->setRange(0, 0);
  row->addWidget(this->Progress, 1);
  this->Stop = addButton(row, tr("St&op"), "stop");
  connect(this->Stop, &QPushButton::clicked, this, &SampleDialog::stop);
  layout->addLayout(row);
  this->Status = new QLabel;
  this->Status->setTextFormat(Qt::PlainText);
  this->Status->setObjectName("status");
  this->Status->setWordWrap(true);
  this->Status->setTextInteractionFlags(Qt::TextSelectableByMouse);
  layout->addWidget(this->Status);
  tellIn(*this, *this->Status);
  this->Values = new QTreeWidget;
  this->Values->setObjectName("values");
  this->Values->setHeaderLabels({ tr("Parameter or random value"), tr("Drawn") });
  this->Values->setRootIsDecorated(false);
  this->Values->setUniformRowHeights(true);
  this->Values->header()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
  layout->addWidget(this->Values, 1);
  auto* caption = new QLabel(tr("Ru&les: left out, refused, attempts, measured"));
  layout->addWidget(caption);
  this->Notes = new QPlainTextEdit;
  this->Notes->setObjectName("notes");
  this->Notes->setReadOnly(true);
  this->Notes->setTabChangesFocus(true);
  this->Notes->setMaximumHeight(notesHeight);
  caption->setBuddy(this->Notes);
  layout->addWidget(this->Notes);
}

QWidget* SampleDialog::makeButtons()
{
  auto* panel = new QWidget;
  auto* row = new QHBoxLayout(panel);
  row->setContentsMargins(0, 0, 0, 0);
  this->Keep = addButton(row, tr("&Keep as scene ..."), "keep");
  row->addStretch(1);
  QPushButton* const close = addButton(row, tr("Close"), "close");
  connect(this->Keep, &QPushButton::clicked, this, [this] { this->Hooks.keep(); });
  connect(close, &QPushButton::clicked, this, &QDialog::hide);
  return panel;
}

void SampleDialog::openScene(const QString& path)
{
  this->Path = QDir::cleanPath(QFileInfo(path).absoluteFilePath());
  this->File->setText(QFileInfo(path).fileName());
  this->File->setToolTip(QDir::toNativeSeparators(this->Path));
  this->Drawer = std::make_shared<SampleDrawer>(QFile::encodeName(this->Path).toStdString());
  this->Seed.reset();
  this->Shown = 0;
  this->Any = false;
  for (QAbstractSpinBox* box :
    { static_cast<QAbstractSpinBox*>(this->Number), static_cast<QAbstractSpinBox*>(this->SeedField) })
  {
    const QSignalBlocker quiet(box);
    dynamic_cast<TypedNumber&>(*box).forget(); // it was for another scene
  }
  this->setFields(0, {});
  this->Values->clear();
  this->Notes->clear();
  this->Writer->setScene(this->Path);
  this->draw();
}

void SampleDialog::allowKeeping(bool on) { this->Keep->setEnabled(on); }

void SampleDialog::setDrawing(bool on)
{
  this->Progress->setVisible(on);
  this->Stop->setVisible(on);
}

void SampleDialog::setFields(int number, std::optional<std::uint64_t> seed)
{
  const QSignalBlocker quietNumber(this->Number);
  const QSignalBlocker quietSeed(this->SeedField);
  this->Number->setValue(number);
  if (seed)
  {
    this->SeedField->setValue(double(*seed));
  }
  this->Previous->setEnabled(number > 0);
  this->Next->setEnabled(number < largestSample);
}

void SampleDialog::draw()
{
  if (!this->isVisible()) // closed while a number was typed
  {
    return;
  }
  for (QAbstractSpinBox* box :
    { static_cast<QAbstractSpinBox*>(this->Number), static_cast<QAbstractSpinBox*>(this->SeedField) })
  {
    if (!box->hasAcceptableInput())
    {
      box->interpretText(); // which tells why
      return;
    }
  }
  if (!this->Hooks.mayReplace())
  {
    this->stop();
    return;
  }
  const int number = this->Number->value();
  this->setFields(number, {});
  this->Writer->setSeed(this->Seed);
  this->setDrawing(true);
  this->Status->setText(tr("Drawing sample %1 ...").arg(number));
  const int asked = ++this->Asked;
  this->Task->start(
    [this, asked, number, seed = this->Seed, drawer = this->Drawer, prepare = this->Hooks.prepare](
      const NewestTask::Outdated& outdated)
    {
      // A std::function has copies only.
      const auto drawn = std::make_shared<std::optional<DrawnSample>>(drawer->draw(number, seed, outdated));
      if (*drawn && (*drawn)->scene && prepare)
      {
        prepare(*(*drawn)->scene);
      }
      QMetaObject::invokeMethod(
        this,
        [this, asked, drawn]
        {
          if (asked == this->Asked && *drawn)
          {
            this->take(std::move(**drawn));
          }
        },
        Qt::QueuedConnection);
    });
}

void SampleDialog::stop()
{
  ++this->Asked;
  this->Task->start([](const NewestTask::Outdated&) {}); // what is drawn now is outdated
  this->setDrawing(false);
  this->setFields(this->Shown, {});
  this->say(this->Any ? tr("Stopped. The views show sample %1.").arg(this->Shown) : tr("Stopped."));
}

void SampleDialog::take(DrawnSample drawn)
{
  this->setDrawing(false);
  this->list(drawn);
  this->setFields(drawn.number, drawn.seed);
  const QString line = this->lineOf(drawn);
  const int number = drawn.number;
  if (!drawn.scene)
  {
    this->say(this->Any ? tr("%1. The views show sample %2.").arg(line, QString::number(this->Shown)) : line);
    return;
  }
  if (!this->Hooks.show(std::move(*drawn.scene)))
  {
    this->stop();
    return;
  }
  this->Shown = number;
  this->Any = true;
  this->say(line);
}

void SampleDialog::say(const QString& line)
{
  this->Status->setText(line);
  emit this->noted(line);
}

QString SampleDialog::lineOf(const DrawnSample& drawn) const
{
  if (drawn.refused)
  {
    return tr("Sample %1 is refused: %2").arg(QString::number(drawn.number), toText(drawn.fault));
  }
  if (!drawn.scene)
  {
    return toText(drawn.fault);
  }
  const auto out =
    std::count_if(drawn.notes.begin(), drawn.notes.end(), [](const SampleNote& note) { return !note.kept; });
  return tr("Sample %1: %2; %3 left out")
    .arg(QString::number(drawn.number), contentsText(drawn.scene->scene), QString::number(out));
}

void SampleDialog::list(const DrawnSample& drawn)
{
  this->Values->clear();
  QList<QTreeWidgetItem*> rows;
  for (const SampleValue& value : drawn.values)
  {
    rows << new QTreeWidgetItem(QStringList{ toText(value.path), toText(value.value) });
    rows.last()->setToolTip(1, toText(value.value));
  }
  this->Values->addTopLevelItems(rows);
  QStringList lines;
  for (const bool kept : { false, true })
  {
    for (const SampleNote& note : drawn.notes)
    {
      lines += note.kept == kept ? QStringList(textOf(note)) : QStringList();
    }
  }
  this->Notes->setPlainText(lines.join('\n'));
}

} // namespace dgtk
