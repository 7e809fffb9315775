// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkVerificationCalls_h
#define dgtkVerificationCalls_h

#include "dgtkExportVerification.h"
#include "dgtkOnDemand.h"
#include "dgtkSampleVerification.h"
#include "dgtkVerification.h"

namespace dgtk
{

/// The functions of this module, for programs that load it when they verify: see dgtkOnDemand.h.
struct VerificationCalls
{
  decltype(&dgtk::verifyDataset) verifyDataset;
  decltype(&dgtk::verifyExport) verifyExport;
  decltype(&dgtk::verifySamples) verifySamples;
  decltype(&dgtk::isSampleFolder) isSampleFolder;
  decltype(&dgtk::verificationChecks) checks;
  decltype(&dgtk::verificationTable) table;
  decltype(&dgtk::verificationText) text;
  std::string (*describe)(const Residual&);
};

inline const VerificationCalls& verification() { return onDemand<VerificationCalls>("dgtkVerification"); }

} // namespace dgtk

extern "C" DGTKVERIFICATION_EXPORT const dgtk::VerificationCalls* dgtkVerificationCalls();

#endif
