// SPDX-License-Identifier: BSD-3-Clause
#ifndef TestEditorBeside_h
#define TestEditorBeside_h

#include "EditorTest.h"

/// The window beside a run, by the clock: no other such test may run at the same time.
class TestEditorBeside : public EditorTest
{
  Q_OBJECT

private slots:
  void theWindowAnswersWhileItRenders();
};

#endif
