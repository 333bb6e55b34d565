#pragma once
/// Net over a non-blocking UDP socket, batched with recvmmsg/sendmmsg.

#include <memory>
#include <string>

#include "common/net/net.h"

namespace seam {

/// Reads "host:port" or "host" (numeric IPv4, or a name, which may block in the resolver), or
/// "[IPv6]:port", "[IPv6]" or "IPv6". A name's IPv4 address goes before its IPv6 one. Port 0 is
/// allowed and binds to any port. Throws OperatorError with the reason.
Address ParseAddress(const std::string& text, std::uint16_t default_port);

class UdpNet : public Net {
 public:
  /// Binds `local` (port 0: any). One that listens on `::` takes IPv4 too; on a machine without
  /// IPv6 that alone. Throws OperatorError ("port 7777 is in use: ...").
  explicit UdpNet(const Address& local);
  ~UdpNet() override;
  UdpNet(const UdpNet&) = delete;
  UdpNet& operator=(const UdpNet&) = delete;

  void Advance(std::int64_t) override {}
  void Send(const Address& to, ByteView datagram) override;
  void Flush() override;
  bool Receive(Address* from, Bytes* datagram) override;
  std::int64_t discarded() const override;

  /// Sleeps in poll until a datagram (or `extra_fd`, if >= 0) is readable or `timeout_us` has
  /// passed; a signal ends it early. Returns true if a datagram is there. Does not Flush. At its
  /// end of file `extra_fd` stays readable: do not pass it again.
  bool Wait(std::int64_t timeout_us, int extra_fd = -1);

  Address local() const;
  /// Returns the descriptor for poll and epoll, readable when a datagram is pending.
  int fd() const;

 private:
  friend class UdpSender;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Sends from the address of a UdpNet with a batch of its own, so that one thread may send through
/// it while another uses the UdpNet. Receives nothing.
class UdpSender : public Net {
 public:
  /// `net` must outlive the sender.
  explicit UdpSender(const UdpNet& net);
  ~UdpSender() override;

  void Advance(std::int64_t) override {}
  void Send(const Address& to, ByteView datagram) override;
  void Flush() override;
  bool Receive(Address*, Bytes*) override { return false; }

 private:
  friend class UdpNet;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace seam
