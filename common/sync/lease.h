#pragma once
/// How long silence lasts before authority ends, on the client's side and on the server's, and how
/// long a holder may take to let go. No body ever has two authorities that count only if these
/// follow one another in this order.

#include <cstdint>

namespace seam {

/// Something moves and its holder has not been heard for so long, us: the server simulates it and
/// says in the holder's name where it is, long before the lease ends, so that nothing stands still
/// and jumps later.
constexpr std::int64_t kSilentUs = 250000;
/// A player who drives and has not been heard for so long, us, lets go of the controls as far as
/// the others know: a car whose driver is gone does not drive on. What is heard of it again counts
/// from there. Shorter stops who only lags (of ten pings a second at least one arrives); longer
/// drives on into something.
constexpr std::int64_t kDriverSilentUs = 1000000;
/// m/s; what is slower comes to rest without the server's help, and must not be kept from it.
constexpr float kMissed = 0.5f;
/// The client's lease, us: when the newest ping that the server answered is older than this, it
/// lets go of its mechanisms, whichever direction of the path failed.
constexpr std::int64_t kLeaseUs = 3000000;
/// The server's patience, us: a client not heard for this long is gone, and the server takes its
/// mechanisms back.
constexpr std::int64_t kPatienceUs = 4000000;
static_assert(kSilentUs < kDriverSilentUs && kDriverSilentUs < kLeaseUs,
              "a driver that is gone would drive on until its lease ends");
static_assert(kLeaseUs < kPatienceUs,
              "the server would take a mechanism back while its client still holds it: two "
              "authorities over one body");
/// The server's patience with a holder that was told to let go, us. Normally it answers within a
/// round trip; with the network "terrible" (200 ms, 20 % lost each way) about one answer in ten
/// million takes longer than this. Shorter drops honest clients there; longer lets one that
/// withholds its answer keep a mechanism from the others.
constexpr std::int64_t kReleasePatienceUs = 5000000;
/// A holder that has not answered for so long, us, or for four round trips, is told that it has it
/// still: until it answers, others would believe that nobody has it, and drop what it says. It is
/// asked again once it is heard, and that question stands. Shorter withdraws from paths that are
/// only slow; longer leaves others without a word of what it has.
constexpr std::int64_t kWithdrawUs = 1000000;
constexpr int kWithdrawRoundTrips = 4;
/// us from there until it is asked again.
constexpr std::int64_t kAskAgainUs = 250000;
/// us that a question stands at least before its holder has to leave.
constexpr std::int64_t kAnswerPatienceUs = kReleasePatienceUs - kWithdrawUs - kAskAgainUs;
/// us that a client which did not let go is kept without an answer to its pings: it lets go of all
/// that it has meanwhile, unless it is hostile. Longer leaves to one that is hostile what it has.
constexpr std::int64_t kEndingUs = 3500000;
static_assert(kLeaseUs < kEndingUs, "two authorities: it would be dropped before it has let go");
static_assert(kPatienceUs < kReleasePatienceUs,
              "who is only cut off would be dropped for not letting go");

}  // namespace seam
