/// seam-lab first-divergence: finds a planted difference, and none between equal logs.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "common/base/check.h"
#include "common/codec/codec.h"
#include "common/record/log_file.h"
#include "tests/lab/commands.h"
#include "tests/lab/divergence.h"
#include "tests/support/child_process.h"
#include "tests/support/lab_workspace.h"

namespace seam {
namespace lab_divergence_test {

/// A short session in memory.
Recording Session() {
  SessionSettings settings;
  settings.scene = "scenes/crossing.toml";
  settings.duration_s = 1;
  Cluster cluster(Configure(settings));
  cluster.Run();
  return cluster.recording();
}

TEST(FirstDivergence, ARecordingDoesNotDivergeFromItself) {
  const Recording a = Session();
  const Comparison all = CompareViews(a, a, -1, false);
  EXPECT_FALSE(all.first.has_value());
  EXPECT_GT(all.equal_views, 150);
  const Comparison one = CompareViews(a, a, 1, false);
  EXPECT_FALSE(one.first.has_value());
  EXPECT_EQ(one.equal_views, static_cast<std::int64_t>(a.views.at(1).size()));
}

TEST(FirstDivergence, FindsEachFieldByOneBit) {
  const Recording a = Session();
  const std::pair<const char*, std::vector<float> View::*> fields[] = {
      {"x", &View::x},   {"y", &View::y},   {"angle", &View::angle},
      {"vx", &View::vx}, {"vy", &View::vy}, {"spin", &View::spin}};
  for (const auto& [name, field] : fields) {
    Recording b = a;
    View& view = b.views[2][40];
    ASSERT_GT(view.id.size(), 1u);
    const float before = (view.*field)[1];
    (view.*field)[1] = std::nextafter(before, 1e9f);
    const Comparison result = CompareViews(a, b, -1, false);
    ASSERT_TRUE(result.first.has_value()) << name;
    EXPECT_EQ(result.first->tick, 40);
    EXPECT_EQ(result.first->peer, 2);
    EXPECT_EQ(result.first->body, view.id[1]);
    EXPECT_EQ(result.first->field, name);
    EXPECT_EQ(static_cast<float>(result.first->a), before);
    EXPECT_GT(result.first->b, result.first->a);
    EXPECT_FALSE(CompareViews(a, b, 1, false).first.has_value()) << "only peer 2 differs";
  }
}

TEST(FirstDivergence, FindsRoleAndAuthority) {
  const Recording a = Session();
  Recording b = a;
  b.views[0][30].authority[0] ^= 1;
  b.views[0][31].role[0] ^= 1;
  EXPECT_EQ(CompareViews(a, b, -1, false).first->field, "authority");
  b.views[0][30] = a.views.at(0).at(30);
  EXPECT_EQ(CompareViews(a, b, -1, false).first->field, "role");
  EXPECT_EQ(CompareViews(a, b, -1, false).first->tick, 31);
}

TEST(FirstDivergence, TheEarliestTickCountsThenTheLowestPeer) {
  const Recording a = Session();
  Recording b = a;
  b.views[0][50].x[0] += 1;
  b.views[2][45].x[0] += 1;
  b.views[1][45].x[0] += 1;
  const Comparison result = CompareViews(a, b, -1, false);
  EXPECT_EQ(result.first->tick, 45);
  EXPECT_EQ(result.first->peer, 1);
  std::int64_t earlier = 0;
  for (const auto& [peer, views] : a.views) {
    for (const auto& [tick, view] : views) earlier += tick < 45 || (tick == 45 && peer < 1);
  }
  EXPECT_EQ(result.equal_views, earlier);
}

TEST(FirstDivergence, AMissingViewOrBodyIsADifferenceUnlessOnlyCommonOnesAreCompared) {
  const Recording a = Session();
  Recording b = a;
  b.views[1].erase(20);
  const Comparison missing = CompareViews(a, b, -1, false);
  ASSERT_TRUE(missing.first.has_value());
  EXPECT_EQ(missing.first->tick, 20);
  EXPECT_EQ(missing.first->body, -1);
  EXPECT_TRUE(missing.first->only_in_a);
  EXPECT_FALSE(CompareViews(b, a, -1, false).first->only_in_a);
  EXPECT_FALSE(CompareViews(a, b, -1, true).first.has_value());
  View& view = b.views[2][25];
  const int body = view.id.back();
  view.id.pop_back();
  const Comparison fewer = CompareViews(a, b, -1, true);
  ASSERT_TRUE(fewer.first.has_value());
  EXPECT_EQ(fewer.first->tick, 25);
  EXPECT_EQ(fewer.first->body, body);
  EXPECT_TRUE(fewer.first->only_in_a);
  EXPECT_TRUE(fewer.first->field.empty());
}

/// Copies a log; `change` may alter each view.
void CopyLog(const std::string& from, const std::string& to,
             const std::function<void(View*)>& change) {
  LogReader reader(from);
  LogWriter writer(to);
  LogEvent event;
  while (reader.Next(&event)) {
    AnyMessage any = Decode(event.data);
    if (View* view = std::get_if<View>(&any)) {
      change(view);
      event.data = Encode(*view);
    }
    writer.Publish(event.channel, event.timestamp_us, event.data);
  }
  ASSERT_EQ(writer.failures(), 0);
}

TEST(FirstDivergence, TheProgramPrintsThePlaceAndTheAmount) {
  const LabWorkspace files;
  RunCommand command;
  command.settings.scene = "scenes/crossing.toml";
  command.settings.duration_s = 1;
  command.log = files / "a.lcm";
  ASSERT_EQ(RunLog(command), 0);
  CopyLog(files / "a.lcm", files / "same.lcm", [](View*) {});
  CopyLog(files / "a.lcm", files / "b.lcm", [](View* view) {
    if (view->peer == 1 && view->tick == 33) view->y[0] = 0.5f;
  });
  const auto run = [&](const std::vector<std::string>& more, int status) {
    std::vector<std::string> words = {LabProgram(), "first-divergence", files / "a.lcm"};
    words.insert(words.end(), more.begin(), more.end());
    ChildProcess lab(words);
    EXPECT_TRUE(lab.Wait(60));
    EXPECT_EQ(lab.exit_status(), status) << lab.output();
    return lab.output();
  };
  EXPECT_EQ(run({files / "same.lcm"}, 0).rfind("equal: ", 0), 0u);
  const std::string said = run({files / "b.lcm"}, 1);
  EXPECT_NE(said.find(" damaged"), std::string::npos) << "its checksum: " << said;
  EXPECT_NE(said.find("\ntick 33, peer 1, body "), std::string::npos) << said;
  EXPECT_NE(said.find(", y: "), std::string::npos) << said;
  EXPECT_NE(said.find(" and 0.5 m, which differ by "), std::string::npos) << said;
  EXPECT_NE(run({files / "b.lcm", "--peer", "2"}, 1).find("\nequal: "), std::string::npos);
  for (const std::string peer : {"9", "40"}) {
    EXPECT_EQ(run({files / "same.lcm", "--peer", peer}, 2),
              "seam-lab: no views to compare of peer " + peer + "\n");
  }
  run({files / "none.lcm"}, 2);
  run({}, 2);
  command.settings.scene = "scenes/cradle.toml";
  command.log = files / "cradle.lcm";
  ASSERT_EQ(RunLog(command), 0);
  EXPECT_NE(run({files / "cradle.lcm"}, 2).find("another scene"), std::string::npos);
}

}  // namespace lab_divergence_test
}  // namespace seam
