// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkVerificationCalls.h"

const dgtk::VerificationCalls* dgtkVerificationCalls()
{
  static const dgtk::VerificationCalls calls{ &dgtk::verifyDataset, &dgtk::verifyExport, &dgtk::verifySamples,
    &dgtk::isSampleFolder, &dgtk::verificationChecks, &dgtk::verificationTable, &dgtk::verificationText,
    &dgtk::describe };
  return &calls;
}
