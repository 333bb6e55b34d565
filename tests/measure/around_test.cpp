/// The error around an event: found by its word, cut out by ticks, and printed.

#include "common/measure/around/around.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "client/embed/local_session.h"
#include "common/base/check.h"
#include "common/measure/around/key_events.h"
#include "common/measure/revisions.h"
#include "tests/support/source_tree.h"

namespace seam {
namespace around_test {

/// A session of crossing, whose car hits the brick once.
struct Crossing {
  explicit Crossing(const char* reconcile) {
    const Scene scene = LoadScene((Root() / "scenes/crossing.toml").string());
    LocalSessionConfig config;
    config.reconcile = reconcile;
    config.impair = "delay=100ms";
    config.drive = "script";
    config.keep = true;
    session = std::make_unique<LocalSession>(scene, config);
    session->RunToTick(300);
    oracle = ComputeOracle(recording());
    measures = Measure(recording(), oracle);
  }
  const Recording& recording() { return session->recording(); }

  std::unique_ptr<LocalSession> session;
  Oracle oracle;
  Measures measures;
};

TEST(ErrorAroundAnEvent, HasTheErrorOfEachTickBesideTheContact) {
  Crossing run("fade");
  const auto around = FindErrorAround(run.recording(), run.oracle, run.measures, "contact");
  ASSERT_TRUE(around.has_value());
  // The brick lies still until the car hits it: that is the tick at which the oracle has it jump.
  const Scene scene = RecordedScene(run.recording().room);
  const std::set<PartId> struck = StruckAssemblies(scene);
  ASSERT_EQ(struck.size(), 1u);
  const auto speed = [&](std::int64_t tick) {
    return run.oracle.At(tick, *struck.begin())->velocity.norm();
  };
  EXPECT_LT(speed(around->event_tick - 1), 0.5f);
  EXPECT_GT(speed(around->event_tick), 1.0f);
  EXPECT_EQ(around->first_after, -30);
  EXPECT_EQ(around->After(30), 0);
  ASSERT_EQ(around->error_m.size(), 30u + 120u + 1u);
  for (std::size_t i = 0; i < around->error_m.size(); ++i) {
    const std::int64_t tick = around->event_tick - 30 + static_cast<std::int64_t>(i);
    EXPECT_EQ(around->error_m[i],
              run.measures
                  .shown_error_by_tick_m[static_cast<std::size_t>(tick - run.measures.first_tick)]);
  }
  // A hit that is seen late is an error after it, not before.
  EXPECT_GT(*std::max_element(around->error_m.begin() + 30, around->error_m.end()), 0.1);
  EXPECT_LT(around->error_m[29], 0.01);
}

TEST(ErrorAroundAnEvent, IsFoundByEachWordOrNotAtAll) {
  Crossing run("fade");
  const auto find = [&](const char* word) {
    return FindErrorAround(run.recording(), run.oracle, run.measures, word);
  };
  const auto worst = find("worst");
  ASSERT_TRUE(worst.has_value());
  const auto& errors = run.measures.shown_error_by_tick_m;
  EXPECT_EQ(worst->error_m[static_cast<std::size_t>(-worst->first_after)],
            *std::max_element(errors.begin(), errors.end()));
  const auto early = find("3");  // less than half a second of the session is before it
  ASSERT_TRUE(early.has_value());
  EXPECT_EQ(early->event_tick, 3);
  EXPECT_EQ(early->event, "tick 3");
  EXPECT_EQ(early->first_after, run.measures.first_tick - 3);
  EXPECT_FALSE(find("5000").has_value());
  EXPECT_FALSE(find("hand-over").has_value()) << "nothing changes hands in this scene";
  EXPECT_THROW(RequireEventWord("impact"), OperatorError);
  EXPECT_THROW(RequireEventWord("-3"), OperatorError);
  EXPECT_NO_THROW(RequireEventWord("hand-over"));
}

TEST(ErrorAroundAnEvent, IsPrintedWithItsPeakAndTheTimeUntilItHasSettled) {
  ErrorAround run{"a,b", "contact", 120, 60, -2, {0.1, 0.2, 0.3, 1, 0.5, 0.05, 0.2, 0.1, 0.02}};
  EXPECT_EQ(FormatAround({run}),
            "run  event          at s    at it m     most m    after s  settled s\n"
            "a,b  contact        2.00        0.3          1       0.02       0.08\n");
  EXPECT_EQ(AroundCsv({run}).substr(0, 71),
            "run,event,event_s,after_s,error_m\n\"a,b\",contact,2.0000,-0.0333,0.1\n\"a,b");
  run.error_m.back() = 0.9;
  EXPECT_NE(FormatAround({run}).find("0.02          -\n"), std::string::npos) << "never";
}

}  // namespace around_test
}  // namespace seam
