// SPDX-License-Identifier: BSD-3-Clause
#ifndef TestEditorForest_h
#define TestEditorForest_h

#include "EditorTest.h"

#include <QPoint>

#include <functional>
#include <string>

class QWidget;

/// A large scene: it opens soon, and no event takes long.
class TestEditorForest : public EditorTest
{
  Q_OBJECT

private slots:
  void aForestOpensAndAnswersAtOnce();
  void aForestIsCopiedAtOnce();
  void copiesLookAsIfEachWereAlone();
  void whatIsOutOfSightIsNotMadeCoarser();
  void twoHundredThousandTrianglesTurn();
  void copiesShareTheirGeometry();

private:
  void openForest(const std::string& model, int side, int cameras) const;
  QWidget* view(int kind) const;
  void moveTo(int kind, const QPoint& at) const;
  /// Whether no event takes long while something is done and shown: once, of a few times.
  bool isQuick(const char* what, const std::function<void(int)>& act) const;
};

#endif
