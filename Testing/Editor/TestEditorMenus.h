// SPDX-License-Identifier: BSD-3-Clause
#ifndef TestEditorMenus_h
#define TestEditorMenus_h

#include "EditorTest.h"

#include <QAction>
#include <QList>
#include <QPointer>

/// Each item of the menus does something.
class TestEditorMenus : public EditorTest
{
  Q_OBJECT

private slots:
  void everyMenuItemWorks();
  void lettersOfMenusDiffer();
  void smallScreensHaveRoom();
  void tabStaysOnTheScreen();
  void helpNamesTheKeys();
  void whatIsDeletedWithAnObjectIsNamed();
  void wordsHaveRoom();
  void theLayoutComesBack();

private:
  QList<QPointer<QAction>> menuItems() const;
  void prepareFor(const QAction& item) const;
  /// The demo scene with few of its objects: it is opened for each item.
  QString fewObjects() const;
};

#endif
