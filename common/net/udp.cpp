#include "common/net/udp.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <utility>

#include "common/base/check.h"

namespace seam {
namespace {

/// Datagrams per system call. More gain nothing measurable; fewer cost more calls.
constexpr unsigned kBatch = 64;
/// Kernel buffer each way, bytes: a burst of 800 full datagrams. Too small loses bursts silently.
constexpr int kSocketBufferBytes = 1 << 20;
/// One byte more than we accept, so that a longer datagram is recognised as too long.
constexpr std::size_t kSlotBytes = kDatagramBytesMax + 1;
/// Most pending socket errors (an ICMP for an earlier send) skipped in one Receive.
constexpr int kErrorsSkippedMax = 8;
/// Most datagrams of a wrong size skipped in one Receive, so that a flood cannot block it.
constexpr int kDiscardsMax = 1024;

sockaddr_in ToSockaddr(const Address& address) {
  sockaddr_in out{};
  out.sin_family = AF_INET;
  out.sin_port = htons(address.port);
  out.sin_addr.s_addr = htonl(address.ip);
  return out;
}

Address FromSockaddr(const sockaddr_in& in) {
  return Address{ntohl(in.sin_addr.s_addr), ntohs(in.sin_port)};
}

/// Buffers and headers of 64 datagrams for recvmmsg and sendmmsg.
struct Batch {
  std::array<mmsghdr, kBatch> headers{};
  std::array<iovec, kBatch> parts{};
  std::array<sockaddr_in, kBatch> addresses{};
  std::array<std::array<std::uint8_t, kSlotBytes>, kBatch> data{};

  Batch() {
    for (unsigned i = 0; i < kBatch; ++i) Reset(i, kSlotBytes);
  }
  /// Prepares slot `i` for `bytes` of data.
  void Reset(unsigned i, std::size_t bytes) {
    parts[i] = {data[i].data(), bytes};
    headers[i] = {};
    headers[i].msg_hdr.msg_name = &addresses[i];
    headers[i].msg_hdr.msg_namelen = sizeof addresses[i];
    headers[i].msg_hdr.msg_iov = &parts[i];
    headers[i].msg_hdr.msg_iovlen = 1;
  }
};

void GrowBuffer(int fd, int force_option, int option) {
  if (setsockopt(fd, SOL_SOCKET, force_option, &kSocketBufferBytes, sizeof(int)) != 0) {
    (void)setsockopt(fd, SOL_SOCKET, option, &kSocketBufferBytes, sizeof(int));
  }
}

std::string BindFailure(const Address& local, int error) {
  const std::string port = std::to_string(local.port);
  if (error == EADDRINUSE) {
    return "port " + port + " is in use: stop the program that has it or choose another port";
  }
  if (error == EACCES) return "port " + port + " needs privileges: choose one above 1023";
  if (error == EADDRNOTAVAIL) {
    return "cannot listen on " + ToString(local) + ": it is no address of this machine";
  }
  return "cannot listen on " + ToString(local) + ": " + std::strerror(error);
}

/// Reads all of `text` as a port. Throws OperatorError quoting `whole`.
std::uint16_t ParsePort(const std::string& text, const std::string& whole) {
  const bool digits = !text.empty() && text.size() <= 5 &&
                      text.find_first_not_of("0123456789") == std::string::npos;
  const unsigned long port = digits ? std::stoul(text) : 65536;
  if (port > 65535) {
    throw OperatorError("address \"" + whole + "\": the port must be a number from 0 to 65535");
  }
  return static_cast<std::uint16_t>(port);
}

/// Asks the resolver for the first IPv4 address of `host`.
std::uint32_t Resolve(const std::string& host, const std::string& whole) {
  addrinfo hints{};
  hints.ai_family = AF_INET;
  hints.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  const int error = getaddrinfo(host.c_str(), nullptr, &hints, &found);
  if (error != 0 || found == nullptr) {
    throw OperatorError("address \"" + whole + "\": cannot find host \"" + host +
                        "\": " + gai_strerror(error));
  }
  sockaddr_in first{};
  std::memcpy(&first, found->ai_addr, sizeof first);
  freeaddrinfo(found);
  return ntohl(first.sin_addr.s_addr);
}

}  // namespace

Address ParseAddress(const std::string& text, std::uint16_t default_port) {
  Address address{0, default_port};
  const std::size_t colon = text.find(':');
  if (colon != std::string::npos && text.find(':', colon + 1) != std::string::npos) {
    throw OperatorError("address \"" + text + "\": expected host:port (IPv4 or a name)");
  }
  if (colon != std::string::npos) address.port = ParsePort(text.substr(colon + 1), text);
  const std::string host = text.substr(0, colon);
  if (host.empty() || host.size() > 253 || host.find('\0') != std::string::npos) {
    throw OperatorError("address \"" + text + "\": the host is missing");
  }
  in_addr numeric{};
  if (inet_pton(AF_INET, host.c_str(), &numeric) == 1) {
    address.ip = ntohl(numeric.s_addr);
  } else if (host.find_first_not_of("0123456789.") == std::string::npos) {
    throw OperatorError("address \"" + text + "\": \"" + host + "\" is not an IPv4 address");
  } else {
    address.ip = Resolve(host, text);
  }
  return address;
}

struct UdpSender::Impl {
  int fd = -1;
  Batch out;
  unsigned count = 0;

  void Send(const Address& to, ByteView datagram) {
    SEAM_ASSERT(datagram.size >= 1 && datagram.size <= kDatagramBytesMax);
    if (count == kBatch) Flush();
    const unsigned slot = count++;
    std::copy(datagram.begin(), datagram.end(), out.data[slot].begin());
    out.Reset(slot, datagram.size);
    out.addresses[slot] = ToSockaddr(to);
  }

  void Flush() {
    unsigned sent = 0;
    while (sent < count) {
      const int done = sendmmsg(fd, &out.headers[sent], count - sent, MSG_DONTWAIT);
      if (done > 0) {
        sent += static_cast<unsigned>(done);
      } else if (errno == EAGAIN || errno == EWOULDBLOCK || errno == ENOBUFS) {
        break;  // the kernel's buffer is full: lost, as in a congested router
      } else if (errno != EINTR) {
        ++sent;  // refused, unreachable or filtered: only this datagram is lost
      }
    }
    count = 0;
  }
};

struct UdpNet::Impl {
  int fd = -1;
  Batch in;
  UdpSender::Impl out;
  unsigned in_count = 0, in_next = 0;  // received in the batch, and handed out
  bool drained = false;                // the last call emptied the socket
  std::int64_t discarded = 0;

  ~Impl() {
    if (fd >= 0) close(fd);
  }

  /// Fetches up to kBatch datagrams; false when none is pending. After a batch that was not full,
  /// the next Fetch returns false without a system call.
  bool Fetch() {
    for (unsigned i = 0; i < in_count; ++i) in.Reset(i, kSlotBytes);  // the filled slots
    in_count = in_next = 0;
    if (std::exchange(drained, false)) return false;
    for (int errors = 0; errors < kErrorsSkippedMax; ++errors) {
      const int got = recvmmsg(fd, in.headers.data(), kBatch, MSG_DONTWAIT, nullptr);
      if (got > 0) {
        in_count = static_cast<unsigned>(got);
        drained = in_count < kBatch;
        return true;
      }
      // EAGAIN means empty; any other error is left over from a send whose datagram was lost.
      if (got == 0 || errno == EAGAIN || errno == EWOULDBLOCK) return false;
    }
    return false;
  }
};

UdpNet::UdpNet(const Address& local) : impl_(std::make_unique<Impl>()) {
  impl_->fd = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (impl_->fd < 0) {
    throw OperatorError(std::string("cannot open a UDP socket: ") + std::strerror(errno));
  }
  GrowBuffer(impl_->fd, SO_RCVBUFFORCE, SO_RCVBUF);
  GrowBuffer(impl_->fd, SO_SNDBUFFORCE, SO_SNDBUF);
  const sockaddr_in address = ToSockaddr(local);
  if (bind(impl_->fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    throw OperatorError(BindFailure(local, errno));
  }
  impl_->out.fd = impl_->fd;
}

UdpNet::~UdpNet() = default;

int UdpNet::fd() const { return impl_->fd; }

UdpSender::UdpSender(const UdpNet& net) : impl_(std::make_unique<Impl>()) {
  impl_->fd = net.impl_->fd;
}

UdpSender::~UdpSender() = default;

void UdpSender::Send(const Address& to, ByteView datagram) { impl_->Send(to, datagram); }

void UdpSender::Flush() { impl_->Flush(); }

void UdpNet::Send(const Address& to, ByteView datagram) { impl_->out.Send(to, datagram); }

void UdpNet::Flush() { impl_->out.Flush(); }

bool UdpNet::Receive(Address* from, Bytes* datagram) {
  for (int discards = 0; discards < kDiscardsMax; ++discards) {
    if (impl_->in_next == impl_->in_count && !impl_->Fetch()) return false;
    const unsigned slot = impl_->in_next++;
    const std::size_t bytes = impl_->in.headers[slot].msg_len;
    if (bytes == 0 || bytes > kDatagramBytesMax) {  // not from Seam2D
      ++impl_->discarded;
      continue;
    }
    *from = FromSockaddr(impl_->in.addresses[slot]);
    const std::uint8_t* data = impl_->in.data[slot].data();
    datagram->assign(data, data + bytes);
    return true;
  }
  return false;
}

std::int64_t UdpNet::discarded() const { return impl_->discarded; }

bool UdpNet::Wait(std::int64_t timeout_us, int extra_fd) {
  if (impl_->in_next < impl_->in_count) return true;
  impl_->drained = false;
  pollfd fds[2] = {{impl_->fd, POLLIN, 0}, {extra_fd, POLLIN, 0}};
  const std::int64_t us = std::max<std::int64_t>(timeout_us, 0);
  timespec timeout{};
  timeout.tv_sec = static_cast<time_t>(us / 1'000'000);
  timeout.tv_nsec = static_cast<long>(us % 1'000'000) * 1000;
  return ppoll(fds, extra_fd >= 0 ? 2 : 1, &timeout, nullptr) > 0 && fds[0].revents != 0;
}

Address UdpNet::local() const {
  sockaddr_in address{};
  socklen_t bytes = sizeof address;
  (void)getsockname(impl_->fd, reinterpret_cast<sockaddr*>(&address), &bytes);
  return FromSockaddr(address);
}

}  // namespace seam
