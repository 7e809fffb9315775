// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPixelValues.h"

#include <gtest/gtest.h>

namespace
{
using dgtk::PixelType;

/// Rows 5 and 6 of an image two pixels wide, whose channels are 1, 2, 3 and so on.
template <typename T>
dgtk::Rows counted(PixelType type, int channels)
{
  dgtk::Rows rows(type, channels, 2, 5, 2);
  for (int i = 0; i < 4 * channels; ++i)
  {
    rows.row<T>(5)[i] = T(i + 1);
  }
  return rows;
}

/// Of three channels, counted.
void expectNumbers(const dgtk::Rows& rows)
{
  EXPECT_EQ(dgtk::valueAt(rows, 0, 5), 1);
  EXPECT_EQ(dgtk::valueAt(rows, 1, 5, 2), 6);
  EXPECT_EQ(dgtk::valueAt(rows, 1, 6, 1), 11);
  double values[2] = { 0, 0 };
  dgtk::copyValues(rows, 0, 6, 2, values);
  EXPECT_EQ(values[0], 7);
  EXPECT_EQ(values[1], 8);
}

TEST(PixelValues, ChannelsOfEachTypeAreNumbers)
{
  expectNumbers(counted<std::uint8_t>(PixelType::UInt8, 3));
  expectNumbers(counted<std::uint16_t>(PixelType::UInt16, 3));
  expectNumbers(counted<std::uint32_t>(PixelType::UInt32, 3));
  expectNumbers(counted<float>(PixelType::Float32, 3));
  expectNumbers(counted<double>(PixelType::Float64, 3));
}

TEST(PixelValues, ThreeChannelsAreTheBytesOfAnIdWhateverTheirType)
{
  EXPECT_EQ(dgtk::idAt(counted<std::uint8_t>(PixelType::UInt8, 3), 1, 5), 0x040506u);
  EXPECT_EQ(dgtk::idAt(counted<std::uint8_t>(PixelType::UInt8, 3), 0, 6), 0x070809u);
  EXPECT_EQ(dgtk::idAt(counted<std::uint16_t>(PixelType::UInt16, 3), 1, 6), 0x0A0B0Cu);
  EXPECT_EQ(dgtk::idAt(counted<float>(PixelType::Float32, 4), 1, 5), 0x050607u);
}

TEST(PixelValues, OneChannelIsTheIdItself)
{
  dgtk::Rows rows = counted<std::uint32_t>(PixelType::UInt32, 1);
  rows.row<std::uint32_t>(6)[1] = 16777217; // single precision has no such number
  EXPECT_EQ(dgtk::idAt(rows, 1, 5), 2u);
  EXPECT_EQ(dgtk::idAt(rows, 1, 6), 16777217u);
  EXPECT_EQ(dgtk::idAt(counted<std::uint8_t>(PixelType::UInt8, 1), 0, 6), 3u);
}
} // namespace
