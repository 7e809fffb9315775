// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkItemDialogs_h
#define dgtkItemDialogs_h

#include "dgtkEditorState.h"
#include "dgtkPanelsModule.h"

#include <QDialog>
#include <QStringList>

#include <functional>
#include <utility>

class QCheckBox;
class QComboBox;
class QFormLayout;
class QLineEdit;

namespace dgtk
{

class NumberRow;

/// The thesis's figure A.4: eye, look-at point, up, lens, near and far of a new camera. The lens is given
/// by its field of view, or by the matrix K with the size of the image.
class DGTKPANELS_EXPORT CameraDialog : public QDialog
{
  Q_OBJECT

public:
  /// Begins with these values.
  CameraDialog(const CameraDescription& camera, QWidget* parent);
  CameraDescription camera() const;
  /// Add: takes the camera. Where it is refused (false) the dialog stays open.
  void onAdd(std::function<bool(const CameraDescription&)> add) { this->Adder = std::move(add); }
  void accept() override;

signals:
  /// Preview: look through it.
  void previewAsked();

private:
  /// Only the rows of the lens can be used. A matrix that is asked for begins as what the field of view says.
  void showLens();

  std::function<bool(const CameraDescription&)> Adder;
  QLineEdit* Name = nullptr;
  NumberRow* Eye = nullptr;
  NumberRow* LookAt = nullptr;
  NumberRow* Up = nullptr;
  QComboBox* Lens = nullptr;
  NumberRow* Fov = nullptr;
  NumberRow* Aspect = nullptr;
  NumberRow* K = nullptr; ///< fx, fy, cx, cy
  NumberRow* Size = nullptr;
  NumberRow* Range = nullptr;
};

/// The kinds of light in the language of the window, in the order of lightKinds(), and where one of them is.
QStringList lightKindNames();
int lightKindPlace(LightKind kind);

/// The thesis's figure A.3: kind, position and colours of a new light.
class DGTKPANELS_EXPORT LightDialog : public QDialog
{
  Q_OBJECT

public:
  LightDialog(const LightDescription& light, QWidget* parent);
  LightDescription light() const;
  /// As CameraDialog::onAdd().
  void onAdd(std::function<bool(const LightDescription&)> add) { this->Adder = std::move(add); }
  void accept() override;

private:
  void refreshKind();
  const LightTraits& kind() const;

  std::function<bool(const LightDescription&)> Adder;
  QLineEdit* Name = nullptr;
  QComboBox* Kind = nullptr;
  QCheckBox* Enabled = nullptr;
  NumberRow* Position = nullptr;
  NumberRow* Target = nullptr;
  NumberRow* Diffuse = nullptr;
  NumberRow* Specular = nullptr;
  NumberRow* Ambient = nullptr;
  NumberRow* Intensity = nullptr;
  NumberRow* Attenuation = nullptr;
  NumberRow* Cone = nullptr;
  NumberRow* Exponent = nullptr;
};

} // namespace dgtk

#endif
