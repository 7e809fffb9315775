// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRenderCameras_h
#define dgtkRenderCameras_h

#include "dgtkEditorState.h"
#include "dgtkScenePlaces.h"

#include <QSize>
#include <QStringList>
#include <QWidget>

#include <functional>
#include <optional>

class QCheckBox;
class QGridLayout;
class QLabel;
class QListWidget;
class QSlider;
class QSpinBox;

namespace dgtk
{

class NumberRow;

/// The page Cameras of the render configuration, after the thesis's figure 4.15: which cameras are rendered, and of the
/// chosen one the field of view, aspect, near and far plane, size and the world units that a pixel stands for. Its
/// numbers are those of the scene.
class RenderCameras : public QWidget
{
  Q_OBJECT

public:
  RenderCameras(EditorState& state, QWidget* parent);

  int count() const;
  QStringList checked() const;
  /// Of all images; none where each camera has its own.
  std::optional<QSize> commonSize() const;

private:
  void addSizeRow(QGridLayout* grid, int row, const QString& label, const QString& name, int axis);
  NumberRow* addNumber(QGridLayout* grid, int row, int column, QLabel* label, const QString& name,
    const std::function<void(CameraDescription&, double)>& set);
  void refresh();
  void showCamera();
  void showLens();
  void showSize();
  void takeSize();
  void showResolution();
  const CameraDescription* chosen() const;
  SceneItem chosenItem() const;

  EditorState& State;
  QListWidget* Cameras = nullptr;
  QLabel* FovLabel = nullptr;
  NumberRow* Fov = nullptr;
  NumberRow* Aspect = nullptr;
  NumberRow* Near = nullptr;
  NumberRow* Far = nullptr;
  QCheckBox* OwnSize = nullptr;
  QSlider* Sliders[2] = { nullptr, nullptr };
  QSpinBox* Size[2] = { nullptr, nullptr };
  int CommonSize[2] = { usualImageSize[0], usualImageSize[1] };
  QLabel* Resolution = nullptr;
};

} // namespace dgtk

#endif
