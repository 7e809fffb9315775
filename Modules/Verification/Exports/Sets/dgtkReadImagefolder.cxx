// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFile.h"
#include "dgtkJsonFile.h"
#include "dgtkReadCards.h"
#include "dgtkReadTexts.h"
#include "dgtkUtf8.h"

#include <algorithm>
#include <sstream>

// huggingface.co/docs/datasets/image_dataset: ImageFolder.

namespace dgtk
{

namespace
{
using Json = nlohmann::json;

void judgeObjects(
  ExportJudge& judge, const std::string& file, const ExportedName& picture, const Json& line, const std::string& where)
{
  const std::vector<BoxRecord>& boxes = judge.source().boxes(picture.camera, picture.frame);
  const auto seen = std::count_if(boxes.begin(), boxes.end(), [](const BoxRecord& one) { return bool(one.visible); });
  const Json none{ { "id", Json::array() }, { "bbox", Json::array() }, { "category", Json::array() } };
  const Json& objects = line.count("objects") > 0 ? line.at("objects") : none;
  judge.exact("objects", "", file, where, double(objects.at("id").size()), double(seen));
  for (std::size_t i = 0; i < objects.at("id").size(); ++i)
  {
    const auto id = objects.at("id").at(i).get<std::uint32_t>();
    const auto box = objects.at("bbox").at(i).get<std::vector<double>>();
    judge.box(
      file, picture.camera, picture.frame, id, { box.at(0), box.at(1), box[0] + box.at(2), box[1] + box.at(3) }, 0);
    const ObjectRecord* object = judge.source().object(picture.camera, id);
    const std::string expected = object ? utf8FromBytes(object->objectClass) : "no such object";
    const std::string found = objects.at("category").at(i);
    judge.holds("category", file, where, found == expected, found, expected);
  }
}
} // namespace

void readImagefolder(ExportJudge& judge)
{
  const SampleDocuments documents(judge);
  std::set<std::string> pictures;
  for (const ExportedFile* one : filesIn(judge.source(), "", "jsonl"))
  {
    const std::string& file = one->file.path;
    std::istringstream text(readFile(judge.source().path(file)));
    useJson(judge.source().path(file),
      [&]
      {
        for (std::string line; std::getline(text, line);)
        {
          const Json entry = Json::parse(line);
          const std::string name = file.substr(0, file.rfind('/') + 1) + entry.at("file_name").get<std::string>();
          judge.holds("lines", file, name, pictures.insert(name).second, "a picture twice", "each once");
          if (const ExportedName* picture = pictureOf(judge, file, name))
          {
            documents.judge(file, name, picture->camera, picture->frame, entry);
            judgeObjects(judge, file, *picture, entry, name);
          }
        }
      });
  }
  judge.exact("pictures", "", "README.md", "", double(pictures.size()), double(judge.source().record().names.size()));
  judgeCards(judge, "jsonl");
}

} // namespace dgtk
