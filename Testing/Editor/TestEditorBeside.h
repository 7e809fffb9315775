// SPDX-License-Identifier: BSD-3-Clause
#ifndef TestEditorBeside_h
#define TestEditorBeside_h

#include "EditorTest.h"

#include <functional>

/// The window beside a run, by the clock and by what it does without a run: no other such test may run at the same
/// time.
class TestEditorBeside : public EditorTest
{
  Q_OBJECT

private slots:
  void theWindowAnswersWhileItRenders();

private:
  /// How long events took, milliseconds, while somebody worked in the window.
  struct Answers
  {
    int rounds = 0;
    double longest = 0;
    QString what;
    double late = 0; ///< of a timer, in the middle of the rounds
  };
  Answers stir(int milliseconds, const std::function<bool()>& goesOn);
};

#endif
