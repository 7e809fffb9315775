// SPDX-License-Identifier: BSD-3-Clause
#ifndef TestEditorSupport_h
#define TestEditorSupport_h

#include "dgtkTestSupport.h"

#include "dgtkEditorLanguage.h"
#include "dgtkMainWindow.h"

#include <QAbstractButton>
#include <QApplication>
#include <QDialog>
#include <QDir>
#include <QDirIterator>
#include <QElapsedTimer>
#include <QEvent>
#include <QFile>
#include <QMap>
#include <QMenu>
#include <QMessageBox>
#include <QMouseEvent>
#include <QPointer>
#include <QProcess>
#include <QString>
#include <QTest>
#include <QTimer>
#include <QTranslator>

#include <algorithm>
#include <cstddef>
#include <ctime>
#include <functional>
#include <malloc.h>

#include <sys/types.h>

class QLineEdit;
class QPushButton;

extern "C" std::size_t __sanitizer_get_current_allocated_bytes() __attribute__((weak)); // AddressSanitizer's heap

// A wait ends when what it waits for is there. That it never comes is said late: a machine may be slow, and busy.
constexpr int longestRun = 120000;    // milliseconds
constexpr int longestCase = 86400000; // in place of Qt's five minutes: CTest knows the limits of programs
#undef QTRY_VERIFY
#undef QTRY_VERIFY2
#undef QTRY_COMPARE
#define QTRY_VERIFY(condition) QTRY_VERIFY_WITH_TIMEOUT(condition, longestRun)
#define QTRY_VERIFY2(condition, message) QTRY_VERIFY2_WITH_TIMEOUT(condition, message, longestRun)
#define QTRY_COMPARE(actual, expected) QTRY_COMPARE_WITH_TIMEOUT(actual, expected, longestRun)
constexpr int settle = 150; // milliseconds in which something could happen that must not, or threads go on

// The four views of the window, by their place.
constexpr int front = 0;
constexpr int top = 1;
constexpr int perspective = 3;

/// A motion of the mouse that arrives at once, wherever the display's own pointer is.
inline void moveMouse(QWidget* widget, const QPoint& at, Qt::MouseButtons buttons = Qt::NoButton,
  Qt::KeyboardModifiers modifiers = Qt::NoModifier)
{
  QMouseEvent event(QEvent::MouseMove, at, widget->mapToGlobal(at), Qt::NoButton, buttons, modifiers);
  QCoreApplication::sendEvent(widget, &event);
}

inline QString demo() { return QString::fromStdString(dgtk::test::sourceFile("Data/Scenes/demo.json")); }

/// Times are measured and printed; a test fails only when one is beyond this many times its aim. Others may be at work
/// on this machine: five times; and more as far as a small computation takes longer now than where the aims were set.
double patience();

/// Waits until the window has the focus, and asks for it as often as that takes: where no window manager asks, the X
/// server refuses the focus to a window that it has not drawn yet, and Qt takes no notice of it while a menu is open.
void activate(QWidget& window);

/// Until the window has laid itself out and drawn: nothing waits to be done in it. Work beside the window may go on.
void untilQuiet();

/// The program with these words; its exit code.
inline int run(const QStringList& words) { return QProcess::execute(QString::fromLocal8Bit(qgetenv("DGTK")), words); }

/// When the next dialog of that name is shown and has the focus, does something with it. It ends with a failure.
template <typename Dialog>
void answer(const QString& name, const std::function<void(Dialog&)>& act)
{
  auto* timer = new QTimer(qApp);
  QObject::connect(timer, &QTimer::timeout, timer,
    [timer, name, act]
    {
      auto* dialog = qobject_cast<Dialog*>(QApplication::activeModalWidget());
      if (dialog != nullptr && (name.isEmpty() || dialog->objectName() == name))
      {
        timer->deleteLater();
        timer->stop();
        const QPointer<Dialog> kept = dialog;
        activate(*dialog);
        act(*dialog);
        if (kept != nullptr && kept->isVisible() && QTest::currentTestFailed())
        {
          kept->reject();
        }
      }
    });
  timer->start(20);
}

/// The next refusal is closed; what it said goes to `message`, which is empty until then.
inline void expectRefusal(QString& message)
{
  message.clear();
  answer<QMessageBox>("errorBox",
    [&message](QMessageBox& box)
    {
      message = box.text();
      QCOMPARE(box.textFormat(), Qt::PlainText); // names are no HTML
      box.accept();
    });
}

/// The button opens a dialog for folders that begins in the line's; cancelled, it changes nothing.
void browseFor(QPushButton* button, const QLineEdit* line, const QString& folder);

/// Whatever opens is closed again; the unsaved question is answered with Discard.
inline void closeWhatIsOpen()
{
  if (QWidget* const menu = QApplication::activePopupWidget())
  {
    menu->close();
  }
  else if (auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget()))
  {
    QAbstractButton* const discard = box->button(QMessageBox::Discard);
    (discard != nullptr ? discard : box->buttons().first())->click();
  }
  else if (auto* dialog = qobject_cast<QDialog*>(QApplication::activeModalWidget()))
  {
    dialog->reject();
  }
}

/// The window speaks German as long as this lives.
class German
{
public:
  German() { dgtk::setEditorLanguage("de"); }
  ~German()
  {
    for (QTranslator* translator : qApp->findChildren<QTranslator*>())
    {
      delete translator;
    }
  }
  German(const German&) = delete;
  German& operator=(const German&) = delete;
};

/// What the program holds on the heap, MiB.
inline double heapInUse()
{
  constexpr double mebibyte = 1 << 20;
  if (__sanitizer_get_current_allocated_bytes)
  {
    return double(__sanitizer_get_current_allocated_bytes()) / mebibyte;
  }
  const auto info = ::mallinfo2();
  return double(info.uordblks + info.hblkhd) / mebibyte;
}

/// All files below a folder, by their path.
inline QMap<QString, QByteArray> contents(const QString& folder)
{
  QMap<QString, QByteArray> files;
  for (QDirIterator at(folder, QDir::Files, QDirIterator::Subdirectories); at.hasNext();)
  {
    QFile file(at.next());
    if (file.open(QIODevice::ReadOnly))
    {
      files[QDir(folder).relativeFilePath(file.fileName())] = file.readAll();
    }
  }
  return files;
}

/// Processes of `dgtk render` that windows of this program's data folder started, and that live.
QList<pid_t> livingRuns();

/// Knows how long the window was busy with one event, since restart().
class TimedApplication : public QApplication
{
public:
  using QApplication::QApplication;

  bool notify(QObject* receiver, QEvent* event) override
  {
    if (this->Depth > 0 || !this->Watched)
    {
      return QApplication::notify(receiver, event);
    }
    ++this->Depth;
    QElapsedTimer clock;
    clock.start();
    const std::clock_t began = std::clock();
    const QString name = receiver->objectName(); // it may be gone afterwards
    const char* const className = receiver->metaObject()->className();
    const QEvent::Type type = event->type();
    const bool done = QApplication::notify(receiver, event);
    // On a busy machine the time that others took does not count; with threads of their own it is not less than this.
    const double spent = std::min(clock.nsecsElapsed() * 1e-6, 1000.0 * double(std::clock() - began) / CLOCKS_PER_SEC);
    if (spent > this->Longest)
    {
      this->Longest = spent;
      this->What = QString("%1 (%2), event %3").arg(name, className).arg(type);
    }
    --this->Depth;
    return done;
  }

  void restart()
  {
    this->Watched = true;
    this->Longest = 0;
  }
  double longest() const { return this->Longest; } ///< milliseconds
  QString what() const { return this->What; }

private:
  int Depth = 0;
  bool Watched = false; ///< from the first restart() on
  double Longest = 0;
  QString What;
};

/// Runs the cases of a class in an application of their own.
template <typename Test>
int runEditorTest(int argc, char** argv)
{
  qputenv("QTEST_FUNCTION_TIMEOUT", QByteArray::number(longestCase));
  dgtk::MainWindow::prepareApplication();
  TimedApplication application(argc, argv);
  dgtk::MainWindow::setupApplication();
  Test test;
  return QTest::qExec(&test, argc, argv);
}

/// What the program does when `word` is its first argument; the function gets the others.
struct EditorTestRow
{
  EditorTestRow(const char* word, int (*run)(int, char**));
};

/// Adds a class of cases, by its name.
#define DGTK_EDITOR_TEST(Class) static const EditorTestRow rowOf##Class(#Class, runEditorTest<Class>)

#endif
