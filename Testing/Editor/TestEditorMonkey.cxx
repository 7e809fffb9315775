// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditorMonkey.h"
#include "TestEditorSupport.h"

#include "dgtkSceneDocument.h"

#include <QAction>
#include <QComboBox>
#include <QDrag>
#include <QFile>
#include <QFileDialog>
#include <QLineEdit>
#include <QMenuBar>
#include <QPointer>
#include <QPushButton>
#include <QToolButton>
#include <QWheelEvent>

#include <algorithm>
#include <iterator>
#include <vector>

namespace
{
constexpr int wholeEvents = 1500; // where there is time
constexpr int usualEvents = 900;
constexpr int eventsBetween = 75; // checks that everything can be undone
constexpr int mostOthers = 4;     // of so many checks one at least is of the scene that there was before
constexpr int undoneBetween = 2;  // looks at the heap
constexpr std::size_t mostItems = 60;
constexpr double memorySlack = 64; // MiB that larger views, compiled shaders and the allocator may take

int eventsAsked()
{
  const int asked = qEnvironmentVariableIntValue("DGTK_MONKEY_EVENTS");
  return asked > 0 ? asked : qEnvironmentVariableIsSet("DGTK_TEST_WHOLE") ? wholeEvents : usualEvents;
}

/// Everything but the end.
bool isAllowed(const QString& name) { return name != "exit"; }

bool isAllowed(const QWidget* widget)
{
  const auto* button = qobject_cast<const QToolButton*>(widget);
  const QAction* const action = button ? button->defaultAction() : nullptr;
  return isAllowed(widget->objectName()) && (action == nullptr || isAllowed(action->objectName())) &&
         !qobject_cast<const QMenuBar*>(widget);
}

template <typename T>
T middleOf(std::vector<T> values)
{
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}
} // namespace

/// Moves of the mouse with a button held, which QTest does not send.
void TestEditorMonkey::drag(QWidget* widget)
{
  const auto anywhere = [&] { return QPoint(this->below(widget->width()), this->below(widget->height())); };
  const Qt::MouseButton buttons[] = { Qt::LeftButton, Qt::LeftButton, Qt::LeftButton, Qt::MiddleButton,
    Qt::RightButton };
  const Qt::MouseButton button = buttons[this->below(int(std::size(buttons)))];
  const Qt::KeyboardModifiers modifiers = this->below(4) == 0 ? Qt::ControlModifier : Qt::NoModifier;
  const QPointer<QWidget> alive = widget;
  QTest::mousePress(widget, button, modifiers, anywhere());
  for (int i = this->below(4); i > 0 && alive; --i)
  {
    moveMouse(widget, anywhere(), button, modifiers);
  }
  if (alive)
  {
    QTest::mouseRelease(widget, button, modifiers, anywhere());
  }
}

void TestEditorMonkey::press(QWidget* widget)
{
  const int plain[] = { Qt::Key_Left, Qt::Key_Right, Qt::Key_Up, Qt::Key_Down, Qt::Key_Home, Qt::Key_End, Qt::Key_Tab,
    Qt::Key_Return, Qt::Key_Escape, Qt::Key_Delete, Qt::Key_Space, Qt::Key_F2, Qt::Key_X, Qt::Key_Y, Qt::Key_1,
    Qt::Key_7, Qt::Key_Minus, Qt::Key_Period, Qt::Key_E, Qt::Key_Backspace };
  const int withControl[] = { Qt::Key_Z, Qt::Key_C, Qt::Key_X, Qt::Key_V, Qt::Key_D, Qt::Key_A, Qt::Key_Left };
  if (this->below(4) == 0)
  {
    QTest::keyClick(widget, Qt::Key(withControl[this->below(int(std::size(withControl)))]), Qt::ControlModifier);
    return;
  }
  QTest::keyClick(widget, Qt::Key(plain[this->below(int(std::size(plain)))]));
}

void TestEditorMonkey::touchWidget(QWidget* widget)
{
  switch (this->below(6))
  {
    case 0:
      this->press(widget);
      break;
    case 1:
    {
      const QPointF at(this->below(widget->width()), this->below(widget->height()));
      QWheelEvent wheel(at, widget->mapToGlobal(at.toPoint()), {}, QPoint(0, this->below(2) ? 120 : -120), Qt::NoButton,
        Qt::NoModifier, Qt::NoScrollPhase, false);
      QApplication::sendEvent(widget, &wheel);
      break;
    }
    case 2:
      QTest::mouseClick(
        widget, Qt::LeftButton, {}, QPoint(this->below(widget->width()), this->below(widget->height())));
      break;
    default:
      this->drag(widget);
  }
}

/// Names a file that is there, one that is not, or a folder; none outside the test's folder is written.
void TestEditorMonkey::touchFileDialog(QFileDialog& dialog)
{
  static const char* const names[] = { "demo.json", "crate.ac", "cut.ac", "none.json", "new.scene", "demo_dataset" };
  auto* field = dialog.findChild<QLineEdit*>("fileNameEdit");
  if (field == nullptr || this->below(2) == 0)
  {
    dialog.reject();
    return;
  }
  field->setText(this->path(names[this->below(int(std::size(names)))]));
  QTest::keyClick(field, Qt::Key_Return);
}

/// Files to be opened.
void TestEditorMonkey::writeFiles() const
{
  const QString crate = QString::fromStdString(dgtk::test::sourceFile("Data/Models/crate.ac"));
  QFile::copy(crate, this->path("crate.ac"));
  QFile whole(crate);
  QFile cut(this->path("cut.ac"));
  QVERIFY(whole.open(QIODevice::ReadOnly) && cut.open(QIODevice::WriteOnly));
  cut.write(whole.read(whole.size() / 2));
}

void TestEditorMonkey::touchDialog()
{
  if (auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget()))
  {
    const QList<QAction*> actions = menu->actions();
    QAction* const chosen = actions.isEmpty() ? nullptr : actions[this->below(actions.size())];
    const bool wanted = chosen && chosen->isEnabled() && !chosen->menu() && isAllowed(chosen->objectName());
    menu->close();
    if (wanted && this->below(2) == 0)
    {
      chosen->trigger();
    }
    return;
  }
  QWidget* const modal = QApplication::activeModalWidget();
  if (auto* files = qobject_cast<QFileDialog*>(modal))
  {
    this->touchFileDialog(*files);
    return;
  }
  const QList<QWidget*> parts = modal ? modal->findChildren<QWidget*>() : QList<QWidget*>();
  if (modal == nullptr || parts.isEmpty() || this->below(3) == 0)
  {
    closeWhatIsOpen();
    return;
  }
  QWidget* const part = parts[this->below(parts.size())];
  if (part->isVisible() && part->isEnabled())
  {
    this->touchWidget(part);
  }
}

/// Dialogs and menus have event loops of their own, also within one another: a timer for each time.
void TestEditorMonkey::watchDialogs()
{
  QTimer::singleShot(10, this, &TestEditorMonkey::watchDialogs);
  QDrag::cancel(); // text that is dragged waits for a mouse that is not there
  if (QApplication::activePopupWidget() || QApplication::activeModalWidget())
  {
    this->touchDialog();
  }
}

void TestEditorMonkey::trigger()
{
  const QList<QAction*> actions = this->Window->findChildren<QAction*>();
  QAction* const action = actions[this->below(actions.size())];
  if (!action->objectName().isEmpty() && isAllowed(action->objectName()) && action->isEnabled())
  {
    action->trigger();
  }
}

void TestEditorMonkey::touch()
{
  if (QApplication::activePopupWidget() || QApplication::activeModalWidget())
  {
    this->touchDialog();
    return;
  }
  if (this->below(4) == 0)
  {
    this->trigger();
    return;
  }
  QList<QWidget*> windows;
  for (QWidget* window : QApplication::topLevelWidgets())
  {
    if (window->isVisible() && (window != this->Window.get() || this->below(2) == 0))
    {
      windows << window;
    }
  }
  QWidget* const window = windows.isEmpty() ? this->Window.get() : windows[this->below(windows.size())];
  QList<QWidget*> parts;
  for (QWidget* part : window->findChildren<QWidget*>())
  {
    if (part->isVisible() && part->isEnabled() && isAllowed(part))
    {
      parts << part;
    }
  }
  if (this->below(3) == 0)
  {
    parts = { this->Window->findChild<QWidget*>("view." + QString::number(this->below(4))) };
  }
  if (!parts.isEmpty())
  {
    this->touchWidget(parts[this->below(parts.size())]);
  }
}

void TestEditorMonkey::openAgain()
{
  dgtk::SceneDocument& document = this->Window->document();
  while (document.canUndo())
  {
    document.undo();
  }
  const std::string path = this->Folder.path("demo.json");
  dgtk::writeScene(dgtk::readScene(demo().toStdString()), path);
  document.open(path);
}

/// As at first, without which memory says little: viewers and tools that are left open keep what they show, and a view
/// that fills the window has a larger picture.
void TestEditorMonkey::tidyUp()
{
  if (auto* rendering = this->Window->findChild<QDialog*>("renderDialog"))
  {
    auto* cancel = rendering->findChild<QPushButton*>("cancel");
    cancel->click();
    cancel->click(); // without the picture that is being drawn
    QTRY_VERIFY(!cancel->isEnabled());
  }
  for (QWidget* window : QApplication::topLevelWidgets())
  {
    if (window->isVisible() && window != this->Window.get())
    {
      window->close();
    }
  }
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  bool maximized = false;
  for (int i = 0; i < 4; ++i)
  {
    maximized = maximized || !this->Window->findChild<QWidget*>("view." + QString::number(i))->isVisible();
  }
  if (maximized)
  {
    this->Window->findChild<QAction*>("maximize")->trigger();
  }
  this->Window->resize(this->Size);
  QCoreApplication::processEvents();
}

void TestEditorMonkey::randomEventsDoNoHarm()
{
  const unsigned seed = unsigned(1 + qEnvironmentVariableIntValue("DGTK_MONKEY_SEED"));
  // What it may write, by Return in a dialog, goes to the test's folder.
  QVERIFY(QDir::setCurrent(this->path("")));
  qputenv("HOME", this->path("").toLocal8Bit());
  this->writeFiles();
  this->openAgain();
  this->Size = this->Window->size();
  this->watchDialogs();
  dgtk::SceneDocument& document = this->Window->document();
  const std::string first = document.json();
  std::size_t opened = document.opened();
  std::vector<double> memory;
  int events = 0;
  int undone = 0;
  int compared = 0; // after them the scene must be as at first
  while (events < eventsAsked())
  {
    std::seed_seq chance{ seed, unsigned(events) }; // the same, however many a dialog took before
    this->Random.seed(chance);
    this->touch();
    QCoreApplication::processEvents();
    if (++events % eventsBetween == 0 || document.scene().items().size() > mostItems)
    {
      while (document.canUndo())
      {
        document.undo();
      }
      if (document.opened() == opened) // otherwise it is another scene
      {
        QCOMPARE(document.json(), first);
        ++compared;
      }
      const bool looks = ++undone % undoneBetween == 0;
      if (looks)
      {
        this->tidyUp();
      }
      this->openAgain();
      opened = document.opened();
      QCoreApplication::processEvents();
      if (looks)
      {
        memory.push_back(heapInUse());
      }
    }
  }
  qInfo("%d events, %d times all was undone, %d times in the same scene; heap %.1f MiB at first, %.1f MiB at last",
    events, undone, compared, memory.empty() ? 0.0 : memory.front(), memory.empty() ? 0.0 : memory.back());
  QVERIFY(undone >= eventsAsked() / eventsBetween);
  QVERIFY(mostOthers * compared >= undone);
  QVERIFY(memory.size() >= 4);
  // After all that opens has been opened once, memory stays.
  const auto quarter = std::ptrdiff_t(memory.size() / 4);
  const double early = middleOf(std::vector<double>(memory.begin() + quarter, memory.begin() + 2 * quarter));
  const double late = middleOf(std::vector<double>(memory.end() - quarter, memory.end()));
  QVERIFY2(late < 1.2 * early + memorySlack, qPrintable(QString("%1 MiB became %2 MiB").arg(early).arg(late)));
}

DGTK_EDITOR_TEST(TestEditorMonkey);
