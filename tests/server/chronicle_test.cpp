/// The events of a room, and the sum of its session.

#include "server/chronicle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "client/embed/cluster.h"
#include "common/record/events/event_text.h"
#include "common/record/events/summary_text.h"

namespace seam {
namespace chronicle_test {

/// A car that rolls through a gate, an arm that is too heavy for its glue, and a script.
constexpr const char* kFair = R"(title = "A fair"
[[player]]
name = "ann"
vehicle = "car"
[[player]]
name = "bob"
vehicle = "cart"
[[part]]
name = "ground"
chain = [[-300, 0], [300, 0]]
[[part]]
name = "car"
box = [3, 0.6]
position = [-12, 0.4]
velocity = [8, 0]
friction = 0
owner = "ann"
[[part]]
name = "cart"
box = [2, 0.6]
position = [40, 0.4]
owner = "bob"
[[part]]
name = "post"
box = [0.4, 4]
position = [60, 2]
anchored = true
[[part]]
name = "arm"
box = [4, 0.4]
position = [62.2, 3.8]
density = 100
[[joint]]
name = "hold"
kind = "glue"
a = "post"
b = "arm"
strength = 300
[[trigger]]
name = "gate"
kind = "area"
position = [-6, 1]
box = [1, 3]
score = 7
once = true
[[script]]
name = "voice"
code = '''
function on_tick(t)
  if t > 3 and t < 4 then
    for i = 1, 8 do world.say("line " .. i) end
  end
end
'''
)";

std::map<std::string, std::vector<Event>> ByKind(const Recording& recording) {
  std::map<std::string, std::vector<Event>> kinds;
  for (const Event& event : recording.events) kinds[EventKindName(event.kind)].push_back(event);
  return kinds;
}

class ChronicleOfAFair : public ::testing::Test {
 protected:
  ChronicleOfAFair() : cluster_(Config()) {}
  static ClusterConfig Config() {
    ClusterConfig config;
    config.scene_text = kFair;
    config.impair = "delay=30ms";
    config.drive = Drive::kNone;
    return config;
  }
  Cluster cluster_;
};

TEST_F(ChronicleOfAFair, EachEventSaysWhatItIsAboutInFields) {
  cluster_.RunToTick(120);
  cluster_.Leave(1);
  cluster_.RunToTick(150);
  cluster_.Revive(1);
  cluster_.RunToTick(300);
  cluster_.server().Shutdown(cluster_.now_us(), "the test is over");
  auto kinds = ByKind(cluster_.recording());
  ASSERT_EQ(kinds["started"].size(), 1u);
  EXPECT_EQ(kinds["started"][0].value_milli, 2000) << "players";
  ASSERT_EQ(kinds["joined"].size(), 2u);
  EXPECT_EQ(kinds["joined"][0].client, 1);
  EXPECT_EQ(kinds["joined"][1].player, 1);
  ASSERT_EQ(kinds["left"].size(), 1u);
  EXPECT_EQ(kinds["left"][0].client, 2);
  EXPECT_NE(kinds["left"][0].text.find("gone: left"), std::string::npos) << kinds["left"][0].text;
  ASSERT_EQ(kinds["rejoined"].size(), 1u);
  EXPECT_EQ(kinds["rejoined"][0].player, 1);
  ASSERT_EQ(kinds["scored"].size(), 1u);
  EXPECT_EQ(kinds["scored"][0].player, 0);
  EXPECT_EQ(kinds["scored"][0].value_milli, 7000);
  const Scene& scene = cluster_.scene();
  ASSERT_EQ(kinds["broke"].size(), 1u);
  EXPECT_EQ(scene.parts[static_cast<std::size_t>(kinds["broke"][0].body)].name, "post");
  EXPECT_EQ(scene.parts[static_cast<std::size_t>(kinds["broke"][0].other)].name, "arm");
  EXPECT_EQ(kinds["broke"][0].index, 0);
  EXPECT_EQ(kinds["ended"].size(), 1u);
}

TEST_F(ChronicleOfAFair, AFloodOfOneKindIsBoundedAndCounted) {
  cluster_.RunToTick(300);  // the script says 8 lines in each of 59 ticks
  auto kinds = ByKind(cluster_.recording());
  EXPECT_GE(kinds["script"].size(), static_cast<std::size_t>(Chronicle::kEventBurst));
  EXPECT_LE(kinds["script"].size(),
            static_cast<std::size_t>(Chronicle::kEventBurst + Chronicle::kPerS));
  const Summary sum = cluster_.server().Sum(cluster_.now_us());
  EXPECT_EQ(static_cast<std::size_t>(sum.events), cluster_.recording().events.size());
  EXPECT_EQ(sum.events_dropped + static_cast<std::int64_t>(kinds["script"].size()), 472);
  EXPECT_EQ(kinds["joined"].size(), 2u) << "other kinds lose nothing";
}

TEST_F(ChronicleOfAFair, TheSumHasTimesScoresAndRejoins) {
  cluster_.RunToTick(120);
  cluster_.Leave(1);
  cluster_.RunToTick(180);
  cluster_.Revive(1);
  cluster_.RunToTick(300);
  cluster_.server().Shutdown(cluster_.now_us(), "the test is over");
  ASSERT_FALSE(cluster_.recording().summaries.empty());
  const Summary sum = cluster_.recording().summaries.back();
  EXPECT_EQ(sum.of, cluster_.server().room().session);
  EXPECT_EQ(sum.ended, static_cast<std::int8_t>(Ended::kEnded));
  EXPECT_EQ(sum.ticks, 300);
  EXPECT_EQ(NamesOf(sum), (std::vector<std::string>{"ann", "bob"}));
  EXPECT_EQ(sum.joins, (std::vector<std::int32_t>{1, 2}));
  EXPECT_EQ(sum.rejoins, (std::vector<std::int32_t>{0, 1}));
  EXPECT_EQ(sum.score, (std::vector<float>{7, 0}));
  EXPECT_EQ(sum.present_ticks[0], 300);
  EXPECT_GT(sum.present_ticks[1], 200) << "120, and 120 less the time to join";
  EXPECT_LT(sum.present_ticks[1], 240);
  EXPECT_EQ(sum.edits, cluster_.server().replica().revision());
  std::int64_t given = 0;
  for (const std::int64_t n : sum.hand_overs_to) given += n;
  EXPECT_GT(given, 0) << "bob gets his cart again";
  EXPECT_LE(given, sum.hand_overs);
  const std::string table = SummaryTable(sum, 60);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 4) << table;
  const std::string json = SummaryJson(sum, "main", "fair", 60);
  EXPECT_NE(json.find(R"("name":"bob")"), std::string::npos) << json;
  EXPECT_NE(json.find(R"("ended":"ended")"), std::string::npos) << json;
}

TEST(ChronicleOfOneRun, TheEventsAreTheSameInASecondRun) {
  const auto run = [] {
    ClusterConfig config;
    config.scene = "rally";
    config.impair = "demo";
    config.duration_s = 6;
    std::string text;
    const Recording recording = RunCluster(config);
    for (const Event& event : recording.events) text += EventJson(event, 0) + "\n";
    return text;
  };
  const std::string first = run();
  EXPECT_FALSE(first.empty());
  EXPECT_EQ(run(), first);
}

}  // namespace chronicle_test
}  // namespace seam
