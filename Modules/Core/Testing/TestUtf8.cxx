// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkTestSupport.h"
#include "dgtkThreadPool.h"
#include "dgtkUtf8.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

using namespace dgtk;

TEST(Utf8, BytesThatAreNoCharactersComeBack)
{
  EXPECT_EQ(utf8FromBytes("caf\xe9.png"), "caf\xee\xbf\xa9.png"); // U+EFE9
  EXPECT_EQ(utf8FromBytes("\x80\xbf\xc0"), "\xee\xbe\x80\xee\xbe\xbf\xee\xbf\x80");
  EXPECT_EQ(bytesFromUtf8("caf\xee\xbf\xa9.png"), "caf\xe9.png");
  for (const char* plain : { "", "a.png", "caf\xc3\xa9", "\xf0\x9f\x99\x82", "\xee\xbd\xbf", "\xef\x80\x80", "\n\\" })
  {
    EXPECT_EQ(utf8FromBytes(plain), plain);
    EXPECT_EQ(bytesFromUtf8(plain), plain);
  }
  // a name that has one of the characters that stand for bytes
  EXPECT_EQ(utf8FromBytes("\xee\xbf\xa9"), "\xee\xbf\xae\xee\xbe\xbf\xee\xbe\xa9");
}

TEST(Utf8, EveryNameRoundTrips)
{
  std::mt19937 random(1);
  const std::string parts[] = { "a", "\xee", "\xbe", "\xbf", "\x80", "\xc3\xa9", "\xff", "\xed\xa0\x80", "\xf0\x9f" };
  for (int i = 0; i < 2000; ++i)
  {
    std::string name;
    for (unsigned n = random() % 12; n > 0; --n)
    {
      name += parts[random() % std::size(parts)];
    }
    const std::string text = utf8FromBytes(name);
    EXPECT_EQ(bytesFromUtf8(text), name);
    EXPECT_EQ(printable(text), text) << "valid UTF-8";
  }
}

TEST(Utf8, ErrorsAreOneLineOfUtf8)
{
  EXPECT_EQ(printable("\xe4\n\x7f\xc3\xa4"), "\\xE4\\x0A\\x7F\xc3\xa4");
  EXPECT_EQ(printable("a\xc2\x85\xc2\xa0\xe2\x80\xa8\xe2\x80\xa9\xe2\x80\xaa"),
    "a\\xC2\\x85\xc2\xa0\\xE2\\x80\\xA8\\xE2\\x80\\xA9\xe2\x80\xaa");
  EXPECT_STREQ(InputError("caf\xe9\n.ac", 3, "is bad").what(), "caf\\xE9\\x0A.ac:3: is bad");
  EXPECT_STREQ(UsageError("x\xff").what(), "x\\xFF");
  EXPECT_EQ(InputError("caf\xe9", "x").file(), "caf\xe9");
  // a character is not cut
  EXPECT_EQ(quoted(std::string(39, 'a') + "\xc3\xa9"), "'" + std::string(39, 'a') + "...'");
  EXPECT_EQ(quoted(std::string(38, 'a') + "\xc3\xa9"), "'" + std::string(38, 'a') + "\xc3\xa9'");
}

TEST(Utf8, SequencesAreThoseOfUnicodesTable)
{
  // Of each row of table 3-7 the first and the last.
  for (const char* const sequence :
    { "\x01", "\x7f", "\xc2\x80", "\xdf\xbf", "\xe0\xa0\x80", "\xe0\xbf\xbf", "\xe1\x80\x80", "\xec\xbf\xbf",
      "\xed\x80\x80", "\xed\x9f\xbf", "\xee\x80\x80", "\xef\xbf\xbf", "\xf0\x90\x80\x80", "\xf0\xbf\xbf\xbf",
      "\xf1\x80\x80\x80", "\xf3\xbf\xbf\xbf", "\xf4\x80\x80\x80", "\xf4\x8f\xbf\xbf" })
  {
    const std::string text(sequence);
    EXPECT_TRUE(isUtf8(text) && isUtf8("a" + text + text)) << printable(text);
    for (std::size_t end = 1; end < text.size(); ++end)
    {
      const std::string cut = text.substr(0, end);
      EXPECT_FALSE(isUtf8(cut) || isUtf8("a" + cut) || isUtf8(cut + "a")) << printable(cut);
    }
    for (std::size_t i = 1; i < text.size(); ++i)
    {
      for (const char none : { '\x7f', '\xc0' }) // beside 80 to BF
      {
        std::string wrong = text;
        wrong[i] = none;
        EXPECT_FALSE(isUtf8(wrong)) << printable(wrong);
      }
    }
  }
  EXPECT_TRUE(isUtf8(""));
  EXPECT_TRUE(isUtf8(std::string(1, '\0')));
  for (const char* const none : { "\x80", "\xbf", "\xc1\xbf", "\xc0\x80", "\xe0\x9f\xbf", "\xed\xa0\x80",
         "\xed\xbf\xbf", "\xf0\x8f\xbf\xbf", "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xff" })
  {
    EXPECT_FALSE(isUtf8(none)) << printable(none);
  }
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xED\\xA0\\x80");
}

TEST(Quoted, LongTextsAreCutBetweenCharactersAndNoFurtherBack)
{
  EXPECT_EQ(quoted(std::string(40, 'a')), "'" + std::string(40, 'a') + "'");
  EXPECT_EQ(quoted(std::string(41, 'a')), "'" + std::string(40, 'a') + "...'");
  EXPECT_EQ(quoted(std::string(39, 'a') + "\xc3\xa9z"), "'" + std::string(39, 'a') + "...'");
  std::string escaped;
  for (int i = 0; i < 37; ++i)
  {
    escaped += "\\x80";
  }
  EXPECT_EQ(quoted(std::string(60, '\x80')), "'" + escaped + "...'"); // no text at all
}

TEST(ThreadPool, OfSeveralFailuresTheFirstIndexIsReported)
{
  const auto failFrom7 = [](int i)
  {
    if (i >= 7)
    {
      throw UsageError(std::to_string(i));
    }
  };
  for (const int threads : { 1, 4 })
  {
    ThreadPool pool(threads);
    EXPECT_EQ(test::thrownBy<UsageError>([&] { pool.parallelFor(100, failFrom7); }), "7");
  }
}
