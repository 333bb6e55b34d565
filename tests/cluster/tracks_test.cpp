/// scenes/tracks.toml: tracks pass a step and a slope that stop wheels.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

#include "client/embed/cluster.h"
#include "common/physics/part_places.h"
#include "tests/support/scripted_world.h"

namespace seam {
namespace tracks_test {

Vec2 PlaceOf(const World& world, const std::string& name) {
  for (const Part& part : world.scene().parts) {
    if (part.name == name) return PartPose(world, part.id).position;
  }
  ADD_FAILURE() << "no part " << name;
  return {0, 0};
}

TEST(TracksScene, TracksReachTheTopAndWheelsStayBelowTheStepOverTenSeedsUnder4g) {
  for (std::int64_t seed = 11; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    ClusterConfig config;
    config.scene = "tracks";
    config.impair = "4g";
    config.seed = seed;
    config.keep = false;
    Cluster cluster(config);
    cluster.Run();
    const auto check = [](const World& world) {
      EXPECT_GT(PlaceOf(world, "crawler").x(), 17) << "on the plateau";
      EXPECT_GT(PlaceOf(world, "crawler").y(), 6.2f);
      EXPECT_LT(PlaceOf(world, "buggy").x(), 1) << "before the step";
    };
    check(cluster.server().replica().world());
    for (int i = 0; i < cluster.client_count(); ++i) {
      check(cluster.client(i)->replica()->world());
    }
  }
}

std::string Instead(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

TEST(TracksScene, BothHaveTheSameMassAndWheelsDoNotClimbTheSlopeEither) {
  // Behind the step, the crawler out of the way.
  std::string text = LoadScene("scenes/tracks.toml").text;
  const float shift = 16.5f;
  for (const auto& [from, to] :
       {std::pair("position = [-13, 1.0]", "position = [3.5, 1.7]"),
        std::pair("position = [-14.4, 0.52]", "position = [2.1, 1.22]"),
        std::pair("position = [-6, 0.52]", "position = [-30, 0.52]"),
        std::pair("position = [-6.2, 1.27]", "position = [-30.2, 1.27]")}) {
    text = Instead(text, from, to);
  }
  ScriptedWorld run(ParseScene(text, "tracks.toml"));
  float tracks = 0, wheels = 0;
  for (const Part& part : run.world.scene().parts) {
    if (part.name == "crawler" || part.name == "turret") tracks += PartMass(part);
    if (part.name == "buggy" || part.name.rfind("wheel", 0) == 0) wheels += PartMass(part);
  }
  EXPECT_NEAR(wheels, tracks, 0.02f * tracks);
  EXPECT_EQ(PlaceOf(run.world, "buggy").x(), -13 + shift);
  float farthest = 0;
  while (run.world.tick() < 14 * 60) {
    run.Step();
    farthest = std::max(farthest, PlaceOf(run.world, "buggy").x());
  }
  EXPECT_GT(farthest, 5) << "it does drive";
  EXPECT_LT(farthest, 10) << "and stays at the first beams";
}

}  // namespace tracks_test
}  // namespace seam
