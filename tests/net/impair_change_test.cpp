/// A network whose impairment changes while it is used.

#include <gtest/gtest.h>

#include "tests/support/traffic.h"

namespace seam {
namespace impair_change_test {

/// An impaired end with a peer, and the times at which its datagrams arrived there.
struct Way {
  explicit Way(const std::string& profile, std::uint64_t seed = 1)
      : impaired(*a, FindProfile(profile), FindProfile(profile), seed) {}

  void Change(const std::string& profile) {
    impaired.Change(FindProfile(profile), FindProfile(profile));
  }
  void Look() {
    impaired.Advance(now_us);
    Address from;
    Bytes data;
    while (b->Receive(&from, &data)) arrived.push_back({NumberOf(data), now_us, data});
  }
  /// Advances by milliseconds; sends a datagram in each if it has a number.
  void Run(int ms, int* number = nullptr) {
    for (const std::int64_t end = now_us + 1000 * ms; now_us < end; now_us += 1000) {
      Look();
      if (number != nullptr) impaired.Send(kThere, Numbered((*number)++));
    }
  }

  MemoryNetwork network;
  std::unique_ptr<Net> a = network.Attach(kHere), b = network.Attach(kThere);
  ImpairedNet impaired;
  std::vector<Arrived> arrived;
  std::int64_t now_us = 0;
};

TEST(ImpairChange, ActsOnWhatIsSentAfterIt) {
  Way way("delay=50ms");
  int number = 0;
  way.Run(100, &number);
  way.Change("delay=10ms");
  way.Run(100, &number);
  way.Run(100);
  ASSERT_EQ(way.arrived.size(), 200u) << "nothing in flight is lost";
  for (const Arrived& one : way.arrived) {
    EXPECT_EQ(one.at_us - 1000 * one.number, one.number < 100 ? 50000 : 10000) << one.number;
  }
}

TEST(ImpairChange, LosesAsTheNewProfileSaysAndAsOftenAsTheSeedLets) {
  std::vector<std::size_t> counts;
  for (int again = 0; again < 2; ++again) {
    Way way("perfect", 5);
    int number = 0;
    way.Run(1000, &number);
    EXPECT_EQ(way.arrived.size(), 999u) << "the last is sent after the last look";
    way.Change("loss=50%");
    way.Run(4000, &number);
    counts.push_back(way.arrived.size());
    EXPECT_NEAR(static_cast<double>(counts.back()), 3000, 160);
    way.Change("perfect");
    way.Run(1000, &number);
    // The last one under loss was not looked for yet.
    EXPECT_NEAR(static_cast<double>(way.arrived.size() - counts.back()), 999.5, 0.6);
  }
  EXPECT_EQ(counts[0], counts[1]);
}

}  // namespace impair_change_test
}  // namespace seam
