// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFrameLayers.h"

namespace dgtk
{

// One file each defines its maker.
std::shared_ptr<const FrameLayer> makeCorrespondenceLayer();
std::shared_ptr<const FrameLayer> makeDisparityLayer();
std::shared_ptr<const FrameLayer> makeSharpColorLayer();
std::shared_ptr<const FrameLayer> makeEdgesLayer();
std::shared_ptr<const FrameLayer> makeFlowForwardLayer();
std::shared_ptr<const FrameLayer> makeFlowBackwardLayer();
std::shared_ptr<const FrameLayer> makeSceneFlowLayer();
std::shared_ptr<const FrameLayer> makeLdiLayer();
std::shared_ptr<const FrameLayer> makeAlphaLayer();
std::shared_ptr<const FrameLayer> makeBoxesLayer();
std::shared_ptr<const FrameLayer> makeAmodalLayer();
std::shared_ptr<const FrameLayer> makePointsLayer();
std::shared_ptr<const FrameLayer> makeMattingLayer();
std::shared_ptr<const FrameLayer> makeCoverageLayer();
std::shared_ptr<const FrameLayer> makeNoisyColorLayer();
std::shared_ptr<const FrameLayer> makeNoisyDepthLayer();
std::shared_ptr<const FrameLayer> makePovLayer();

const std::vector<std::shared_ptr<const FrameLayer>>& frameLayers()
{
  static const std::vector<std::shared_ptr<const FrameLayer>> all{
    makeSharpColorLayer(),
    makeEdgesLayer(),
    makeCorrespondenceLayer(),
    makeDisparityLayer(),
    makeFlowForwardLayer(),
    makeFlowBackwardLayer(),
    makeSceneFlowLayer(),
    makeLdiLayer(),
    makeAlphaLayer(),
    makeCoverageLayer(),
    makeBoxesLayer(),
    makeAmodalLayer(),
    makePointsLayer(),
    makeMattingLayer(),
    makeNoisyColorLayer(),
    makeNoisyDepthLayer(),
    makePovLayer(),
  };
  return all;
}

} // namespace dgtk
