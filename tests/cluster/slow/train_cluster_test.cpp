/// scenes/train.toml over a network: the train changes hands as a whole at each seam, and by the
/// methods named below its nose is never shown inside a crate that another player holds.

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <set>

#include "tests/lab/session.h"

namespace seam {
namespace train_cluster_test {

/// A body's x in a view; nullopt where it is not in it.
std::optional<float> Shown(const View& view, PartId body) {
  const auto found = std::lower_bound(view.id.begin(), view.id.end(), body);
  if (found == view.id.end() || *found != body) return std::nullopt;
  return view.x[static_cast<std::size_t>(found - view.id.begin())];
}

/// Largest displayed depth of the locomotive's nose inside a crate, by any peer at any tick, along
/// x, as all stay on the ground, m. Below 0: never inside.
float DeepestNose(const Recording& recording) {
  const Scene scene = ParseScene(recording.room.scene_text, "train.toml");
  PartId loco = -1;
  std::vector<PartId> crates;
  for (const Part& part : scene.parts) {
    if (part.name == "loco") loco = part.id;
    if (part.name.rfind("crate.", 0) == 0) crates.push_back(part.id);
  }
  float deepest = -1;
  for (const auto& [peer, views] : recording.views) {
    for (const auto& [tick, view] : views) {
      for (const PartId crate : crates) {
        const auto nose = Shown(view, loco), box = Shown(view, crate);
        if (nose && box) deepest = std::max(deepest, *nose + 2.3f - (*box - 0.5f));
      }
    }
  }
  return deepest;
}

Recording RunTrain(const std::string& mode, const std::string& reconcile,
                   const std::string& impair) {
  SessionSettings settings;
  settings.scene = "scenes/train.toml";
  settings.mode = mode;
  settings.reconcile = reconcile;
  settings.impair = impair;
  return RunCluster(Configure(settings));
}

/// "central" or "buffer/fade".
class NeverThrough : public ::testing::TestWithParam<const char*> {};

TEST_P(NeverThrough, TheNosePushesTheCratesInEveryView) {
  const std::string method = GetParam();
  const std::size_t slash = std::min(method.find('/'), method.size());
  const std::string rule = slash < method.size() ? method.substr(slash + 1) : "";
  for (const char* impair : {"demo", "delay=200ms"}) {
    EXPECT_LT(DeepestNose(RunTrain(method.substr(0, slash), rule, impair)), 0.1f) << impair;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, NeverThrough, ::testing::Values("oracle", "central", "buffer"),
                         [](const auto& method) {
                           std::string name = method.param;
                           std::replace(name.begin(), name.end(), '/', '_');
                           return name;
                         });

TEST(TrainCluster, TheNoseIsShownInsideACrateWithoutMutualCollision) {
  const float deepest = DeepestNose(RunTrain("strict", "", "delay=200ms"));
  EXPECT_GT(deepest, 1) << "the measure sees nothing";
}

TEST(TrainCluster, EachOfTheFourPlayersHasTheWholeTrainInTurn) {
  const Recording recording = RunTrain("buffer", "", "demo");
  std::vector<int> holders;
  const Scene scene = ParseScene(recording.room.scene_text, "train.toml");
  for (const auto& [tick, view] : recording.views.at(0)) {
    std::set<int> authorities;
    for (std::size_t i = 0; i < view.id.size(); ++i) {
      const std::string& name = scene.parts[static_cast<std::size_t>(view.id[i])].name;
      if (name.rfind("crate.", 0) != 0) authorities.insert(view.authority[i]);
    }
    ASSERT_EQ(authorities.size(), 1u) << "tick " << tick;
    const int holder = *authorities.begin();
    if (holder > 0 && (holders.empty() || holders.back() != holder)) holders.push_back(holder);
  }
  EXPECT_EQ(holders, (std::vector<int>{1, 2, 3, 4}));
}

}  // namespace train_cluster_test
}  // namespace seam
