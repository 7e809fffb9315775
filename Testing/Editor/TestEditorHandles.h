// SPDX-License-Identifier: BSD-3-Clause
#ifndef TestEditorHandles_h
#define TestEditorHandles_h

#include "EditorTest.h"

#include <Eigen/Core>

#include <QPoint>
#include <QString>

class QWidget;

namespace dgtk
{
class SceneDocument;
class ViewCamera;
struct ObjectDescription;
} // namespace dgtk

/// Handles, the menu of items, new cameras, and the thesis's walk-through A.2.
class TestEditorHandles : public EditorTest
{
  Q_OBJECT

private slots:
  void arrowsMove();
  void squaresAndKeysKeepToPlanes();
  void ringsRotate();
  void boxesScale();
  void modelsFarFromTheirOriginTurnInPlace();
  void severalTurnAboutTheirCommonBox();
  void controlSnaps();
  void escapePutsBack();
  void keysAtTheCurrentFrame();
  void childrenMoveInTheWorld();
  void turnsThatShearSaySo();
  void camerasAndLightsTurn();
  void everyViewMovesTheSame();
  void theContextMenu();
  void renamesInTheTree();
  void aCameraByItsMatrix();
  void camerasAlongAPath();
  void theScenesLightsLightTheViews();
  void theThesissStaticScene();
  void pictures();

private:
  QWidget* view(int kind) const;
  /// The camera that a view has after Frame all.
  dgtk::ViewCamera camera(int kind) const;
  Eigen::Vector2d exactPixelOf(int kind, const Eigen::Vector3d& point) const;
  /// The nearest whole one.
  QPoint pixelOf(int kind, const Eigen::Vector3d& point) const;
  /// World units of a pixel in a parallel view.
  double unit(int kind) const;
  /// One crate, selected, with handles at its origin, and everything in sight.
  void openCrate();
  const dgtk::ObjectDescription& object(std::size_t index = 0) const;
  bool told(const QString& words) const;
  void press(int kind, const QPoint& at) const;
  void move(int kind, const QPoint& at, Qt::KeyboardModifiers modifiers = Qt::NoModifier) const;
  void release(int kind, const QPoint& at) const;
  void drag(int kind, const QPoint& from, const QPoint& to, Qt::KeyboardModifiers modifiers = Qt::NoModifier) const;
  /// Chooses an item of the menu that a right click opens.
  static void choose(QWidget* widget, const QPoint& at, const QString& name);

  dgtk::SceneDocument& document() const;
};

/// Whether two places are the same.
constexpr double handleTolerance = 1e-9; // world units, of motions of a few units
inline bool near(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return (a - b).norm() < handleTolerance; }

#endif
