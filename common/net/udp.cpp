#include "common/net/udp.h"

#include <arpa/inet.h>
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

/// A name of the kernel's: of either family, which of the two the socket says.
using Name = sockaddr_in6;
static_assert(sizeof(Name) >= sizeof(sockaddr_in));

/// Writes the name of an address for a socket of IPv6 (`six`), or of IPv4; returns its bytes. An
/// IPv4 socket cannot send to IPv6: the name is then one to which nothing is sent.
socklen_t ToName(const Address& address, bool six, Name* name) {
  *name = {};
  if (six) {
    name->sin6_family = AF_INET6;
    name->sin6_port = htons(address.port);
    const auto bytes = BytesOf(address);
    std::memcpy(&name->sin6_addr, bytes.data(), sizeof name->sin6_addr);
    return sizeof *name;
  }
  sockaddr_in four{};
  four.sin_family = AF_INET;
  four.sin_port = htons(address.ipv4() ? address.port : 0);
  four.sin_addr.s_addr = htonl(address.ipv4() ? address.ip : 0);
  std::memcpy(name, &four, sizeof four);
  return sizeof four;
}

Address FromName(const Name& name) {
  if (name.sin6_family == AF_INET6) {
    std::array<std::uint8_t, 16> bytes{};
    std::memcpy(bytes.data(), &name.sin6_addr, bytes.size());
    Address address;
    address.high = GetNumber(bytes.data(), 8);
    address.middle = static_cast<std::uint32_t>(GetNumber(bytes.data() + 8, 4));
    address.ip = static_cast<std::uint32_t>(GetNumber(bytes.data() + 12, 4));
    address.port = ntohs(name.sin6_port);
    return address;
  }
  sockaddr_in four{};
  std::memcpy(&four, &name, sizeof four);
  return Address{ntohl(four.sin_addr.s_addr), ntohs(four.sin_port)};
}

/// Buffers and headers of 64 datagrams for recvmmsg and sendmmsg.
struct Batch {
  std::array<mmsghdr, kBatch> headers{};
  std::array<iovec, kBatch> parts{};
  std::array<Name, kBatch> addresses{};
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

int OpenSocket(int family) { return socket(family, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0); }

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

}  // namespace

struct UdpSender::Impl {
  int fd = -1;
  bool six = false;  // the socket is of IPv6
  Batch out;
  unsigned count = 0;

  void Send(const Address& to, ByteView datagram) {
    SEAM_ASSERT(datagram.size >= 1 && datagram.size <= kDatagramBytesMax);
    if (count == kBatch) Flush();
    const unsigned slot = count++;
    std::copy(datagram.begin(), datagram.end(), out.data[slot].begin());
    out.Reset(slot, datagram.size);
    out.headers[slot].msg_hdr.msg_namelen = ToName(to, six, &out.addresses[slot]);
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
  Address own = local;
  impl_->fd = OpenSocket(own.ipv4() ? AF_INET : AF_INET6);
  const bool any = own.high == 0 && own.middle == 0 && own.ip == 0;
  if (impl_->fd < 0 && any) {  // a machine without IPv6
    own = Address{0, own.port};
    impl_->fd = OpenSocket(AF_INET);
  }
  if (impl_->fd < 0) {
    throw OperatorError(std::string("cannot open a UDP socket: ") + std::strerror(errno));
  }
  impl_->out.six = !own.ipv4();
  if (impl_->out.six) {
    const int off = 0;  // takes IPv4 too, if it listens on any address
    (void)setsockopt(impl_->fd, IPPROTO_IPV6, IPV6_V6ONLY, &off, sizeof off);
  }
  GrowBuffer(impl_->fd, SO_RCVBUFFORCE, SO_RCVBUF);
  GrowBuffer(impl_->fd, SO_SNDBUFFORCE, SO_SNDBUF);
  Name name{};
  const socklen_t bytes = ToName(own, impl_->out.six, &name);
  if (bind(impl_->fd, reinterpret_cast<const sockaddr*>(&name), bytes) != 0) {
    throw OperatorError(BindFailure(local, errno));
  }
  impl_->out.fd = impl_->fd;
}

UdpNet::~UdpNet() = default;

int UdpNet::fd() const { return impl_->fd; }

UdpSender::UdpSender(const UdpNet& net) : impl_(std::make_unique<Impl>()) {
  impl_->fd = net.impl_->fd;
  impl_->six = net.impl_->out.six;
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
    *from = FromName(impl_->in.addresses[slot]);
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
  Name name{};
  socklen_t bytes = sizeof name;
  (void)getsockname(impl_->fd, reinterpret_cast<sockaddr*>(&name), &bytes);
  return FromName(name);
}

}  // namespace seam
