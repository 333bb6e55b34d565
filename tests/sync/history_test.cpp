/// The ring of recent states.

#include "common/sync/history.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "common/base/state_archive.h"

namespace seam {
namespace history_test {

/// Two bodies with states that encode tick and body.
std::vector<BodyState> StatesOf(std::int64_t tick) {
  std::vector<BodyState> states(2);
  for (std::size_t body = 0; body < 2; ++body) {
    states[body].position = {static_cast<float>(tick), static_cast<float>(body)};
  }
  return states;
}

/// State of a body that an edit makes.
BodyState Now(int body) { return StatesOf(-1)[static_cast<std::size_t>(body)]; }

TEST(History, RemembersTheLastTicksAndNoOthers) {
  const BodyTable bodies(2, 0);
  History history(bodies, 5, Now);
  EXPECT_EQ(history.newest(), -1);
  EXPECT_EQ(history.oldest(), -1);
  EXPECT_EQ(history.At(0, 0), nullptr);
  for (std::int64_t tick = 7; tick < 30; ++tick) {
    history.Record(tick, StatesOf(tick));
    const std::int64_t oldest = std::max<std::int64_t>(7, tick - 4);
    EXPECT_EQ(history.newest(), tick);
    EXPECT_EQ(history.oldest(), oldest);
    EXPECT_EQ(history.At(oldest - 1, 0), nullptr);
    EXPECT_EQ(history.At(tick + 1, 0), nullptr);
    EXPECT_EQ(history.At(-1, 0), nullptr);
    for (std::int64_t t = oldest; t <= tick; ++t) {
      for (int body = 0; body < 2; ++body) {
        ASSERT_NE(history.At(t, body), nullptr);
        const BodyState expected = StatesOf(t)[static_cast<std::size_t>(body)];
        EXPECT_EQ(history.At(t, body)->position, expected.position);
      }
    }
  }
}

TEST(History, CorrectionsStayAndClearForgets) {
  const BodyTable bodies(2, 0);
  History history(bodies, 5, Now);
  history.Record(0, StatesOf(0));
  history.Record(1, StatesOf(1));
  history.At(0, 1)->spin = 3;
  history.Record(2, StatesOf(2));
  EXPECT_EQ(history.At(0, 1)->spin, 3);
  EXPECT_EQ(history.At(0, 0)->spin, 0);
  history.Clear();
  EXPECT_EQ(history.newest(), -1);
  EXPECT_EQ(history.At(2, 0), nullptr);
  history.Record(100, StatesOf(100));  // a jump is fine now
  EXPECT_EQ(history.oldest(), 100);
  EXPECT_EQ(history.At(99, 0), nullptr);
}

TEST(HistoryDeathTest, AGapAborts) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const BodyTable bodies(2, 0);
  History history(bodies, 5, Now);
  history.Record(3, StatesOf(3));
  EXPECT_DEATH(history.Record(5, StatesOf(5)), "assertion failed");
  EXPECT_DEATH(history.Record(3, StatesOf(3)), "assertion failed");
  EXPECT_DEATH(history.Record(4, std::vector<BodyState>(1)), "assertion failed");
  EXPECT_DEATH(history.At(3, 2), "assertion failed");
}

TEST(History, ALoadedRingIsTheSavedOne) {
  const BodyTable bodies(2, 0);
  for (const bool still : {false, true}) {
    for (const std::int64_t newest : {8, 40}) {
      History history(bodies, 15, Now), loaded(bodies, 15, Now);
      for (std::int64_t tick = 7; tick <= newest; ++tick) {
        std::vector<BodyState> states = StatesOf(tick);
        if (still) states[1] = StatesOf(3)[1];
        history.Record(tick, states);
      }
      const auto second = [still](int body) { return still && body == 1; };
      StateArchive out;
      history.Persist(out, 0, second);
      const Bytes bytes = out.Take();
      StateArchive in(bytes);
      loaded.Persist(in, 0, second);
      ASSERT_TRUE(in.ok()) << in.status().why();
      for (std::int64_t tick = newest + 1; tick <= newest + 3; ++tick) {
        ASSERT_EQ(loaded.oldest(), history.oldest());
        for (std::int64_t t = history.oldest(); t <= history.newest(); ++t) {
          for (int body = 0; body < 2; ++body) {
            EXPECT_EQ(loaded.At(t, body)->position, history.At(t, body)->position);
          }
        }
        history.Record(tick, StatesOf(tick));
        loaded.Record(tick, StatesOf(tick));
      }
    }
  }
}

TEST(History, ADraftHasTheRingOfItsMoment) {
  const BodyTable bodies(2, 0);
  History history(bodies, 15, Now), now(bodies, 15, Now);
  for (std::int64_t tick = 7; tick <= 40; ++tick) history.Record(tick, StatesOf(tick));
  const auto none = [](int) { return false; };
  const BodyState* const then = std::as_const(history).At(38, 1);
  StateArchive out;
  history.Persist(out, 0, none);
  StateDraft draft = out.TakeDraft();
  history.At(38, 1)->position = {900, 900};
  EXPECT_EQ(then->position, StatesOf(38)[1].position) << "a reader of the same tick";
  for (std::int64_t tick = 41; tick <= 50; ++tick) history.Record(tick, StatesOf(10 * tick));
  const Bytes bytes = draft.Finish();
  StateArchive in(bytes);
  now.Persist(in, 0, none);
  ASSERT_TRUE(in.ok()) << in.status().why();
  EXPECT_EQ(now.newest(), 40);
  for (std::int64_t tick = now.oldest(); tick <= 40; ++tick) {
    for (int body = 0; body < 2; ++body) {
      EXPECT_EQ(now.At(tick, body)->position,
                StatesOf(tick)[static_cast<std::size_t>(body)].position);
    }
  }
  EXPECT_EQ(std::as_const(history).At(38, 1)->position, Vec2(900, 900));
}

TEST(History, ThePastBeforeATickIsLeftOut) {
  const BodyTable bodies(2, 0);
  History history(bodies, 30, Now);
  for (std::int64_t tick = 7; tick <= 40; ++tick) history.Record(tick, StatesOf(tick));
  std::size_t whole = 0;
  for (const std::int64_t from : {0, 35, 40}) {
    SCOPED_TRACE(from);
    StateArchive out;
    history.Persist(out, from, [](int) { return false; });
    const Bytes bytes = out.Take();
    whole = std::max(whole, bytes.size());
    EXPECT_EQ(bytes.size() < whole, from > 0);
    History loaded(bodies, 30, Now);
    StateArchive in(bytes);
    loaded.Persist(in, 0, [](int) { return false; });
    ASSERT_TRUE(in.ok()) << in.status().why();
    EXPECT_EQ(loaded.oldest(), std::max<std::int64_t>(from, 11));
    for (std::int64_t tick = loaded.oldest(); tick <= 40; ++tick) {
      EXPECT_EQ(loaded.At(tick, 1)->position, StatesOf(tick)[1].position);
    }
  }
}

TEST(History, DamagedStatesAreRefused) {
  const BodyTable bodies(2, 0);
  History history(bodies, 15, Now);
  std::vector<BodyState> states = StatesOf(7);
  states[1].spin = 1e30f;
  history.Record(7, states);
  StateArchive out;
  history.Persist(out, 0, [](int) { return false; });
  const Bytes bytes = out.Take();
  StateArchive in(bytes);
  History loaded(bodies, 15, Now);
  loaded.Persist(in, 0, [](int) { return false; });
  EXPECT_FALSE(in.ok());
}

}  // namespace history_test
}  // namespace seam
