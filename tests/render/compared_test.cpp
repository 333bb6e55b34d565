/// Runs that are compared: told apart, and of one scene.

#include "render/compared.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "common/base/check.h"
#include "render/scene_recording.h"

namespace seam {
namespace compared_test {

Playback RunOf(const std::string& scene, const std::string& mode, std::int64_t seed,
               const std::string& impair = "4g") {
  Recording recording = RecordingOfScene("scenes/" + scene + ".toml");
  recording.room.mode = mode;
  recording.room.seed = seed;
  recording.room.impair = impair;
  return Playback(std::move(recording), std::nullopt);
}

std::vector<std::string> Apart(const std::vector<std::string>& paths,
                               const std::vector<Playback>& runs) {
  std::vector<const Playback*> all;
  for (const Playback& run : runs) all.push_back(&run);
  return ApartOf(paths, all);
}

TEST(Compared, RunsOfOneMethodAreToldApartByWhatDiffers) {
  using Words = std::vector<std::string>;
  const std::vector<std::string> paths = {"a.lcm", "b.lcm", "c.lcm"};
  const auto run = [](const std::string& mode, std::int64_t seed,
                      const std::string& impair = "4g") {
    return RunOf("crossing", mode, seed, impair);
  };
  EXPECT_EQ(Apart(paths, {run("strict", 1), run("strict", 2), run("central", 1)}),
            (Words{"seed 1", "seed 2", ""}));
  EXPECT_EQ(Apart(paths, {run("strict", 1), run("strict", 1, "3g"), run("strict", 2, "3g")}),
            (Words{"4g, seed 1", "3g, seed 1", "3g, seed 2"}));
  EXPECT_EQ(Apart(paths, {run("strict", 1), run("strict", 1), run("central", 1)}),
            (Words{"a", "b", ""}));
  Playback labelled = run("strict", 1);
  labelled.SetApart("seed 1");
  EXPECT_EQ(labelled.Label(), "strict · seed 1");
}

TEST(Compared, LogsOfTwoScenesAreRefusedInOneLine) {
  const Playback a = RunOf("crossing", "strict", 1), b = RunOf("stack", "strict", 1);
  EXPECT_NO_THROW(RequireOneScene({"a.lcm", "b.lcm"}, {&a, &a}));
  EXPECT_NO_THROW(RequireOneScene({"crossing.toml", "stack.toml"}, {&a, &b}));
  try {
    RequireOneScene({"a.lcm", "b.lcm"}, {&a, &b});
    FAIL();
  } catch (const OperatorError& error) {
    EXPECT_EQ(std::string(error.what()),
              "b.lcm: its scene (stack) has other parts than that of a.lcm (crossing): only runs "
              "of one scene are compared");
  }
}

}  // namespace compared_test
}  // namespace seam
