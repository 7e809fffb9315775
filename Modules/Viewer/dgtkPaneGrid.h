// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPaneGrid_h
#define dgtkPaneGrid_h

#include "dgtkPicturePane.h"

#include <QScrollArea>

#include <memory>
#include <optional>
#include <vector>

class QGridLayout;

namespace dgtk
{

/// The pictures side by side, all of one size and one zoom; one of them is the active one, or is shown alone.
class PaneGrid : public QScrollArea
{
  Q_OBJECT

public:
  PaneGrid(PictureSync& sync, QWidget* parent);

  void setDataset(const std::shared_ptr<const DatasetPictures>& dataset);
  void setCount(int count);
  const std::vector<PicturePane*>& panes() const { return this->Panes; }
  /// Null while there is none.
  PicturePane* active() const;
  /// This one alone, or all again.
  void maximize(int pane);
  /// The active picture has the keyboard, unless another one has it or something is being typed.
  void takeKeys();
  void fit();
  void actualSize();
  /// About the crosshair.
  void zoom(double factor);

signals:
  void dropped(int pane);
  void activated();
  void arranged();
  /// Another picture is chosen in a pane.
  void chosen(dgtk::PicturePane* pane);
  void rangeAsked(const dgtk::PicturePane* pane, const std::optional<dgtk::PictureRange>& range);
  void detailWanted(const dgtk::PicturePane* pane, const dgtk::PixelRect& window, int step);

private:
  PicturePane* makePane(int number);
  void layOut();
  void setLowest();
  int columns() const;
  void stackNames();
  void setActive(int pane);
  void refreshArea();

  PictureSync& Sync;
  QGridLayout* Grid;
  std::shared_ptr<const DatasetPictures> Dataset;
  std::vector<PicturePane*> Panes;
  int Active = 0;
  int Maximized = -1;
  int Columns = 0;
};

} // namespace dgtk

#endif
