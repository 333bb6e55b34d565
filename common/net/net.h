#pragma once
/// The datagram interface: everything that a Server or Client needs of the operating system.

#include <array>
#include <cstdint>
#include <string>
#include <tuple>

#include "common/base/bytes.h"
#include "common/base/limits.h"
#include "common/net/wire_number.h"

namespace seam {

/// An endpoint, in host byte order: IPv6, or IPv4 as IPv6 maps it (::ffff:a.b.c.d, RFC 4291).
struct Address {
  std::uint32_t ip = 0;  ///< IPv4, or the last 32 bits of an IPv6 address
  std::uint16_t port = 0;
  std::uint32_t middle = 0xffff;  ///< the 32 bits before them
  std::uint64_t high = 0;         ///< the first 64 bits

  bool ipv4() const { return high == 0 && middle == 0xffff; }
  bool operator==(const Address& o) const {
    return ip == o.ip && port == o.port && middle == o.middle && high == o.high;
  }
  bool operator!=(const Address& o) const { return !(*this == o); }
  bool operator<(const Address& o) const {
    return std::tie(high, middle, ip, port) < std::tie(o.high, o.middle, o.ip, o.port);
  }
};

/// Any address of this machine, IPv4 and IPv6, and any port.
constexpr Address kAnyAddress{0, 0, 0, 0};

/// The 16 bytes of the IPv6 address in network order, then the port.
inline std::array<std::uint8_t, 18> BytesOf(const Address& address) {
  std::array<std::uint8_t, 18> bytes{};
  PutNumber(bytes.data(), address.high, 8);
  PutNumber(bytes.data() + 8, address.middle, 4);
  PutNumber(bytes.data() + 12, address.ip, 4);
  PutNumber(bytes.data() + 16, address.port, 2);
  return bytes;
}

/// Returns "127.0.0.1:7777" or "[2001:db8::1]:7777", for logs.
std::string ToString(const Address& address);
/// Reads the text of ToString: numbers alone, with a port. False if it is another one: nothing is
/// looked up, so that a peer's text may be given.
bool ReadAddress(const std::string& text, Address* address);

/// Unreliable, unordered datagrams. Not thread-safe. No call blocks, throws or aborts because of an
/// event in the network.
class Net {
 public:
  virtual ~Net() = default;
  /// Sets the time (microseconds, never backwards); simulated networks deliver by it.
  virtual void Advance(std::int64_t now_us) = 0;
  /// Queues a datagram of 1..kDatagramBytesMax bytes. It may be lost.
  virtual void Send(const Address& to, ByteView datagram) = 0;
  /// Hands queued datagrams to the network.
  virtual void Flush() = 0;
  /// Takes the next received datagram; false when there is none.
  virtual bool Receive(Address* from, Bytes* datagram) = 0;
  /// Returns the number of received datagrams that Receive skipped: empty or longer than
  /// kDatagramBytesMax.
  virtual std::int64_t discarded() const { return 0; }
};

}  // namespace seam
