/// Gather: how often arrivals wake a server, with made-up arrivals.

#include "server/hub/gather.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "common/base/random.h"

namespace seam {
namespace gather_test {

constexpr std::int64_t kTickUs = 16667, kPlayedUs = 10000000;

struct Played {
  double wakes_a_tick = 0;
  std::int64_t latest_us = 0;  // that a datagram waited
  std::size_t taken = 0;
};

/// Clients that each send a datagram a tick, at times of their own, to a server as Hub waits.
Played Play(int clients) {
  Random random(static_cast<std::uint64_t>(clients));
  std::vector<std::int64_t> arrivals;
  for (int c = 0; c < clients; ++c) {
    for (auto at = static_cast<std::int64_t>(random.Uniform() * kTickUs); at < kPlayedUs;
         at += kTickUs) {
      arrivals.push_back(at);
    }
  }
  std::sort(arrivals.begin(), arrivals.end());
  Gather gather;
  Played played;
  int wakes = 0;
  std::int64_t now = 0, due = kTickUs;
  while (now < kPlayedUs) {
    gather.NotePolled(now);
    for (; played.taken < arrivals.size() && arrivals[played.taken] <= now; ++played.taken) {
      played.latest_us = std::max(played.latest_us, now - arrivals[played.taken]);
    }
    if (now >= due) due += kTickUs;
    const std::int64_t slept = gather.SleepsUntil(due);
    if (slept > now) ++wakes;
    now = std::max(now, slept);
    const bool more = played.taken < arrivals.size();
    const bool came = more && arrivals[played.taken] <= due;
    const std::int64_t next = came ? std::max(now, arrivals[played.taken]) : due;
    if (next > now) ++wakes;
    now = next;
    gather.NoteWaited(now, came);
  }
  played.wakes_a_tick = wakes / (static_cast<double>(kPlayedUs) / kTickUs);
  return played;
}

TEST(Gather, TwoClientsAreServedAtOnceForAWakeEachAndOneForTheTick) {
  const Played played = Play(2);
  EXPECT_GT(played.taken, 1100u);
  EXPECT_LE(played.wakes_a_tick, 3.1);
  EXPECT_LE(played.latest_us, 1000);
}

TEST(Gather, HundredsAreServedForTenWakesATickAndNoneWaitsForMoreThanTwoMilliseconds) {
  for (const int clients : {9, 30, 256}) {
    const Played played = Play(clients);
    EXPECT_GT(played.taken, 590u * static_cast<unsigned>(clients));
    EXPECT_LE(played.wakes_a_tick, 10) << clients;
    EXPECT_LE(played.latest_us, Gather::kGatherUs) << clients;
  }
}

TEST(Gather, StopsGatheringWhenTrafficStops) {
  Gather gather;
  for (int i = 1; i <= 5; ++i) {
    gather.NotePolled(i * 1000);
    gather.NoteWaited(i * 1000 + 500, true);
  }
  EXPECT_GT(gather.SleepsUntil(100000), 5000);
  gather.NotePolled(6000);
  gather.NoteWaited(16000, false);
  gather.NotePolled(16000);
  EXPECT_LE(gather.SleepsUntil(100000), 16000);
}

}  // namespace gather_test
}  // namespace seam
