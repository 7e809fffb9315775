// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkMatchDialog_h
#define dgtkMatchDialog_h

#include "dgtkEditorState.h"
#include "dgtkLiveMatch.h"
#include "dgtkLiveTruth.h"
#include "dgtkMatchTable.h"
#include "dgtkMatchesModule.h"
#include "dgtkNewestTask.h"

#include <QDialog>

#include <array>
#include <memory>
#include <optional>

class QCheckBox;
class QComboBox;
class QFormLayout;
class QLabel;
class QPushButton;
class QSpinBox;
class QVBoxLayout;

namespace dgtk
{

class MatchPane;

/// Two views of the scene side by side: where a point of one is in the other, and whether it is seen there.
class DGTKMATCHES_EXPORT MatchDialog : public QDialog
{
  Q_OBJECT

public:
  MatchDialog(EditorState& state, QWidget* parent);
  ~MatchDialog() override;

  /// Reads and writes lists as `dgtk correspond`. False, after EditorState::failed(), when that was refused.
  Q_INVOKABLE bool openPairs(const QString& path);
  Q_INVOKABLE bool savePairs(const QString& path);
  /// Asks about pairs that are not saved; false: keep them.
  bool mayDiscard();

protected:
  void showEvent(QShowEvent* event) override;

private:
  struct Side
  {
    QComboBox* camera = nullptr;
    QSpinBox* frame = nullptr;
    MatchPane* pane = nullptr;
    QLabel* where = nullptr; ///< image point under the mouse
    std::optional<MatchView> view;
    std::unique_ptr<LiveTruth> truth;
  };
  /// The point that is looked at.
  struct Point
  {
    std::size_t side = 0;
    Eigen::Vector2d pixel{ 0, 0 };
  };

  QWidget* makeSide(std::size_t side);
  void makeControls(QVBoxLayout* layout);
  QWidget* makeNumbers();
  QWidget* makePairs();
  QLabel* addNumber(QFormLayout* form, const QString& label, const char* name);

  void refresh();
  void refreshCameras();
  void chooseSelected();
  void showView(std::size_t side);
  void askPicture(std::size_t side);
  void pick(std::size_t side, const Eigen::Vector2d& pixel);
  void move(std::size_t side, const Eigen::Vector2d& step);
  void askMatch();
  void receive(const Point& point, const LiveMatch& match);
  void showMatch();
  void showMarks();
  void showPair(int row);
  /// Marks the pairs that the scene has otherwise by now.
  void checkPairs();
  void addPair();
  void askOpen();
  bool askSave();
  void swapSides();
  void refreshButtons();
  SparseView sparseView(std::size_t side) const;

  EditorState& State;
  std::shared_ptr<const LiveScene> Scene;
  std::array<Side, 2> Sides;
  QComboBox* Layer = nullptr;
  QCheckBox* Centers = nullptr;
  MatchTable* Table = nullptr;
  std::string Saved; ///< the pairs as they were last saved or opened
  std::optional<Point> Active;
  std::optional<LiveMatch> Match; ///< of the active point
  bool Changed = true;            ///< the scene, since it was shown
  std::size_t Opened = 0;         ///< SceneDocument::opened() of it
  std::size_t Checks = 0;         ///< of the list
  NewestTask Checker;
  NewestTask Matcher; ///< last: its thread ends first
};

} // namespace dgtk

#endif
