// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkNameTable.h"

#include "dgtkHash.h"

#include <algorithm>
#include <charconv>

namespace dgtk
{

bool NameTable::Entry::isLess(const Entry& a, const Entry& b)
{
  return std::lexicographical_compare(a.hash, a.hash + 2, b.hash, b.hash + 2);
}

NameTable::Entry NameTable::entryOf(const std::string& name)
{
  const std::string hash = Sha256::of(name);
  Entry entry;
  std::from_chars(hash.data(), hash.data() + 16, entry.hash[0], 16);
  std::from_chars(hash.data() + 16, hash.data() + 32, entry.hash[1], 16);
  return entry;
}

void NameTable::add(const std::string& name)
{
  this->Entries.push_back(entryOf(name));
  if (this->Entries.size() >= this->Enough)
  {
    this->finish();
    this->Enough = std::max(this->Enough, this->Entries.size() * 3 / 2);
  }
}

void NameTable::finish()
{
  std::sort(this->Entries.begin(), this->Entries.end(), &Entry::isLess);
  const auto same = [](const Entry& a, const Entry& b) { return !Entry::isLess(a, b) && !Entry::isLess(b, a); };
  this->Entries.erase(std::unique(this->Entries.begin(), this->Entries.end(), same), this->Entries.end());
}

const std::uint64_t* NameTable::numberOf(const std::string& name) const
{
  const Entry wanted = entryOf(name);
  const auto found = std::lower_bound(this->Entries.begin(), this->Entries.end(), wanted, &Entry::isLess);
  return found == this->Entries.end() || Entry::isLess(wanted, *found) ? nullptr : &found->number;
}

std::uint64_t* NameTable::numberOf(const std::string& name)
{
  return const_cast<std::uint64_t*>(static_cast<const NameTable*>(this)->numberOf(name));
}

} // namespace dgtk
