/// Decision of each body's activity, and the players whose inputs a peer needs.

#include "common/sync/reach/activities.h"

#include <gtest/gtest.h>

#include <map>

#include "common/base/random.h"
#include "common/physics/part_places.h"
#include "common/sync/edits/edit_order.h"
#include "common/sync/inputs/input_track.h"
#include "common/sync/replica.h"
#include "tests/support/replica_test_access.h"

namespace seam {
namespace activities_test {

/// The own box at 0, others along a line; no gravity.
const char* const kLine = R"(
gravity = [0, 0]
[[player]]
name = "ann"
vehicle = "own"
[[player]]
name = "bob"
vehicle = "far"
[[part]]
name = "own"
box = [1, 1]
[[part]]
name = "beside"
box = [1, 1]
position = [1.1, 0]
[[part]]
name = "far"
box = [1, 1]
position = [60, 0]
)";
constexpr int kOwn = 0, kBeside = 1, kFar = 2;

/// A client that has the first box and follows nothing.
class Line {
 public:
  explicit Line(const char* text = kLine, const char* reconcile = "rollback")
      : Line(text, MakeSyncConfig("buffer", reconcile)) {}
  Line(const char* text, const SyncConfig& config)
      : replica(ParseScene(text, "line.toml"), config, 1, 0) {
    for (int m = 0; m < replica.authority().count(); ++m) {
      AuthorityRecord record;
      record.authority = m == kOwn ? 1 : 2;
      record.epoch = 1;
      replica.authority().Set(m, record);
    }
    replica.RolesChanged();
  }
  /// This peer is to have it now.
  void Take(int mechanism) {
    AuthorityRecord record = replica.authority().at(mechanism);
    record.authority = 1;
    record.epoch = 2;
    replica.authority().Set(mechanism, record);
    replica.RolesChanged();
  }
  void Steps(int ticks) {
    for (int i = 0; i < ticks; ++i) replica.Step();
  }
  Activity Of(int body) const { return replica.world().activity(body); }
  /// Its authority says where it is and how fast.
  void Hear(int body, const Vec2& position, const Vec2& velocity) {
    HearOf(replica.tick(), body, position, velocity);
  }
  void HearOf(std::int64_t tick, int body, const Vec2& position, const Vec2& velocity) {
    States states;
    states.peer = 2;
    states.tick = tick;
    states.composition = static_cast<std::int64_t>(replica.world().composition().hash);
    BodyState state;
    state.position = position;
    state.velocity = velocity;
    WireBody told = Quantise(state);
    told.id = replica.world().id(body);
    told.epoch = 1;
    for (const States& packed : Pack(states, {told})) replica.Receive(packed);
  }

  Replica replica;
};

TEST(Activities, ANeighbourIsPresentAndADistantBodyIsNot) {
  Line line;
  line.Steps(10);
  EXPECT_EQ(line.Of(kOwn), Activity::kSimulated);
  EXPECT_EQ(line.Of(kBeside), Activity::kPrescribed);
  EXPECT_EQ(line.Of(kFar), Activity::kDisplayed);
}

/// A client that publishes no view of distant bodies.
SyncConfig ShowsNear() {
  SyncConfig config = MakeSyncConfig("buffer", "rollback");
  config.shows_far = false;
  return config;
}

constexpr char kDistant[] = R"(
gravity = [0, 0]
bounds = [[-1000, -1000], [1000, 1000]]
[[player]]
name = "ann"
vehicle = "own"
[[part]]
name = "own"
box = [1, 1]
[[part]]
name = "beside"
box = [1, 1]
position = [1.1, 0]
[[part]]
name = "far"
box = [1, 1]
position = [300, 0]
)";

TEST(Activities, ADistantBodyIsParkedOnlyOutOfView) {
  Line all(kDistant), near(kDistant, ShowsNear());
  all.Steps(30);
  near.Steps(30);
  EXPECT_EQ(all.Of(kFar), Activity::kDisplayed);
  EXPECT_EQ(near.Of(kFar), Activity::kParked);
  EXPECT_EQ(near.Of(kBeside), Activity::kPrescribed);
  near.Hear(kFar, {40, 0}, {0, 0});
  near.Steps(1);
  EXPECT_EQ(near.Of(kFar), Activity::kDisplayed) << "it has come into view";
}

TEST(Activities, AParkedBodyIsSimulatedAtOnceIfItIsTaken) {
  Line line(kDistant, ShowsNear());
  line.Steps(30);
  ASSERT_EQ(line.Of(kFar), Activity::kParked);
  line.Take(kFar);
  EXPECT_EQ(line.Of(kFar), Activity::kSimulated);
}

TEST(Activities, NoBodyIsParkedWhenAnEditActs) {
  Line line(kDistant, ShowsNear());
  line.Steps(30);
  ASSERT_EQ(line.Of(kFar), Activity::kParked);
  BlastEdit blast;
  blast.centre = {300, 2};
  blast.radius = 4;
  blast.impulse = 3;
  EditOrder order = ToOrder(Edit(blast));
  order.tick = line.replica.tick();
  order.number = line.replica.revision();
  ASSERT_TRUE(line.replica.Queue(order));
  line.replica.ApplyEdits();
  EXPECT_EQ(line.Of(kFar), Activity::kDisplayed);
  line.Steps(30);
  EXPECT_EQ(line.Of(kFar), Activity::kParked);
}

TEST(Activities, NoBodyIsParkedInAReplicaThatStartsAgain) {
  Line line(kDistant, ShowsNear());
  line.Steps(30);
  ASSERT_EQ(line.Of(kFar), Activity::kParked);
  line.replica.StartAt(1000);
  EXPECT_EQ(line.Of(kFar), Activity::kDisplayed);
}

TEST(Activities, ABodyOfARuleThatDoesNotReckonIsKinematic) {
  Line line(kLine, MakeSyncConfig("strict", ""));
  line.Steps(10);
  EXPECT_EQ(line.Of(kOwn), Activity::kSimulated);
  EXPECT_EQ(line.Of(kBeside), Activity::kKinematic);
  EXPECT_EQ(line.Of(kFar), Activity::kKinematic);
}

TEST(Activities, ASleeperThatMayBeDormantNeedsNoNeighbours) {
  Line line;
  line.replica.AllowDormant({1, 0, 0}, {});
  line.Steps(90);
  EXPECT_EQ(line.Of(kOwn), Activity::kDormant) << "it sleeps";
  EXPECT_EQ(line.Of(kBeside), Activity::kDisplayed);
  line.replica.AllowDormant({0, 0, 0}, {});
  line.Steps(12);
  EXPECT_EQ(line.Of(kBeside), Activity::kPrescribed);
}

TEST(Activities, AnApproachingBodyIsPresentBeforeItArrives) {
  Line line;
  line.Steps(10);
  const float speed = 100;
  int there = -1;
  for (int tick = 0; tick < 60 && there < 0; ++tick) {
    line.Hear(kFar, {60 - speed * static_cast<float>(tick) / 60, 0}, {-speed, 0});
    line.Steps(1);
    if (line.Of(kFar) == Activity::kPrescribed) there = tick;
  }
  ASSERT_GE(there, 0);
  const float gap = line.replica.world().Read(kFar).position.x() - 1;
  EXPECT_GT(gap, 0) << "it was there in time";
  EXPECT_LT(gap, 45) << "and not all the time";
}

/// Its reckoned pose on arrival counted as received, and a state of an earlier tick was ignored as
/// old.
TEST(Activities, AnArrivingBodyFollowsAStateFromBeforeItsArrival) {
  Line line;
  line.Steps(10);
  line.Hear(kFar, {20, 0}, {-20, 0});
  const std::int64_t heard = line.replica.tick();
  for (int tick = 0; tick < 60 && line.Of(kFar) != Activity::kPrescribed; ++tick) line.Steps(1);
  ASSERT_EQ(line.Of(kFar), Activity::kPrescribed);
  ASSERT_GT(line.replica.tick(), heard + 1);
  line.HearOf(heard + 1, kFar, {19.7f, 0}, {0, 0});
  line.Steps(1);
  EXPECT_NEAR(line.replica.world().Read(kFar).position.x(), 19.7, 0.01) << "it has stopped";
}

TEST(Activities, ABodyThatIsNotPresentIsShownOnItsPath) {
  Line line;
  line.Steps(10);
  line.Hear(kFar, {60, 0}, {0, 3});
  line.Steps(40);
  ASSERT_EQ(line.Of(kFar), Activity::kDisplayed);
  const View view = line.replica.MakeView();
  EXPECT_NEAR(view.x[kFar], 60, 1e-3);
  EXPECT_NEAR(view.y[kFar], 3 * 40 / 60.0, 0.06) << "less what still glides";
}

TEST(Activities, ATakenBodyIsPresentAtOnce) {
  Line line;
  line.Steps(10);
  ASSERT_EQ(line.Of(kFar), Activity::kDisplayed);
  line.Take(kFar);
  EXPECT_EQ(line.Of(kFar), Activity::kSimulated);
  line.Steps(1);
  EXPECT_EQ(line.Of(kFar), Activity::kSimulated);
}

/// A wheel that was told of in a crash had travelled 15 m along its spring meanwhile, and the
/// engine pulled it back with a crash.
TEST(Activities, ASimulatedWheelHasNotTravelledAlongItsSpring) {
  Line line(R"(
gravity = [0, 0]
[[player]]
name = "ann"
vehicle = "own"
[[part]]
name = "own"
box = [1, 1]
[[part]]
name = "car"
box = [2, 0.5]
position = [60, 0]
[[part]]
name = "wheel"
circle = 0.4
position = [60, -0.6]
[[joint]]
name = "axle"
kind = "wheel"
a = "car"
b = "wheel"
frequency = 5
)",
            "retrospect");  // rollback would replay from the state heard
  constexpr int kCar = 1, kWheel = 2;
  line.Steps(10);
  line.Hear(kCar, {60, 0}, {0, 0});
  line.Hear(kWheel, {60, -0.6f}, {0, -15});
  line.Steps(60);
  ASSERT_EQ(line.Of(kWheel), Activity::kDisplayed);
  line.Take(1);
  ASSERT_EQ(line.Of(kWheel), Activity::kSimulated);
  const World& world = line.replica.world();
  // 0.6 m, and a swing of 15 m/s at 5 Hz: 0.48 m.
  EXPECT_LT((world.Read(kCar).position - world.Read(kWheel).position).norm(), 1.1f);
  for (int tick = 0; tick < 60; ++tick) {
    line.Steps(1);
    EXPECT_LT(world.Read(kWheel).velocity.norm(), 16);
    EXPECT_LT(world.Read(kCar).velocity.norm(), 16);
  }
}

TEST(Drivers, ConcernPeersThatSimulateTheirBodies) {
  Line line;
  EXPECT_TRUE(line.replica.drivers().Concerns(0)) << "its own player";
  EXPECT_FALSE(line.replica.drivers().Concerns(1));
  AuthorityRecord record = line.replica.authority().at(kFar);
  record.secondaries.Add(1);
  line.replica.authority().Set(kFar, record);
  line.replica.RolesChanged();
  EXPECT_TRUE(line.replica.drivers().Concerns(1)) << "it follows his box";
}

/// InputTrack's contract, implemented with a map.
struct PlainTrack {
  std::map<std::int64_t, Input> known;
  void Note(std::int64_t tick, const Input& input) {
    if (!known.empty() && tick < known.rbegin()->first - InputTrack::kKeepTicks) return;
    known.emplace(tick, input);
    while (known.begin()->first < known.rbegin()->first - InputTrack::kKeepTicks) {
      known.erase(known.begin());
    }
  }
  Input At(std::int64_t tick) const {
    const auto after = known.upper_bound(tick);
    return after == known.begin() ? Input{} : std::prev(after)->second;
  }
  bool DiffersFromPrediction(std::int64_t from) const {
    for (auto it = known.lower_bound(from); it != known.end(); ++it) {
      if (!(it->second == At(it->first - 1))) return true;
    }
    return false;
  }
};

TEST(InputTrack, KeepsNewInputsAndForgetsOldOnes) {
  Random random(7);
  for (int round = 0; round < 20; ++round) {
    InputTrack track;
    PlainTrack plain;
    std::int64_t near = 0;
    for (int i = 0; i < 2000; ++i) {
      near += random.Uniform(0, 1) < 0.01 ? 400 : 1;
      const auto tick = near + static_cast<std::int64_t>(random.Uniform(-30, 30));
      if (tick < 0) continue;
      Input input;
      input.drive = static_cast<std::int8_t>(random.Uniform(0, 3));
      input.buttons = static_cast<std::int16_t>(random.Uniform(0, 2));
      track.Note(tick, input);
      plain.Note(tick, input);
      const auto asked = near + static_cast<std::int64_t>(random.Uniform(-700, 50));
      ASSERT_EQ(track.newest(), plain.known.rbegin()->first);
      ASSERT_EQ(track.knows(asked), plain.known.count(asked) != 0) << asked;
      ASSERT_TRUE(track.At(asked) == plain.At(asked)) << asked;
      ASSERT_EQ(track.DiffersFromPrediction(asked), plain.DiffersFromPrediction(asked)) << asked;
      const int before = plain.At(asked - 1).buttons;
      const int pressed = plain.known.count(asked) != 0 ? plain.At(asked).buttons & ~before : 0;
      ASSERT_EQ(track.PressedAt(asked), pressed) << asked;
    }
  }
}

}  // namespace activities_test
}  // namespace seam
