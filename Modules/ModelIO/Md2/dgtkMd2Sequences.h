// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkMd2Sequences_h
#define dgtkMd2Sequences_h

#include "dgtkModel.h"

#include <string>
#include <vector>

namespace dgtk
{

/// Sequences of frames that share the prefix of their names, in file order, 10 frames a second. A frame's number is the
/// one or two digits at the end of its name (`stand01`; `pain101` is frame 01 of pain1); all digits where they count on
/// beyond a hundred or start with 0 (`frame099`, `frame100`).
std::vector<Animation> sequencesOf(const std::vector<std::string>& frameNames);

/// Animations of a text of lines `name start end fps`, `//` comments; lines that do not fit `frames` frames are left
/// out and named in `warnings`.
std::vector<Animation> parseAnm(
  const std::string& text, const std::string& path, int frames, std::vector<std::string>& warnings);

} // namespace dgtk

#endif
