/// The room orders the edits that physics finds as the oracle finds them: the same, in the same
/// order, at the same ticks.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "client/embed/cluster.h"
#include "common/measure/measure.h"
#include "common/scene/scene.h"
#include "common/sync/edits/edit_order.h"
#include "tests/cluster/anchored_scenes.h"
#include "tests/support/soak.h"

namespace seam {
namespace edit_order_scenes_test {

/// Each scene is played for so long, s; by `make soak` to its end.
constexpr double kSampleS = 10;
/// Scenes of more parts are played by a few, and not to their end.
constexpr std::size_t kLargeParts = 500;

struct Found {
  EditKey key;
  std::int64_t tick = 0;
  bool operator==(const Found& o) const { return key == o.key && tick == o.tick; }
};

std::ostream& operator<<(std::ostream& out, const Found& found) {
  return out << "{" << found.key[0] << " " << found.key[1] << " " << found.key[2] << " "
             << found.key[3] << " @" << found.tick << "}";
}

std::vector<Found> Ordered(const Recording& recording) {
  std::vector<Found> all;
  for (const auto& [number, order] : recording.edits) {
    const Edit edit = ToEdit(order);
    if (edit.cause == EditCause::kPhysics) all.push_back({KeyOf(edit), order.tick});
  }
  return all;
}

std::vector<Found> Ordered(const Oracle& oracle) {
  std::vector<Found> all;
  for (std::size_t n = 0; n < oracle.edits.size(); ++n) {
    const Edit& edit = oracle.edits[n];
    if (edit.cause == EditCause::kPhysics) all.push_back({KeyOf(edit), oracle.edit_ticks[n]});
  }
  return all;
}

/// Edits found later than this before the end, s, may still wait for inputs when the session ends
/// (Replica::ProposeFound).
constexpr double kMayWait = 0.5;

std::vector<Found> Before(std::int64_t tick, std::vector<Found> all) {
  const auto late = [tick](const Found& found) { return found.tick >= tick; };
  all.erase(std::remove_if(all.begin(), all.end(), late), all.end());
  return all;
}

/// Returns the number of edits that physics found.
std::size_t Compare(const ClusterConfig& config, const std::string& name) {
  const Recording recording = RunCluster(config);
  const Oracle oracle = ComputeOracle(recording, WithBarriers(recording.room));
  const std::int64_t end =
      recording.last_tick - static_cast<std::int64_t>(kMayWait * recording.room.tick_hz);
  const std::vector<Found> here = Before(end, Ordered(recording));
  const std::vector<Found> there = Before(end, Ordered(oracle));
  EXPECT_EQ(here, there) << name;
  return there.size();
}

TEST(EditOrder, IsTheOraclesInEveryShippedScene) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator("scenes")) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  int with_edits = 0;
  for (const std::string& name : names) {
    ClusterConfig config;
    config.scene = name;
    config.impair = "perfect";
    const Scene scene = LoadScene("scenes/" + name + ".toml");
    if (Soak(1) == 1) config.duration_s = std::min(kSampleS, scene.duration_s);
    if (scene.parts.size() > kLargeParts) {
      config.players = 4;
      config.duration_s = 4;
    }
    if (Compare(config, name) > 0) ++with_edits;
  }
  EXPECT_GE(with_edits, 4) << "else it compares nothing";
}

TEST(EditOrder, IsTheOraclesWhereGlueHoldsToAnchoredParts) {
  int with_edits = 0;
  for (int seed = 0; seed < 24; ++seed) {
    ClusterConfig config;
    config.scene = "anchored";
    config.scene_text = AnchoredScene(seed);
    config.impair = "perfect";
    if (Compare(config, "anchored scene " + std::to_string(seed)) > 0) ++with_edits;
  }
  EXPECT_GE(with_edits, 12) << "else most of them break nothing";
}

}  // namespace edit_order_scenes_test
}  // namespace seam
