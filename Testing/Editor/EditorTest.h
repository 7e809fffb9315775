// SPDX-License-Identifier: BSD-3-Clause
#ifndef EditorTest_h
#define EditorTest_h

#include "dgtkTestSupport.h"

#include <QObject>
#include <QSize>
#include <QStringList>

#include <functional>
#include <memory>

class QAction;
class QCheckBox;
class QDialog;
class QLineEdit;
class QWidget;

namespace dgtk
{
class MainWindow;
}

/// What the editor's tests share: each case has a window of its own, with settings of its own.
class EditorTest : public QObject
{
  Q_OBJECT

public:
  EditorTest();
  ~EditorTest() override;

private slots:
  void initTestCase();
  void init();

protected slots:
  void cleanup();

protected:
  /// Of the window of each case: small, as half of the time is for pixels.
  virtual QSize windowSize(const QString& /*testCase*/) const { return { 1000, 720 }; }
  /// Not those that open windows themselves, or none.
  virtual bool hasWindow(const QString& /*testCase*/) const { return true; }
  QAction* action(const char* name) const;
  QLineEdit* field(const char* name) const;
  void type(const char* name, const QString& text) const;
  /// As type(), without Return.
  void typeOnly(const char* name, const QString& text) const;
  void select(const char* name) const;
  QString path(const char* name) const;
  /// Opens the action's menu in the menu bar and clicks it. Returns when dialogs that it opened have been answered.
  void choose(const char* name) const;
  /// Clicks an item of the context menu that `open` opens. Returns when the menu is closed.
  static void chooseInMenu(const QString& item, const std::function<void()>& open);
  /// A click into the field, the text instead of its own, and Tab.
  static void typeInto(QWidget* field, const QString& text);
  /// Clicks the page's tab.
  static void turnTo(const QDialog& dialog, int page);
  /// Clicks the box unless it is as wanted.
  static void check(QCheckBox* box, bool on);
  /// Renders by the dialog, and the scene file by the command line; both must hold the same bytes. By mouse and keys.
  void renderAndCompare(const QString& scene, const QStringList& layers, int width, int height) const;
  /// Some objects of the demo scene, its lights and cameras, in a file that a test may overwrite: it opens sooner.
  QString partOfDemo(const char* name, const QStringList& objects) const;
  /// Of objects that are usual.
  QString copyOfDemo() const;

  dgtk::test::TemporaryFolder Folder;
  std::unique_ptr<dgtk::MainWindow> Window;
};

#endif
