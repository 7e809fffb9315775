// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkHelperChannel_h
#define dgtkHelperChannel_h

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <utility>

#include <sys/socket.h>
#include <sys/uio.h>
#include <unistd.h>

/// What the library and its helper programs say to each other: structures without pointers, one a message, over a
/// socket of type SOCK_SEQPACKET, which is the helper's standard input. Open files travel beside them.
namespace dgtk::helper
{

constexpr std::size_t mostDescriptors = 2;

/// A descriptor that is closed with its owner.
class Descriptor
{
public:
  explicit Descriptor(int descriptor = -1)
    : Number(descriptor)
  {
  }
  ~Descriptor() { this->reset(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  Descriptor(Descriptor&& other) noexcept
    : Number(other.release())
  {
  }
  Descriptor& operator=(Descriptor&& other) noexcept
  {
    if (this != &other)
    {
      this->reset(other.release());
    }
    return *this;
  }
  void reset(int descriptor = -1)
  {
    if (this->Number >= 0)
    {
      ::close(this->Number);
    }
    this->Number = descriptor;
  }
  int release()
  {
    const int number = this->Number;
    this->Number = -1;
    return number;
  }
  int get() const { return this->Number; }
  explicit operator bool() const { return this->Number >= 0; }

private:
  int Number;
};

using Descriptors = std::array<Descriptor, mostDescriptors>;

/// False, and errno set, when the other side is gone.
template <class Message>
bool send(int socket, const Message& message, int first = -1, int second = -1)
{
  alignas(cmsghdr) char control[CMSG_SPACE(mostDescriptors * sizeof(int))] = {};
  iovec data = { const_cast<Message*>(&message), sizeof message };
  msghdr header = {};
  header.msg_iov = &data;
  header.msg_iovlen = 1;
  const int numbers[mostDescriptors] = { first, second };
  const std::size_t count = first < 0 ? 0 : second < 0 ? 1 : 2;
  if (count > 0)
  {
    header.msg_control = control;
    header.msg_controllen = CMSG_SPACE(count * sizeof(int));
    cmsghdr* rights = CMSG_FIRSTHDR(&header);
    rights->cmsg_level = SOL_SOCKET;
    rights->cmsg_type = SCM_RIGHTS;
    rights->cmsg_len = CMSG_LEN(count * sizeof(int));
    std::memcpy(CMSG_DATA(rights), numbers, count * sizeof(int));
  }
  ssize_t sent = -1;
  do
  {
    sent = ::sendmsg(socket, &header, MSG_NOSIGNAL);
  } while (sent < 0 && errno == EINTR);
  return sent == static_cast<ssize_t>(sizeof message);
}

/// False when the other side is gone, or sent something else.
template <class Message>
bool receive(int socket, Message& message, Descriptors& files)
{
  alignas(cmsghdr) char control[CMSG_SPACE(mostDescriptors * sizeof(int))] = {};
  iovec data = { &message, sizeof message };
  msghdr header = {};
  header.msg_iov = &data;
  header.msg_iovlen = 1;
  header.msg_control = control;
  header.msg_controllen = sizeof control;
  ssize_t got = -1;
  do
  {
    got = ::recvmsg(socket, &header, MSG_CMSG_CLOEXEC);
    // told once, when the other side went without reading all: what it had sent comes after that
  } while (got < 0 && (errno == EINTR || errno == ECONNRESET));
  for (cmsghdr* part = got < 0 ? nullptr : CMSG_FIRSTHDR(&header); part; part = CMSG_NXTHDR(&header, part))
  {
    const std::size_t count = (part->cmsg_len - CMSG_LEN(0)) / sizeof(int);
    for (std::size_t i = 0; part->cmsg_type == SCM_RIGHTS && i < count; ++i)
    {
      int number = -1;
      std::memcpy(&number, CMSG_DATA(part) + i * sizeof(int), sizeof number);
      Descriptor file(number);
      if (i < files.size())
      {
        files[i] = std::move(file);
      }
    }
  }
  return got == static_cast<ssize_t>(sizeof message) && (header.msg_flags & (MSG_TRUNC | MSG_CTRUNC)) == 0;
}

/// A text of a message; what is too long is cut.
template <std::size_t N>
void put(char (&to)[N], const char* from)
{
  std::strncpy(to, from, N - 1);
  to[N - 1] = '\0';
}

} // namespace dgtk::helper

#endif
