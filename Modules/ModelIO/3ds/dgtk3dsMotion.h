// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtk3dsMotion_h
#define dgtk3dsMotion_h

#include "dgtkByteReader.h"

namespace dgtk
{

/// How many objects of a 3DS file its key framer moves: tracks of theirs have several keys. Damage moves nothing.
std::size_t countMoving3ds(const ByteReader& in);

} // namespace dgtk

#endif
