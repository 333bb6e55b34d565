#pragma once
/// Timeouts of authority: how long a client or the server may stay silent, and how long a holder
/// may take to release a mechanism. Only this order of the values ensures that no body ever has two
/// valid authorities.

#include <cstdint>

namespace seam {

/// Silence after which the server simulates a holder's moving bodies and sends their states in the
/// holder's name, us. Long before the lease ends, so that nothing stops and jumps later.
constexpr std::int64_t kSilentUs = 250000;
/// Silence after which a driving player counts as having released the controls, us: a car without
/// its driver does not drive on. Inputs heard later count from then on. Shorter stops a player who
/// merely lags (of ten pings a second at least one arrives); longer drives into something.
constexpr std::int64_t kDriverSilentUs = 1000000;
/// m/s; a slower body comes to rest without the server's help and must be allowed to.
constexpr float kStandInSpeed = 0.5f;
/// The client's lease, us: if the newest ping that the server answered is older, the client
/// releases its mechanisms, whichever direction of the path failed.
constexpr std::int64_t kLeaseUs = 3000000;
/// The server's patience, us: a client not heard for this long counts as gone, and the server takes
/// its mechanisms back.
constexpr std::int64_t kPatienceUs = 4000000;
static_assert(kSilentUs < kDriverSilentUs && kDriverSilentUs < kLeaseUs,
              "a driver that is gone would drive on until its lease ends");
static_assert(kLeaseUs < kPatienceUs,
              "the server would take a mechanism back while its client still holds it: two "
              "authorities over one body");
/// The server's patience with a holder that was sent the question to release, us. Normally the
/// answer takes a round trip; on the network "terrible" (200 ms, 20 % lost each way) about one
/// answer in ten million takes longer than this. Shorter drops honest clients there; longer lets a
/// client keep a mechanism by withholding its answer.
constexpr std::int64_t kReleasePatienceUs = 5000000;
/// A holder that has not answered a release for this long, us, or for four round trips, is
/// confirmed as holder: otherwise the other peers would believe that the mechanism has no holder
/// and drop its states. It is asked again once it is heard, and that request stands. Shorter
/// withdraws on paths that are only slow; longer leaves the other peers without its states.
constexpr std::int64_t kWithdrawUs = 1000000;
constexpr int kWithdrawRoundTrips = 4;
/// Time after which a question counts that could not be sent, us. On a thin line it waits for its
/// turn, and its holder has done nothing wrong. Shorter drops honest clients there; longer lets a
/// client keep a mechanism by acknowledging nothing.
constexpr std::int64_t kTellPatienceUs = 10000000;
/// Time until it is asked again, us.
constexpr std::int64_t kAskAgainUs = 250000;
/// Time that a request stands at least before its holder is dropped, us.
constexpr std::int64_t kAnswerPatienceUs = kReleasePatienceUs - kWithdrawUs - kAskAgainUs;
/// Time that a client which did not release is kept without answers to its pings, us: meanwhile an
/// honest one releases everything. Longer lets a hostile one keep its mechanisms.
constexpr std::int64_t kEndingUs = 3500000;
static_assert(kLeaseUs < kEndingUs, "two authorities: it would be dropped before it has let go");
static_assert(kPatienceUs < kReleasePatienceUs,
              "who is only cut off would be dropped for not letting go");

}  // namespace seam
