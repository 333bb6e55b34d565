#pragma once
/// The datagram interface: everything that a Server or Client needs of the operating system.

#include <cstdint>
#include <string>

#include "common/base/bytes.h"
#include "common/base/limits.h"

namespace seam {

/// An IPv4 endpoint, both in host byte order.
struct Address {
  std::uint32_t ip = 0;
  std::uint16_t port = 0;
  bool operator==(const Address& o) const { return ip == o.ip && port == o.port; }
  bool operator!=(const Address& o) const { return !(*this == o); }
  bool operator<(const Address& o) const { return ip != o.ip ? ip < o.ip : port < o.port; }
};

/// Returns "127.0.0.1:7777", for logs.
std::string ToString(const Address& address);

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
