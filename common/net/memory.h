#pragma once
/// A network within one process and in virtual time, for tests and experiments.

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <utility>

#include "common/net/net.h"

namespace seam {

/// Delivers at once and in order; wrap an endpoint in ImpairedNet for anything worse. Datagrams to
/// an address without an endpoint are lost.
class MemoryNetwork {
 public:
  /// Returns an endpoint bound to `address`; it must not outlive the network. A second endpoint of
  /// the same address replaces the first (a restarted process).
  std::unique_ptr<Net> Attach(const Address& address);

 private:
  friend class MemoryEndpoint;
  using Datagrams = std::deque<std::pair<Address, Bytes>>;  // sender, bytes
  struct Inbox {
    std::uint64_t endpoint = 0;  // number of the endpoint that owns it
    Datagrams datagrams;
  };
  std::map<Address, Inbox> inbox_;
  std::uint64_t endpoints_ = 0;  // number of endpoints made so far
};

}  // namespace seam
