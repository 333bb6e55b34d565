#pragma once
/// How long silence lasts before authority ends, on the client's side and on the server's. No body
/// ever has two authorities only if the first ends before the second.

#include <cstdint>

namespace seam {

/// The client's lease, us: when the newest ping that the server answered is older than this, it
/// lets go of its mechanisms, whichever direction of the path failed.
constexpr std::int64_t kLeaseUs = 2000000;
/// The server's patience, us: a client not heard for this long is gone, and the server takes its
/// mechanisms back.
constexpr std::int64_t kPatienceUs = 3000000;
static_assert(kLeaseUs < kPatienceUs,
              "the server would take a mechanism back while its client still holds it: two "
              "authorities over one body");

}  // namespace seam
