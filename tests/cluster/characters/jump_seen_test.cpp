/// A character's jump is visible on another player's screen, and in time.

#include <gtest/gtest.h>

#include <optional>

#include "tests/lab/titles/screen.h"
#include "tests/support/soak.h"
#include "tests/support/two_sides.h"

namespace seam {
namespace jump_seen_test {

const char* const kJumper = R"(
[solver]
substeps = 4
[[part]]
name = "ground"
chain = [[-50, 0], [50, 0]]
friction = 0.8
[[character]]
name = "jumper"
player = "ann"
position = [-4, 0]
)";

/// s; when the torso was first shown 0.2 m above where it stood at 1 s.
std::optional<double> Risen(const Screen& screen) {
  const float standing = screen.At("jumper.torso", 1).position.y();
  for (double t = 1; t <= screen.end_s(); t += 1.0 / 60) {
    const auto torso = screen.Find("jumper.torso", t);
    if (torso && torso->position.y() > standing + 0.2f) return t;
  }
  return std::nullopt;
}

TEST(JumpSeen, AnotherPlayersScreenShowsAJumpWithin300Ms) {
  std::string text = std::string(kTwoSides) + kJumper;
  const std::string ann = "name = \"ann\"\n";
  text.insert(text.find(ann) + ann.size(),
              "script = [[0.0, {}], [1.5, {lift = 1.0}], [1.8, {}]]\n");
  for (const int seed : SoakSeeds(1, 6)) {
    ClusterConfig config;
    config.scene_text = text;
    config.impair = "4g";
    config.seed = seed;
    config.duration_s = 4;
    const Played played(RunCluster(config));
    const std::optional<double> own = Risen(Screen(played, 1)), others = Risen(Screen(played, 2)),
                                server = Risen(Screen(played, 0));
    ASSERT_TRUE(own.has_value()) << "it did not jump, seed " << seed;
    ASSERT_TRUE(others.has_value()) << "seed " << seed;
    ASSERT_TRUE(server.has_value()) << "seed " << seed;
    EXPECT_LE(*others - *own, 0.3) << "seed " << seed;
    EXPECT_LE(*server - *own, 0.3) << "seed " << seed;
  }
}

}  // namespace jump_seen_test
}  // namespace seam
