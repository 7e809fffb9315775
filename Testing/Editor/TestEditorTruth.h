// SPDX-License-Identifier: BSD-3-Clause
#ifndef TestEditorTruth_h
#define TestEditorTruth_h

#include "EditorTest.h"

class TestEditorTruth : public EditorTest
{
  Q_OBJECT

private slots:
  void layersReplaceColour();
  void pictures();
};

#endif
