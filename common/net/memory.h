#pragma once
/// A network inside one process and in virtual time: what a test or experiment runs on.

#include <deque>
#include <map>
#include <memory>
#include <utility>

#include "common/net/net.h"

namespace seam {

/// Delivers at once and in order; wrap an endpoint in ImpairedNet for anything worse.
class MemoryNetwork {
 public:
  /// An endpoint bound to `address`; owned by the caller, must not outlive the network.
  /// A second endpoint of the same address takes the first one's place (a restarted process).
  std::unique_ptr<Net> Attach(const Address& address);

 private:
  friend class MemoryEndpoint;
  std::map<Address, std::deque<std::pair<Address, Bytes>>> inbox_;
};

}  // namespace seam
