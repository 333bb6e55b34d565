#pragma once
/// Keys of the two ends of a link, for tests without a handshake.

#include <cstdint>

#include "common/base/entropy.h"
#include "common/net/seal.h"

namespace seam {

/// Returns the keys of the client's end of a session, or the server's; the same for the same
/// number.
inline SealKeys LinkKeys(std::uint64_t session, bool server = false) {
  SeededEntropy entropy(session);
  SealKeys keys;
  keys.session = session;
  keys.out = Secret(entropy);
  keys.in = Secret(entropy);
  return server ? keys.Mirrored() : keys;
}

}  // namespace seam
