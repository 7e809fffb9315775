// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkCheck_h
#define dgtkCheck_h

#include "dgtkMeter.h"
#include "dgtkPicture.h"

namespace dgtk
{

/// One check: once for the dataset, or for each picture. Either function may be null. What throws an Error is a file
/// that cannot be used.
struct Check
{
  const char* name;
  void (*ofDataset)(Dataset&, Results&);
  void (*ofPicture)(Picture&, Results&);
};

void checkHashes(Dataset& dataset, Results& results);
void checkCameras(Dataset& dataset, Results& results);
void checkMetadata(Dataset& dataset, Results& results);
void checkPoses(Dataset& dataset, Results& results);
void checkModels(Dataset& dataset, Results& results);
void checkDepth(Picture& picture, Results& results);
void checkObjects(Picture& picture, Results& results);
void checkCalibration(Picture& picture, Results& results);
void checkGeometry(Picture& picture, Results& results);
void checkEdges(Picture& picture, Results& results);
void checkMotion(Picture& picture, Results& results);
void checkClass(Picture& picture, Results& results);
void checkEpipolar(Picture& picture, Results& results);
void checkTriangulation(Picture& picture, Results& results);
void checkForwardBackward(Picture& picture, Results& results);
void checkPartition(Picture& picture, Results& results);
void checkLdi(Picture& picture, Results& results);
void checkAlpha(Picture& picture, Results& results);
void checkMatting(Picture& picture, Results& results);
void checkRgba(Picture& picture, Results& results);
void checkBoxes(Picture& picture, Results& results);
void checkKeypoints(Picture& picture, Results& results);
void checkPoints(Dataset& dataset, Results& results);
void checkTracks(Dataset& dataset, Results& results);

} // namespace dgtk

#endif
