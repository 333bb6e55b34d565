/// The impaired network has each of its effects, and repeats them for the same seed.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/support/traffic.h"

namespace seam {
namespace net_impair_test {

TEST(Impair, PerfectDeliversAtOnceAndUnchanged) {
  const Traffic run;
  for (const bool incoming : {false, true}) {
    Traffic way = run;
    way.incoming = incoming;
    const auto arrived = Send(FindProfile("perfect"), way);
    ASSERT_EQ(arrived.size(), 1000u);
    for (int i = 0; i < 1000; ++i) {
      EXPECT_EQ(arrived[static_cast<std::size_t>(i)],
                (Arrived{i, i * run.period_us, Numbered(i, run.bytes)}));
    }
  }
}

TEST(Impair, JitterKeepsTheOrderAtAnyRate) {
  Traffic run;
  run.period_us = 500;
  run.count = 20000;
  int last = -1;
  for (const Arrived& one : Send(FindProfile("delay=50ms,jitter=30ms"), run)) {
    EXPECT_EQ(one.number, ++last);
  }
  EXPECT_EQ(last, run.count - 1);
}

TEST(Impair, ReorderHoldsSomeBackAndLetsOthersPass) {
  Traffic run;
  run.period_us = 10'000;
  run.count = 20000;
  int held = 0, overtaken = 0, newest = -1;
  for (const Arrived& one : Send(FindProfile("delay=20ms,reorder=4%:50ms"), run)) {
    const std::int64_t delay_us = one.at_us - one.number * run.period_us;
    EXPECT_TRUE(delay_us == 20'000 || delay_us == 70'000) << delay_us;
    if (delay_us == 70'000) ++held;
    if (one.number < newest) ++overtaken;
    newest = std::max(newest, one.number);
  }
  EXPECT_NEAR(held, 800, 120);
  EXPECT_GT(overtaken, held * 9 / 10);
}

TEST(Impair, DuplicatesArriveTwiceAndTheCopyLater) {
  Traffic run;
  run.count = 20000;
  const auto arrived = Send(FindProfile("duplicate=25%"), run);
  EXPECT_NEAR(static_cast<double>(arrived.size()), 25000, 250);
  EXPECT_EQ(LossShare(arrived, run), 0);
}

TEST(Impair, CorruptFlipsExactlyOneBitOfItsShare) {
  Traffic run;
  run.count = 20000;
  run.bytes = 40;
  int wrong = 0;
  std::set<int> positions;
  std::size_t i = 0;
  for (const Arrived& one : Send(FindProfile("corrupt=5%"), run)) {
    const Bytes right = Numbered(static_cast<int>(i++), run.bytes);
    int flipped = 0;
    for (std::size_t k = 0; k < right.size(); ++k) {
      for (int bit = 0; bit < 8; ++bit) {
        if (((right[k] ^ one.data[k]) >> bit & 1) == 0) continue;
        ++flipped;
        positions.insert(static_cast<int>(k) * 8 + bit);
      }
    }
    EXPECT_LE(flipped, 1);
    wrong += flipped;
  }
  EXPECT_NEAR(wrong, 1000, 130);
  EXPECT_GT(positions.size(), 250u);  // of 320: anywhere
}

TEST(Impair, ARateLimitSpacesDatagramsAndDropsBeyondItsQueue) {
  Traffic run;
  run.bytes = 972;  // 1000 with the headers: 8 ms at 1 Mb/s
  run.period_us = 20'000;
  for (const Arrived& one : Send(FindProfile("rate=1Mb"), run)) {
    EXPECT_EQ(one.at_us, one.number * run.period_us + 8000);
  }
  run.period_us = 4000;  // twice what fits
  const auto arrived = Send(FindProfile("rate=1Mb"), run);
  for (std::size_t i = 1; i < arrived.size(); ++i) {
    EXPECT_EQ(arrived[i].at_us - arrived[i - 1].at_us, 8000);
  }
  EXPECT_NEAR(static_cast<double>(arrived.size()), 500 + 62, 3);  // half, and the queue's content
  for (const Arrived& one : arrived) {
    EXPECT_LE(one.at_us - one.number * run.period_us, ImpairedNet::kBacklogUsMax + 16'000);
  }
}

TEST(Impair, ASpikeHoldsEverythingAndReleasesItInABurst) {
  Traffic run;
  run.period_us = 10'000;
  run.count = 60'000;  // ten minutes
  const auto arrived = Send(FindProfile("delay=20ms,spikes=0.5:200ms:200ms"), run);
  ASSERT_EQ(arrived.size(), 60'000u);
  int bursts = 0;
  std::int64_t worst_us = 0;
  for (std::size_t i = 1; i < arrived.size(); ++i) {
    EXPECT_EQ(arrived[i].number, arrived[i - 1].number + 1);
    if (arrived[i].at_us - arrived[i - 1].at_us > 150'000) ++bursts;
    worst_us = std::max(worst_us, arrived[i].at_us - arrived[i].number * run.period_us);
  }
  EXPECT_NEAR(bursts, 600 / 2.2, 60);  // one per 2 s of calm and 0.2 s of stall
  EXPECT_LE(worst_us, 620'000);
  EXPECT_GT(worst_us, 200'000);
}

TEST(Impair, TheSameSeedGivesTheSameTraceAndAnotherSeedAnother) {
  Traffic run;
  run.period_us = 16'667;
  for (const char* name : {"demo", "wifi_busy", "4g_driving", "starlink", "terrible", "soak"}) {
    for (const bool incoming : {false, true}) {
      run.incoming = incoming;
      run.seed = 7;
      const auto first = Send(FindProfile(name), run);
      EXPECT_EQ(first, Send(FindProfile(name), run)) << name;
      run.seed = 8;
      EXPECT_FALSE(first == Send(FindProfile(name), run)) << name;
    }
  }
}

TEST(Impair, TheTwoDirectionsSufferIndependently) {
  Traffic run;
  const auto out = Send(FindProfile("loss=50%"), run);
  run.incoming = true;
  EXPECT_FALSE(out == Send(FindProfile("loss=50%"), run));
}

TEST(Impair, OtherPeersTrafficChangesNothing) {
  Traffic run;
  run.period_us = 5000;
  for (const char* name : {"4g", "soak", "starlink"}) {
    for (const bool incoming : {false, true}) {
      run.incoming = incoming;
      run.others = 0;
      const auto alone = Send(FindProfile(name), run);
      run.others = 2;
      EXPECT_EQ(alone, Send(FindProfile(name), run)) << name;
    }
  }
}

TEST(Impair, OneEffectDoesNotChangeAnothersDecisions) {
  const Traffic run;
  const auto lost = [&](const char* spec) {
    std::set<int> numbers;
    for (const Arrived& one : Send(FindProfile(spec), run)) numbers.insert(one.number);
    return numbers;
  };
  EXPECT_EQ(lost("loss=10%"), lost("loss=10%,delay=80ms,jitter=20ms,reorder=5%:20ms,corrupt=0%"));
}

TEST(Impair, FrequentAdvancesChangeNothing) {
  MemoryNetwork network;
  const ImpairProfile profile = FindProfile("soak");
  const auto trace = [&](std::int64_t step_us) {
    auto a = network.Attach(kHere), b = network.Attach(kThere);
    ImpairedNet impaired(*a, profile, profile, 3);
    std::vector<int> numbers;
    Address from;
    Bytes data;
    for (std::int64_t now_us = 0; now_us < 20 * kSecondUs; now_us += step_us) {
      impaired.Advance(now_us);
      if (now_us % 20'000 == 0) impaired.Send(kThere, Numbered(static_cast<int>(now_us / 20'000)));
      while (b->Receive(&from, &data)) numbers.push_back(NumberOf(data));
    }
    return numbers;
  };
  const auto coarse = trace(20'000);
  EXPECT_GT(coarse.size(), 500u);
  EXPECT_EQ(coarse, trace(1000));
}

TEST(Impair, ACutStopsAllTrafficAndLosesDatagramsInFlight) {
  MemoryNetwork network;
  auto a = network.Attach(kHere), b = network.Attach(kThere);
  const ImpairProfile profile = FindProfile("delay=10ms");
  ImpairedNet impaired(*a, profile, profile, 1);
  Address from;
  Bytes data;
  impaired.Advance(0);
  impaired.Send(kThere, Numbered(1));
  b->Send(kHere, Numbered(2));
  impaired.Advance(5'000);
  EXPECT_EQ(impaired.next_due_us(), 10'000);
  impaired.Cut(true);
  EXPECT_EQ(impaired.next_due_us(), INT64_MAX);
  impaired.Send(kThere, Numbered(3));
  b->Send(kHere, Numbered(4));
  impaired.Advance(50'000);
  b->Send(kHere, Numbered(5));
  impaired.Cut(false);
  impaired.Advance(90'000);
  EXPECT_FALSE(b->Receive(&from, &data));
  EXPECT_FALSE(impaired.Receive(&from, &data));
  impaired.Send(kThere, Numbered(6));
  b->Send(kHere, Numbered(7));
  impaired.Advance(100'000);
  impaired.Advance(110'000);
  ASSERT_TRUE(b->Receive(&from, &data));
  EXPECT_EQ(NumberOf(data), 6);
  ASSERT_TRUE(impaired.Receive(&from, &data));
  EXPECT_EQ(NumberOf(data), 7);
}

TEST(Impair, AFloodIsBoundedInMemory) {
  MemoryNetwork network;
  auto a = network.Attach(kHere), b = network.Attach(kThere);
  const ImpairProfile profile = FindProfile("delay=60s");
  ImpairedNet impaired(*a, profile, profile, 1);
  impaired.Advance(0);
  for (int i = 0; i < 10'000; ++i) impaired.Send(kThere, Bytes(1000, 1));
  for (std::uint16_t port = 10; port < 10'010; ++port) impaired.Send({1, port}, Bytes(1000, 1));
  impaired.Advance(60 * kSecondUs);
  Address from;
  Bytes data;
  std::size_t count = 0;
  while (b->Receive(&from, &data)) ++count;
  EXPECT_EQ(count, ImpairedNet::kPathBytesMax / 1000);
  const ImpairedTraffic traffic = impaired.traffic();
  EXPECT_EQ(traffic.offered, 20'000);
  EXPECT_GE(traffic.lost, 10'000 - static_cast<std::int64_t>(count)) << "of one path alone";
}

}  // namespace net_impair_test
}  // namespace seam
