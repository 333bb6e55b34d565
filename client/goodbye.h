#pragma once
/// The last message of a session: its place at the server is free at once.

#include <cstdint>

#include "common/codec/codec.h"
#include "common/net/link.h"

namespace seam {

/// Sends it several times, as it may be lost and is not retransmitted; `flush` sends what waits.
template <typename Flush>
void SayGoodbye(std::int64_t now_us, Link* link, const Flush& flush) {
  Bye bye;
  bye.utime = now_us;
  bye.reason = "left";
  for (int copy = 0; copy < 4; ++copy) {
    link->SendUnreliable(Encode(bye));
    flush();
  }
}

}  // namespace seam
