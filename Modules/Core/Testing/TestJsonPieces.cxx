// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkJsonPieces.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

using namespace dgtk;
using dgtk::test::TemporaryFolder;

namespace
{
/// Longer than what is read at a time, so that elements lie across blocks.
std::string longList(int count)
{
  std::string text = "{\n  \"name\": \"x\", // a comment with [ ] { }\n  \"files\": [";
  for (int i = 0; i < count; ++i)
  {
    text += std::string(i > 0 ? "," : "") + "\n    {\"id\": " + std::to_string(i) + ", \"t\": \"a\\\"]},[{" +
            std::string(std::size_t(i % 100), 'x') + "\", \"v\": [1, [2.5, -3]]}";
  }
  return text + "\n  ],\n  \"other\": [1, 2, 3]\n}\n";
}
} // namespace

TEST(JsonPieces, ElementsAreThoseOfTheWholeDocument)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("long.json");
  constexpr int count = 5000;
  const std::string text = longList(count);
  writeFile(path, text);
  const JsonDocument whole = parseJson(path, text);
  const JsonCursor files = JsonCursor(whole)["files"];
  int seen = 0;
  std::vector<JsonPiece> places;
  const JsonDocument rest = readJsonPieces(path, { { "files", [&](const JsonPiece& piece)
                                                   {
                                                     const JsonCursor other = files.element(std::size_t(seen));
                                                     EXPECT_EQ(piece.value["id"].number(), seen);
                                                     EXPECT_EQ(piece.value["t"].text(), other["t"].text());
                                                     EXPECT_EQ(piece.value["v"].element(1).element(1).number(), -3);
                                                     EXPECT_EQ(piece.value.line(), other.line());
                                                     EXPECT_EQ(text[piece.begin], '{');
                                                     EXPECT_EQ(text[piece.end - 1], '}');
                                                     const JsonDocument again = parseJson(
                                                       path, text.substr(piece.begin, piece.end - piece.begin));
                                                     EXPECT_EQ(JsonCursor(again)["id"].number(), seen);
                                                     ++seen;
                                                   } } });
  EXPECT_EQ(seen, count);
  EXPECT_EQ(JsonCursor(rest)["files"].listSize(), 0U);
  EXPECT_EQ(JsonCursor(rest)["other"].listSize(), 3U);
  EXPECT_EQ(JsonCursor(rest)["name"].text(), "x");
}

TEST(JsonPieces, ARangeIsReadAsAList)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("long.json");
  writeFile(path, longList(2000));
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
  readJsonPieces(path, { { "files", [&](const JsonPiece& piece)
                         {
                           const double id = piece.value["id"].number();
                           begin = id == 1200 ? piece.begin : begin;
                           end = id == 1202 ? piece.end : end;
                         } } });
  const JsonDocument three = readJsonPieces(path, begin, end, "files");
  EXPECT_EQ(JsonCursor(three).listSize(), 3U);
  EXPECT_EQ(JsonCursor(three).element(2)["id"].number(), 1202);
}

TEST(JsonPieces, ErrorsNameTheElement)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("bad.json");
  const auto said = [&](const std::string& text)
  {
    writeFile(path, text);
    const auto number = [](const JsonPiece& piece) { piece.value["id"].number(); };
    return test::thrownBy<InputError>([&] { readJsonPieces(path, { { "files", number } }); });
  };
  EXPECT_NE(said("{\"files\": [{\"id\": 1},\n{\"ip\": 2}]}").find(":2: files[1].id is missing"), std::string::npos);
  EXPECT_NE(said("{\"files\": [{\"id\": 1},\n{\"id\": 2, \"id\": 3}]}").find("given twice"), std::string::npos);
  EXPECT_NE(said("{\"files\": [{\"id\": 1}").find("is not valid JSON"), std::string::npos);
  EXPECT_NE(said("").find("is not valid JSON"), std::string::npos);
  EXPECT_NE(said(std::string("{\"files\": [{\"id\": 1}]}\n\0", 24)).find(":2: is not valid JSON"), std::string::npos);
  EXPECT_EQ(said("[[{\"id\": 1}]]"), "");
  EXPECT_THROW(readJsonPieces(folder.path("none.json"), {}), InputError);
  EXPECT_THROW(readJsonPieces(folder.path(""), {}), InputError);
}
