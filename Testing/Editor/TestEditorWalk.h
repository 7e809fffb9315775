// SPDX-License-Identifier: BSD-3-Clause
#ifndef TestEditorWalk_h
#define TestEditorWalk_h

#include "EditorTest.h"

#include <QImage>

#include <functional>

class QPoint;
class QWidget;

/// The walk-throughs of the thesis's appendix A.2 and A.3 as a user makes them: by mouse and keys alone.
class TestEditorWalk : public EditorTest
{
  Q_OBJECT

private slots:
  void aStaticScene();
  void aDynamicScene();
  void aCameraOfTheThesis();
  void aParallelCamera();
  void aCameraOfATable();
  void lettersLeadToFields();
  void choicesAreKept();

private:
  void import(const char* model) const;
  void saveAs(const QString& path) const;
  void addCamera() const;
  QWidget* view(int kind) const;
  QWidget* cells() const;
  static QPoint cellOf(int frame);
  /// A drag that the window follows.
  void drag(int kind, const QPoint& from, const QPoint& to) const;
  /// Click on the frame, right click, Make key frame.
  void makeKeyFrame(int frame) const;
  /// Of a view, with what is drawn over it.
  QImage pictureOf(int kind) const;
  int greenPixels(int kind) const;
};

#endif
