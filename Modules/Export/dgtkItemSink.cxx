// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkItemSink.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkHash.h"

#include <algorithm>
#include <stdexcept>

#include <fcntl.h>
#include <unistd.h>

namespace dgtk
{

namespace
{
DatasetFile describedAs(const std::string& name, const ExportedPixels& pixels)
{
  DatasetFile file;
  file.path = name;
  file.layer = pixels.layer;
  file.camera = pixels.shot ? pixels.shot->name() : "";
  file.frame = pixels.shot ? pixels.shot->frame() : -1;
  return file;
}
} // namespace

class ItemSink::Piecewise : public ExportFile
{
public:
  Piecewise(ItemSink& owner, const std::string& name, const ExportedPixels& pixels)
    : Owner(owner)
    , File(FilePlace(owner.Holder.path(), name))
    , Described(describedAs(name, pixels))
    , Encoding(pixels.encoding)
  {
  }
  using ExportFile::write;
  void write(const void* data, std::size_t bytes) override
  {
    this->File.write(data, bytes);
    this->Hash.update(data, bytes);
    this->Described.bytes += bytes;
  }
  void rewrite(std::uint64_t position, const std::string& text) override
  {
    this->File.writeAt(position, text.data(), text.size());
    this->Rewritten = true;
  }
  DatasetFile finish() override
  {
    this->File.commit();
    this->Described.sha256 =
      this->Rewritten ? Sha256::ofFile(this->Owner.Holder.fileAt(this->Described.path)) : this->Hash.hex();
    this->Owner.finished(this->Described, this->Encoding);
    return this->Described;
  }

private:
  ItemSink& Owner;
  AtomicFile File;
  Sha256 Hash;
  bool Rewritten = false;
  DatasetFile Described;
  PixelEncoding Encoding;
};

ItemSink::ItemSink(
  const DatasetView& dataset, const std::string& folder, const ExportItem& item, Journal& journal, bool links)
  : Dataset(dataset)
  , Holder(folder)
  , Item(item)
  , Log(journal)
  , Links(links)
{
  this->Record.names = item.names;
  if (!item.files.empty())
  {
    this->Log.plan(item.files);
  }
}

void ItemSink::expect(const std::string& name) const
{
  if (std::find(this->Item.files.begin(), this->Item.files.end(), name) == this->Item.files.end())
  {
    throw std::logic_error("an exporter writes a file that it has not announced: " + name);
  }
  this->Holder.makeParents(name);
}

std::unique_ptr<ExportFile> ItemSink::open(const std::string& name, const ExportedPixels& pixels)
{
  this->expect(name);
  return std::make_unique<Piecewise>(*this, name, pixels);
}

void ItemSink::finished(const DatasetFile& file, const PixelEncoding& encoding)
{
  this->Log.add(file);
  this->Record.files.push_back({ file, encoding });
}

bool linkFile(const std::string& path, const Folder& folder, const std::string& name)
{
  const std::string partial = partialName(name);
  folder.remove(partial);
  if (::linkat(AT_FDCWD, path.c_str(), AT_FDCWD, folder.pathOf(partial).c_str(), 0) != 0)
  {
    return false;
  }
  folder.rename(partial, name);
  folder.remove(partial); // rename() does nothing where both are the same file already
  return true;
}

void ItemSink::copy(const std::string& name, const std::string& datasetFile, const ExportedPixels& pixels)
{
  const DatasetFile known = this->Dataset.listed(datasetFile);
  this->expect(name);
  DatasetFile file = describedAs(name, pixels);
  file.sha256 = known.sha256;
  file.bytes = known.bytes;
  if (this->Links && Sha256::ofFile(Folder(this->Dataset.folder()).fileAt(datasetFile)) == known.sha256 &&
      linkFile(this->Dataset.pathOf(datasetFile), this->Holder, name))
  {
    this->finished(file, pixels.encoding);
    return;
  }
  const std::string bytes = this->Dataset.bytesOf(datasetFile);
  AtomicFile target(FilePlace(this->Holder.path(), name));
  target.write(bytes);
  target.commit();
  this->finished(file, pixels.encoding);
}

void ItemSink::notes(const std::string& list, const std::function<void(const std::string&)>& visit)
{
  if (!this->Others)
  {
    throw std::logic_error("an item that is no document reads notes");
  }
  this->Others(list, visit);
}

void addRounding(std::vector<LayerRounding>& all, const LayerRounding& one)
{
  const auto same = std::find_if(all.begin(), all.end(),
    [&](const LayerRounding& other) { return other.layer == one.layer && other.unit == one.unit; });
  if (same == all.end())
  {
    all.push_back(one);
    return;
  }
  same->largest = std::max(same->largest, one.largest);
  same->values += one.values;
  same->withoutCode += one.withoutCode;
}

void addRounding(std::vector<LayerRounding>& all, const std::vector<LayerRounding>& some)
{
  for (const LayerRounding& one : some)
  {
    addRounding(all, one);
  }
}

} // namespace dgtk
