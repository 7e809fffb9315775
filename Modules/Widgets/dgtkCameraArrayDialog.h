// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkCameraArrayDialog_h
#define dgtkCameraArrayDialog_h

// Private to Widgets.

#include "dgtkCameraArray.h"

#include <QDialog>

class QComboBox;
class QFormLayout;
class QSpinBox;

namespace dgtk
{

class NumberRow;

/// Several cameras at once, around or beside a first one.
class CameraArrayDialog : public QDialog
{
  Q_OBJECT

public:
  CameraArrayDialog(const CameraDescription& first, QWidget* parent);
  CameraArrayOptions options() const;

private:
  /// Only the rows that the kind needs can be used.
  void showKind();

  CameraDescription First;
  QComboBox* Kind = nullptr;
  NumberRow* Eye = nullptr;
  NumberRow* LookAt = nullptr;
  NumberRow* Fov = nullptr;
  QSpinBox* Count = nullptr;
  QSpinBox* Columns = nullptr;
  QSpinBox* Rows = nullptr;
  NumberRow* Spacing = nullptr;
};

} // namespace dgtk

#endif
