// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkHash.h"

#include "dgtkError.h"

// The functions of one hash, which OpenSSL 3 calls deprecated: those for any hash set all of its ciphers up first,
// 2 ms a process.
#define OPENSSL_SUPPRESS_DEPRECATED
#include <openssl/sha.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <map>
#include <mutex>
#include <tuple>
#include <utility>

#include <sys/stat.h>

namespace dgtk
{

struct Sha256::Impl
{
  SHA256_CTX context = {};
};

Sha256::Sha256()
  : Self(new Impl)
{
  SHA256_Init(&this->Self->context);
}

Sha256::~Sha256() = default;

void Sha256::update(const void* data, std::size_t bytes) { SHA256_Update(&this->Self->context, data, bytes); }

std::string Sha256::hex()
{
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest = {};
  SHA256_Final(digest.data(), &this->Self->context);
  std::string text;
  for (const unsigned int byte : digest)
  {
    constexpr char digits[] = "0123456789abcdef";
    text += digits[byte >> 4];
    text += digits[byte & 15];
  }
  return text;
}

std::string Sha256::of(const std::string& bytes)
{
  Sha256 hash;
  hash.update(bytes.data(), bytes.size());
  return hash.hex();
}

std::string Sha256::ofFile(const std::string& path)
{
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file)
  {
    throw InputError(path, std::string("cannot be read: ") + std::strerror(errno));
  }
  Sha256 hash;
  std::array<char, 1 << 16> buffer; // not cleared: many files are small
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), file.get()))
  {
    hash.update(buffer.data(), n);
  }
  if (std::ferror(file.get()))
  {
    throw InputError(path, "cannot be read to its end");
  }
  return hash.hex();
}

namespace
{
constexpr std::int64_t second = 1'000'000'000;

std::int64_t nanoseconds(const timespec& time) { return std::int64_t(time.tv_sec) * second + time.tv_nsec; }
} // namespace

FileAge::FileAge(const std::string& path)
{
  struct stat status = {};
  if (::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode))
  {
    this->File = true;
    this->Device = status.st_dev;
    this->Number = status.st_ino;
    this->Bytes = static_cast<std::uint64_t>(status.st_size);
    this->Contents = nanoseconds(status.st_mtim);
    this->State = nanoseconds(status.st_ctim);
  }
}

bool FileAge::operator==(const FileAge& other) const
{
  const auto all = [](const FileAge& age)
  { return std::tie(age.File, age.Device, age.Number, age.Bytes, age.Contents, age.State); };
  return all(*this) == all(other);
}

/// Kernels count files' times in steps of some milliseconds, some file systems in whole seconds.
bool FileAge::isOlderThan(std::int64_t time) const
{
  const bool coarse = this->Contents % second == 0 || this->State % second == 0;
  const std::int64_t step = coarse ? 2 * second : second / 80;
  return std::max(this->Contents, this->State) < time - step;
}

std::int64_t timeOfFiles()
{
  timespec now = {};
  ::clock_gettime(CLOCK_REALTIME, &now);
  return nanoseconds(now);
}

std::string hashOfFile(const std::string& path)
{
  static std::mutex mutex;
  static std::map<std::string, std::pair<FileAge, std::string>> known;
  const FileAge age(path);
  {
    const std::lock_guard<std::mutex> lock(mutex);
    const auto found = known.find(path);
    if (found != known.end() && age.isFile() && found->second.first == age)
    {
      return found->second.second;
    }
  }
  const std::int64_t begin = timeOfFiles();
  std::string hash = Sha256::ofFile(path);
  if (age.isOlderThan(begin) && FileAge(path) == age)
  {
    const std::lock_guard<std::mutex> lock(mutex);
    known.insert_or_assign(path, std::make_pair(age, hash));
  }
  return hash;
}

} // namespace dgtk
