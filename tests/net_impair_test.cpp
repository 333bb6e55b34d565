/// The impaired network does what its profiles promise, and does it again for the same seed.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "common/base/check.h"
#include "common/net/impair.h"
#include "common/net/memory.h"

namespace seam {
namespace {

const Address kHere{0x7f000001, 1}, kThere{0x7f000001, 2}, kOther{0x7f000001, 3};
constexpr std::int64_t kSecondUs = 1'000'000;

/// A datagram that says its number, padded to `bytes`.
Bytes Numbered(int number, std::size_t bytes = 4) {
  Bytes data(bytes, 0);
  for (std::size_t i = 0; i < 4; ++i) data[i] = static_cast<std::uint8_t>(number >> (8 * i));
  return data;
}

int NumberOf(const Bytes& data) {
  int number = 0;
  for (std::size_t i = 0; i < 4; ++i) number |= data[i] << (8 * i);
  return number;
}

struct Arrived {
  int number = 0;
  std::int64_t at_us = 0;
  Bytes data;
  bool operator==(const Arrived& o) const {
    return number == o.number && at_us == o.at_us && data == o.data;
  }
};

/// How a run is driven; every field has a default for tests that do not care.
struct Traffic {
  int count = 1000;                    // datagrams sent here -> there
  std::int64_t period_us = 100'000;
  std::size_t bytes = 60;
  std::uint64_t seed = 1;
  bool incoming = false;               // impair at the receiver instead of the sender
  int others = 0;                      // per datagram, so many more from and to somebody else
};

/// Sends Traffic::count datagrams through `profile`, and steps from due time to due time, so that
/// arrival times are exact.
std::vector<Arrived> Send(const ImpairProfile& profile, const Traffic& run) {
  MemoryNetwork network;
  auto a = network.Attach(kHere), b = network.Attach(kThere), c = network.Attach(kOther);
  const ImpairProfile none;
  Net& inner = run.incoming ? *b : *a;
  ImpairedNet impaired(inner, profile, profile, run.seed);
  Net& sender = run.incoming ? *a : static_cast<Net&>(impaired);
  Net& receiver = run.incoming ? static_cast<Net&>(impaired) : *b;
  std::vector<Arrived> arrived;
  const auto step = [&](std::int64_t now_us) {
    impaired.Advance(now_us);
    Address from;
    Bytes data;
    while (receiver.Receive(&from, &data)) {
      if (from == kHere) arrived.push_back({NumberOf(data), now_us, data});
    }
  };
  for (int i = 0; i < run.count; ++i) {
    const std::int64_t now_us = i * run.period_us;
    while (impaired.next_due_us() < now_us) step(impaired.next_due_us());
    step(now_us);
    for (int k = 0; k < run.others; ++k) {
      (run.incoming ? c.get() : &sender)->Send(run.incoming ? kThere : kOther, Numbered(-1, 900));
    }
    sender.Send(kThere, Numbered(i, run.bytes));
    step(now_us);
  }
  while (impaired.next_due_us() < INT64_MAX) step(impaired.next_due_us());
  return arrived;
}

double LossShare(const std::vector<Arrived>& arrived, const Traffic& run) {
  std::set<int> numbers;
  for (const Arrived& one : arrived) numbers.insert(one.number);
  return 1 - static_cast<double>(numbers.size()) / run.count;
}

double MeanDelayUs(const std::vector<Arrived>& arrived, const Traffic& run) {
  double sum_us = 0;
  for (const Arrived& one : arrived) {
    sum_us += static_cast<double>(one.at_us - one.number * run.period_us);
  }
  return sum_us / static_cast<double>(arrived.size());
}

/// Long run share of losses of a Gilbert-Elliott chain (Elliott 1963).
double ExpectedLoss(const ImpairProfile& profile) {
  const double p = profile.loss_good_to_bad, r = profile.loss_bad_to_good;
  const double bad = p / (p + r);
  return bad * profile.loss_in_bad + (1 - bad) * profile.loss_in_good;
}

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

TEST(Impair, EveryProfileHasTheMeanLossItPromises) {
  Traffic run;
  run.count = 60000;
  for (ImpairProfile profile : Profiles()) {
    profile.corrupt = 0;              // a flipped bit may hit the number we count by
    double expected = ExpectedLoss(profile);
    if (profile.outage_period_us > 0) {
      const double share = static_cast<double>(profile.outage_min_us + profile.outage_max_us) / 2 /
                           static_cast<double>(profile.outage_period_us);
      expected = 1 - (1 - expected) * (1 - share * profile.outage_loss);
    }
    const double both_copies = expected * (1 - profile.duplicate * (1 - expected));
    const double loss = LossShare(Send(profile, run), run);
    // Bursts make the count vary more than a coin's: 1/r datagrams are lost together.
    const double deviation =
        std::sqrt(expected / run.count * (1 + 2 / std::max(0.1, profile.loss_bad_to_good)));
    EXPECT_NEAR(loss, both_copies, 4 * deviation + 1e-9) << profile.name;
  }
}

TEST(Impair, EveryProfileHasTheMeanDelayItPromises) {
  Traffic run;
  run.count = 3000;
  run.period_us = 10 * kSecondUs;     // far apart: no clump, no queue
  for (ImpairProfile profile : Profiles()) {
    if (profile.spikes_per_s > 0) continue;   // tested by themselves
    profile.corrupt = 0;
    const auto jitter_us = static_cast<double>(profile.jitter_mean_us);
    double expected_us = static_cast<double>(profile.delay_us) + jitter_us +
                         profile.reorder * static_cast<double>(profile.reorder_us);
    const auto copies = profile.duplicate / (1 + profile.duplicate);   // share of arrivals
    expected_us += copies * std::max(jitter_us, 1000.0);
    if (profile.rate_bits_per_s > 0) {
      expected_us += static_cast<double>((run.bytes + 28) * 8) * 1e6 /
                     static_cast<double>(profile.rate_bits_per_s);
    }
    const double mean_us = MeanDelayUs(Send(profile, run), run);
    const double deviation_us = jitter_us + std::sqrt(profile.reorder) *
                                                static_cast<double>(profile.reorder_us);
    EXPECT_NEAR(mean_us, expected_us, 2 + 4.5 * deviation_us / std::sqrt(2000.0)) << profile.name;
  }
}

TEST(Impair, TheDemoProfileIsFiftyMillisecondsTenOfJitterAndOnePercent) {
  const ImpairProfile demo = FindProfile("demo");
  Traffic run;
  run.count = 40000;
  run.period_us = kSecondUs;
  const auto arrived = Send(demo, run);
  EXPECT_NEAR(LossShare(arrived, run), 0.01, 0.002);
  const double mean_us = MeanDelayUs(arrived, run);
  EXPECT_NEAR(mean_us, 60'000, 250);
  double variance = 0;
  std::int64_t least_us = INT64_MAX;
  for (const Arrived& one : arrived) {
    const std::int64_t delay_us = one.at_us - one.number * run.period_us;
    least_us = std::min(least_us, delay_us);
    variance += std::pow(static_cast<double>(delay_us) - mean_us, 2);
  }
  EXPECT_NEAR(std::sqrt(variance / static_cast<double>(arrived.size())), 10'000, 400);
  EXPECT_GE(least_us, 50'000);
  EXPECT_LT(least_us, 50'010);
}

TEST(Impair, BurstLossesComeInRunsOfTheLengthTheChainPromises) {
  const ImpairProfile broadband = FindProfile("broadband");   // all lost while bad: runs are 1/r
  Traffic run;
  run.count = 100000;
  std::vector<bool> here(static_cast<std::size_t>(run.count), false);
  for (const Arrived& one : Send(broadband, run)) here[static_cast<std::size_t>(one.number)] = true;
  int runs = 0, lost = 0;
  for (std::size_t i = 0; i < here.size(); ++i) {
    if (here[i]) continue;
    ++lost;
    if (i == 0 || here[i - 1]) ++runs;
  }
  EXPECT_NEAR(static_cast<double>(lost) / runs, 1 / broadband.loss_bad_to_good, 0.15);
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
  EXPECT_GT(positions.size(), 250u);   // of 320: anywhere
}

TEST(Impair, ARateLimitSpacesDatagramsAndDropsBeyondItsQueue) {
  Traffic run;
  run.bytes = 972;                     // 1000 with the headers: 8 ms at 1 Mb/s
  run.period_us = 20'000;
  for (const Arrived& one : Send(FindProfile("rate=1Mb"), run)) {
    EXPECT_EQ(one.at_us, one.number * run.period_us + 8000);
  }
  run.period_us = 4000;                // twice what fits
  const auto arrived = Send(FindProfile("rate=1Mb"), run);
  for (std::size_t i = 1; i < arrived.size(); ++i) {
    EXPECT_EQ(arrived[i].at_us - arrived[i - 1].at_us, 8000);
  }
  EXPECT_NEAR(static_cast<double>(arrived.size()), 500 + 62, 3);   // half, and the queue's content
  for (const Arrived& one : arrived) {
    EXPECT_LE(one.at_us - one.number * run.period_us, ImpairedNet::kBacklogUsMax + 16'000);
  }
}

TEST(Impair, ASpikeHoldsEverythingAndReleasesItInABurst) {
  Traffic run;
  run.period_us = 10'000;
  run.count = 60'000;                  // ten minutes
  const auto arrived = Send(FindProfile("delay=20ms,spikes=0.5:200ms:200ms"), run);
  ASSERT_EQ(arrived.size(), 60'000u);
  int bursts = 0;
  std::int64_t worst_us = 0;
  for (std::size_t i = 1; i < arrived.size(); ++i) {
    EXPECT_EQ(arrived[i].number, arrived[i - 1].number + 1);
    if (arrived[i].at_us - arrived[i - 1].at_us > 150'000) ++bursts;
    worst_us = std::max(worst_us, arrived[i].at_us - arrived[i].number * run.period_us);
  }
  EXPECT_NEAR(bursts, 600 / 2.2, 60);   // one per 2 s of calm and 0.2 s of stall
  EXPECT_LE(worst_us, 620'000);
  EXPECT_GT(worst_us, 200'000);
}

TEST(Impair, StarlinkLosesHalfForAMomentEveryFifteenSeconds) {
  Traffic run;
  run.period_us = 10'000;
  run.count = 150'000;
  std::vector<bool> here(static_cast<std::size_t>(run.count), false);
  for (const Arrived& one : Send(FindProfile("starlink"), run)) {
    here[static_cast<std::size_t>(one.number)] = true;
  }
  int lost_at_end = 0, lost_in_middle = 0;    // 100 periods of 1500 datagrams
  for (std::size_t i = 0; i < here.size(); ++i) {
    if (here[i]) continue;
    if (i % 1500 >= 1475) ++lost_at_end;      // the last 0.25 s, always within the outage
    if (i % 1500 < 25) ++lost_in_middle;
  }
  EXPECT_NEAR(lost_at_end, 1250, 130);
  EXPECT_LT(lost_in_middle, 80);
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

TEST(Impair, NothingPassesWhileCutAndWhatWasUnderWayIsLost) {
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
}

TEST(Profiles, AreFoundByNameAndAllHaveALineAbout) {
  for (const char* name :
       {"perfect", "lan", "fibre", "cable", "broadband", "wifi_busy", "4g", "4g_driving", "3g",
        "starlink", "geo", "terrible", "soak", "corrupt", "lte", "oneway100", "oneway200",
        "demo"}) {
    EXPECT_EQ(FindProfile(name).name, name);
  }
  std::set<std::string> names;
  for (const ImpairProfile& profile : Profiles()) {
    EXPECT_TRUE(names.insert(profile.name).second) << profile.name;
    EXPECT_FALSE(profile.about.empty()) << profile.name;
  }
  EXPECT_EQ(FindProfile("lte").rate_bits_per_s, FindProfile("4g").rate_bits_per_s);
}

TEST(Profiles, CanBeSpelledOut) {
  const ImpairProfile profile = FindProfile(
      "delay=50ms,jitter=500us,loss=1%,reorder=2%:0.03s,duplicate=0.25,corrupt=0.1%,rate=2.5Mb,"
      "burst=1%:50%,spikes=0.1:100ms:600ms");
  EXPECT_EQ(profile.delay_us, 50'000);
  EXPECT_EQ(profile.jitter_mean_us, 500);
  EXPECT_DOUBLE_EQ(profile.loss_in_good, 0.01);
  EXPECT_DOUBLE_EQ(profile.reorder, 0.02);
  EXPECT_EQ(profile.reorder_us, 30'000);
  EXPECT_DOUBLE_EQ(profile.duplicate, 0.25);
  EXPECT_DOUBLE_EQ(profile.corrupt, 0.001);
  EXPECT_EQ(profile.rate_bits_per_s, 2'500'000);
  EXPECT_DOUBLE_EQ(profile.loss_good_to_bad, 0.01);
  EXPECT_DOUBLE_EQ(profile.loss_bad_to_good, 0.5);
  EXPECT_DOUBLE_EQ(profile.spikes_per_s, 0.1);
  EXPECT_EQ(profile.spike_min_us, 100'000);
  EXPECT_EQ(profile.spike_max_us, 600'000);
}

TEST(Profiles, AWrongSpecIsOneLineThatSaysWhatToChange) {
  for (const char* spec :
       {"nosuch", "", "delay=", "delay=50", "delay=-5ms", "delay=50min", "delay=61s", "delay=nanms",
        "delay=1e400s", "loss=101%", "loss=1.5", "loss=x", "reorder=2%", "reorder=2%:30ms:1",
        "rate=5", "rate=0Mb", "speed=5", "delay=5ms,", ",delay=5ms", "delay=5ms,,loss=1%",
        "delay=5ms;loss=1%", "spikes=1:5ms:2ms", "spikes=1e9:1ms:2ms", "burst=1%"}) {
    try {
      (void)FindProfile(spec);
      ADD_FAILURE() << "accepted " << spec;
    } catch (const OperatorError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
  try {
    (void)FindProfile("nosuch");
  } catch (const OperatorError& error) {
    EXPECT_NE(std::string(error.what()).find("broadband"), std::string::npos);
  }
}

}  // namespace
}  // namespace seam
