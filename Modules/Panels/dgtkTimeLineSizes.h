// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTimeLineSizes_h
#define dgtkTimeLineSizes_h

// Private to Panels.

namespace dgtk::timeline
{

// Pixels of the time line.
constexpr int cellWidth = 12;
constexpr int rowHeight = 18;
constexpr int barHeight = 16; ///< more, for a row with a sequence
constexpr int headerHeight = 26;
constexpr int headerMarks = 11; ///< the header's lower part, with the marks of key frames
constexpr int namesWidth = 130;
constexpr int edgeWidth = 4; ///< of a bar, to both sides

constexpr int numberEvery = 5;
constexpr int fewestFrames = 60;
constexpr int framesAfterLast = 30;

} // namespace dgtk::timeline

#endif
