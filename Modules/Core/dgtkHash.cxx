// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkHash.h"

#include "dgtkError.h"

#include <openssl/evp.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <vector>

namespace dgtk
{

struct Sha256::Impl
{
  EVP_MD_CTX* context = EVP_MD_CTX_new();
  ~Impl() { EVP_MD_CTX_free(this->context); }
};

Sha256::Sha256()
  : Self(new Impl)
{
  EVP_DigestInit_ex(this->Self->context, EVP_sha256(), nullptr);
}

Sha256::~Sha256() = default;

void Sha256::update(const void* data, std::size_t bytes) { EVP_DigestUpdate(this->Self->context, data, bytes); }

std::string Sha256::hex()
{
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned int size = 0;
  EVP_DigestFinal_ex(this->Self->context, digest, &size);
  std::string text;
  for (unsigned int i = 0; i < size; ++i)
  {
    constexpr char digits[] = "0123456789abcdef";
    text += digits[digest[i] >> 4];
    text += digits[digest[i] & 15];
  }
  return text;
}

std::string Sha256::ofFile(const std::string& path)
{
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file)
  {
    throw InputError(path, 0, std::string("cannot be read: ") + std::strerror(errno));
  }
  Sha256 hash;
  std::vector<char> buffer(1 << 20);
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), file.get()))
  {
    hash.update(buffer.data(), n);
  }
  if (std::ferror(file.get()))
  {
    throw InputError(path, 0, "cannot be read to its end");
  }
  return hash.hex();
}

} // namespace dgtk
