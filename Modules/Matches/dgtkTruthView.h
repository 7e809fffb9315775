// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTruthView_h
#define dgtkTruthView_h

#include "dgtkEditorState.h"
#include "dgtkLiveTruth.h"
#include "dgtkMatchesModule.h"
#include "dgtkSceneViews.h"

#include <QObject>
#include <QPoint>

#include <memory>
#include <optional>

class QAction;
class QActionGroup;
class QComboBox;
class QLabel;
class QMenu;

namespace dgtk
{

class TruthPanel;
class TruthPicture;

/// Ground truth in the perspective view: a chosen layer instead of colours, seen from the view's eye or, after Preview,
/// through a camera of the scene until the view is moved; and what is known about the pixel under the mouse.
class DGTKMATCHES_EXPORT TruthView : public QObject
{
  Q_OBJECT

public:
  TruthView(EditorState& state, SceneViews& views, QObject* parent);
  ~TruthView() override;

  /// The panel of values, without a parent: it goes into a dock.
  TruthPanel* panel() const { return this->Panel; }
  /// Fills a menu with a radio item for each layer.
  void fillMenu(QMenu* menu);
  /// Name of a live layer, empty: colour.
  void setLayer(const QString& layer);
  const QString& layer() const { return this->Layer; }

signals:
  /// One line about the pixel under the mouse, empty outside.
  void pointed(const QString& line);
  void layerChosen(const QString& layer);

protected:
  bool eventFilter(QObject* object, QEvent* event) override;

private:
  void lookThrough(const CameraDescription& camera);
  void leaveCamera();
  void ask();
  void askSoon();
  /// The scene or the view is another one: the values of a pixel that the mouse has left are of the past.
  void seeAnew();
  void askPixel(const QPoint& position);
  void receive(const LivePicture& picture, const QString& layer, const QSize& size, int number);
  void receive(const PixelTruth& truth);
  /// What the view looks at, as a camera; none before it has a size.
  std::optional<LiveQuestion> question();
  /// Whose picture covers the view; null: the view's own eye is seen.
  const CameraDescription* camera() const;
  /// Whether that is one of the scene; a preview may be of one that is not added yet.
  bool isListed() const;
  /// The layer that is seen: through a camera its own picture, also in colour. Empty: the view's drawing.
  QString shown() const;
  void showSubject();
  /// The pixel of the picture, column and row; none outside of it.
  std::optional<QPoint> pixelAt(const QPoint& position, const CameraModel& model) const;
  std::optional<WorldRay> rayAt(const QPoint& position);

  EditorState& State;
  SceneViews& Views;
  SceneView* const View3D;
  TruthPicture* Picture;
  TruthPanel* Panel;
  QComboBox* Choice;
  QLabel* Subject;
  QActionGroup* Group;
  std::shared_ptr<const LiveScene> Scene;  ///< null after a change
  std::shared_ptr<const LiveScene> Before; ///< the last one that was asked, of the same document
  std::size_t Opened = 0;                  ///< SceneDocument::opened() of it
  std::optional<CameraDescription> Through;
  bool Listed = false; ///< isListed(), at the last change
  QString Layer;
  QString Covering; ///< the layer whose picture covers the view, empty: none does
  bool AskWanted = false;
  int Asked = 0; ///< pictures
  std::optional<QPoint> Mouse;
  LiveTruth Truth; ///< last: its threads end first
};

} // namespace dgtk

#endif
