// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRenderOptions_h
#define dgtkRenderOptions_h

#include "dgtkOptionFields.h"

namespace dgtk
{

/// The page Options of the render configuration: a field for each option of a run.
class RenderOptions : public OptionFields
{
  Q_OBJECT

public:
  explicit RenderOptions(QWidget* parent);
  /// Options that only some layers have can be chosen with one of these, those of POV-Ray where it draws, too.
  void setLayers(const QStringList& layers);
  /// The text of an option of names, until another one is typed.
  void offer(const QString& name, const QString& text);

private:
  QStringList Layers;
};

} // namespace dgtk

#endif
