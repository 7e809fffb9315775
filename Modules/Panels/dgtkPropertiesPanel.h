// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPropertiesPanel_h
#define dgtkPropertiesPanel_h

#include "dgtkEditorState.h"
#include "dgtkPanelsModule.h"

#include <QScrollArea>
#include <QStringList>

#include <functional>
#include <optional>
#include <string>
#include <vector>

class QFormLayout;

namespace dgtk
{

class NumberRow;

/// The values of what is selected, at the current frame; without a selection those of the scene. Of several things the
/// one selected first is shown, and changes are made to all that have the same rows.
class DGTKPANELS_EXPORT PropertiesPanel : public QScrollArea
{
  Q_OBJECT

public:
  PropertiesPanel(EditorState& state, QWidget* parent);

private:
  using Numbers = std::vector<double>;
  using GetNumbers = std::function<Numbers(const SceneDescription&)>;
  using SetNumbers = std::function<void(SceneDescription&, const Numbers&)>;

  void rebuild();
  /// The rows of the same item have changed.
  void rebuildKeepingFocus();
  void refresh();
  /// As if what is being typed were confirmed.
  void takeTyped();
  void buildObject(std::size_t index);
  /// When the model has sequences.
  void buildSequence(std::size_t index);
  void buildLight(std::size_t index);
  void buildCamera(std::size_t index);
  void buildLens(std::size_t index);
  /// What the camera's model has besides.
  void buildParameters(std::size_t index);
  /// What belongs to no item.
  void buildScene();
  /// Another text where the rows of the item shown, or their names, are others.
  QString rowsWanted() const;
  QString withUnits(const QString& label) const;

  void addLine(const QString& label, const QString& text);
  void addText(const QString& label, const QString& name,
    const std::function<std::string(const SceneDescription&)>& get,
    const std::function<void(SceneDescription&, const std::string&)>& set, bool forAll);
  NumberRow* addNumbers(
    const QString& label, const QString& name, int count, const GetNumbers& get, const SetNumbers& set);
  /// A value that does not move.
  void addNumber(const QString& label, const QString& name, const std::function<double&(SceneDescription&)>& value);
  void addVector(
    const QString& label, const QString& name, const std::function<Eigen::Vector3d&(SceneDescription&)>& value);
  void addTrack(const QString& label, const QString& name,
    const std::function<Track<Eigen::Vector3d>&(SceneDescription&)>& track, bool color = false);
  void addTrack(
    const QString& label, const QString& name, const std::function<Track<double>&(SceneDescription&)>& track);
  void addOrientation(const std::function<Track<Quaternion>&(SceneDescription&)>& track);
  void addTrack(const QString& label, const QString& name, const std::function<Track<bool>&(SceneDescription&)>& track);
  void addCheck(const QString& label, const QString& name, const std::function<bool&(SceneDescription&)>& value);
  void addCheck(const QString& label, const QString& name, const std::function<bool(const SceneDescription&)>& get,
    const std::function<void(SceneDescription&, bool)>& set);
  void addChoice(const QString& label, const QString& name, const QStringList& words,
    const std::function<int(const SceneDescription&)>& get, const std::function<void(SceneDescription&, int)>& set);
  /// The change is for the item shown; others that are selected take its place for a moment, to be changed likewise.
  void edit(const QString& label, const std::function<void(SceneDescription&)>& change);
  /// Others that are selected and have the rows that are being made.
  SceneItems others() const;

  EditorState& State;
  QFormLayout* Form = nullptr;
  std::optional<SceneItem> Item;                                  ///< none: the scene
  QString Rows;                                                   ///< rowsWanted() of what is shown
  std::vector<std::function<void(SceneDescription&)>> Refreshers; ///< they only read
};

/// Degrees about the fixed x, y and z axes, in this order, that make a rotation; and back.
DGTKPANELS_EXPORT Eigen::Vector3d degreesOf(const Quaternion& rotation);
DGTKPANELS_EXPORT Quaternion rotationOf(const Eigen::Vector3d& degrees);

} // namespace dgtk

#endif
