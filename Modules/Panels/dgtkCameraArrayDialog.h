// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkCameraArrayDialog_h
#define dgtkCameraArrayDialog_h

#include "dgtkCameraArray.h"
#include "dgtkPanelsModule.h"

#include <QDialog>

#include <functional>
#include <utility>
#include <vector>

class QComboBox;
class QLabel;
class QPlainTextEdit;
class QSpinBox;

namespace dgtk
{

class NumberRow;

/// Several cameras at once, around or beside a first one.
class DGTKPANELS_EXPORT CameraArrayDialog : public QDialog
{
  Q_OBJECT

public:
  /// `path`: what the array along a path begins with; may be empty.
  CameraArrayDialog(const CameraDescription& first, const CameraPath& path, QWidget* parent);
  /// Add: takes the cameras.
  void onAdd(std::function<void(const std::vector<CameraDescription>&)> add) { this->Adder = std::move(add); }
  /// Stays open, and says why, where there are no such cameras or they are refused by an exception.
  void accept() override;

private:
  /// Throws UsageError for a path that cannot be read.
  CameraArrayOptions options() const;
  /// Only the rows that the kind needs can be used.
  void showKind();

  std::function<void(const std::vector<CameraDescription>&)> Adder;
  CameraDescription First;
  QComboBox* Kind = nullptr;
  NumberRow* Eye = nullptr;
  NumberRow* LookAt = nullptr;
  NumberRow* Fov = nullptr;
  QSpinBox* Count = nullptr;
  QSpinBox* Columns = nullptr;
  QSpinBox* Rows = nullptr;
  NumberRow* Spacing = nullptr;
  QPlainTextEdit* Path = nullptr;
  QLabel* Fault = nullptr;
};

} // namespace dgtk

#endif
