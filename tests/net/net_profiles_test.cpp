/// The named profiles keep their documented averages, and specs are read or refused.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "common/base/check.h"
#include "tests/support/traffic.h"

namespace seam {
namespace net_profiles_test {

/// Long run share of losses of a Gilbert-Elliott chain (Elliott 1963).
double ExpectedLoss(const ImpairProfile& profile) {
  const double p = profile.loss_good_to_bad, r = profile.loss_bad_to_good;
  const double bad = p / (p + r);
  return bad * profile.loss_in_bad + (1 - bad) * profile.loss_in_good;
}

TEST(Impair, EveryProfileHasTheMeanLossItPromises) {
  Traffic run;
  run.count = 60000;
  for (ImpairProfile profile : Profiles()) {
    profile.corrupt = 0;  // a flipped bit may hit the number we count by
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
  run.period_us = 10 * kSecondUs;  // far apart: no clump, no queue
  for (ImpairProfile profile : Profiles()) {
    if (profile.spikes_per_s > 0) continue;  // tested by themselves
    profile.corrupt = 0;
    const auto jitter_us = static_cast<double>(profile.jitter_mean_us);
    double expected_us = static_cast<double>(profile.delay_us) + jitter_us +
                         profile.reorder * static_cast<double>(profile.reorder_us);
    const auto copies = profile.duplicate / (1 + profile.duplicate);  // share of arrivals
    expected_us += copies * std::max(jitter_us, 1000.0);
    if (profile.rate_bits_per_s > 0) {
      expected_us += static_cast<double>((run.bytes + 28) * 8) * 1e6 /
                     static_cast<double>(profile.rate_bits_per_s);
    }
    const double mean_us = MeanDelayUs(Send(profile, run), run);
    const double deviation_us =
        jitter_us + std::sqrt(profile.reorder) * static_cast<double>(profile.reorder_us);
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
  std::int64_t min_us = INT64_MAX;
  for (const Arrived& one : arrived) {
    const std::int64_t delay_us = one.at_us - one.number * run.period_us;
    min_us = std::min(min_us, delay_us);
    variance += std::pow(static_cast<double>(delay_us) - mean_us, 2);
  }
  EXPECT_NEAR(std::sqrt(variance / static_cast<double>(arrived.size())), 10'000, 400);
  EXPECT_GE(min_us, 50'000);
  EXPECT_LT(min_us, 50'010);
}

TEST(Impair, BurstLossesComeInRunsOfTheLengthTheChainPromises) {
  const ImpairProfile broadband = FindProfile("broadband");  // all lost while bad: runs are 1/r
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

TEST(Impair, StarlinkLosesHalfForAMomentEveryFifteenSeconds) {
  Traffic run;
  run.period_us = 10'000;
  run.count = 150'000;
  std::vector<bool> here(static_cast<std::size_t>(run.count), false);
  for (const Arrived& one : Send(FindProfile("starlink"), run)) {
    here[static_cast<std::size_t>(one.number)] = true;
  }
  int lost_at_end = 0, lost_in_middle = 0;  // 100 periods of 1500 datagrams
  for (std::size_t i = 0; i < here.size(); ++i) {
    if (here[i]) continue;
    if (i % 1500 >= 1475) ++lost_at_end;  // the last 0.25 s, always within the outage
    if (i % 1500 < 25) ++lost_in_middle;
  }
  EXPECT_NEAR(lost_at_end, 1250, 130);
  EXPECT_LT(lost_in_middle, 80);
}

TEST(Profiles, AreFoundByNameAndHaveADescription) {
  for (const char* name : {"perfect", "lan", "fibre", "cable", "broadband", "wifi_busy", "4g",
                           "4g_driving", "3g", "starlink", "geo", "terrible", "soak", "corrupt",
                           "lte", "oneway100", "oneway200", "demo"}) {
    EXPECT_EQ(FindProfile(name).name, name);
  }
  std::set<std::string> names;
  for (const ImpairProfile& profile : Profiles()) {
    EXPECT_TRUE(names.insert(profile.name).second) << profile.name;
    EXPECT_FALSE(profile.about.empty()) << profile.name;
  }
  EXPECT_EQ(FindProfile("lte").rate_bits_per_s, FindProfile("4g").rate_bits_per_s);
}

TEST(Profiles, CanBeWrittenOut) {
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

TEST(Profiles, AWrongSpecIsOneLineThatNamesTheMistake) {
  for (const char* spec : {"nosuch",
                           "",
                           "delay=",
                           "delay=50",
                           "delay=-5ms",
                           "delay=50min",
                           "delay=61s",
                           "delay=nanms",
                           "delay=1e400s",
                           "loss=101%",
                           "loss=1.5",
                           "loss=x",
                           "reorder=2%",
                           "reorder=2%:30ms:1",
                           "rate=5",
                           "rate=0Mb",
                           "speed=5",
                           "delay=5ms,",
                           ",delay=5ms",
                           "delay=5ms,,loss=1%",
                           "delay=5ms;loss=1%",
                           "spikes=1:5ms:2ms",
                           "spikes=1e9:1ms:2ms",
                           "burst=1%"}) {
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

}  // namespace net_profiles_test
}  // namespace seam
