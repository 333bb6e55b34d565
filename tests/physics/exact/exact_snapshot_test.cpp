/// Exact joints in worlds that go back: a snapshot holds all state between two steps.

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/physics/exact/exact_scenes.h"

namespace seam {
namespace exact_snapshot_test {

constexpr int kEvery = 3, kBack = 10;

/// Steps with a barrier every kEvery ticks; `begin` prepares the world. From each `stride`th
/// barrier does the following kBack ticks again. The number of ticks that had another hash then.
template <class Begin>
int DifferentTicks(const Scene& scene, int ticks, std::size_t stride, const Begin& begin) {
  World world(scene);
  begin(&world);
  std::vector<std::uint64_t> hashes = {world.Hash()};
  std::vector<WorldSnapshot> barriers;
  for (int t = 1; t <= ticks; ++t) {
    world.Step();
    if (t % kEvery == 0) barriers.push_back(world.Barrier());
    hashes.push_back(world.Hash());
  }
  int different = 0;
  for (std::size_t b = 0; b < barriers.size(); b += stride) {
    EXPECT_TRUE(world.Restore(barriers[b]).ok());
    for (int i = 1; i <= kBack && world.tick() < ticks; ++i) {
      world.Step();
      if (world.tick() % kEvery == 0) world.Barrier();
      if (world.Hash() != hashes[static_cast<std::size_t>(world.tick())]) ++different;
    }
  }
  return different;
}

const std::pair<const char*, int> kScenes[] = {
    {"bridge", 240},      {"chain-heavy-end", 240}, {"scissor-lift", 240}, {"crane-grip", 240},
    {"car-terrain", 240}, {"rod-box", 240},         {"ragdoll-pile", 120}};

void ExpectEqualReplay(JointSolving joints) {
  for (const auto& [name, ticks] : kScenes) {
    Scene scene = LoadScene(std::string("scenes/hard/") + name + ".toml");
    scene.solver.joints = joints;
    const std::size_t stride = ticks < 200 ? 9 : 3;
    EXPECT_EQ(DifferentTicks(scene, ticks, stride, [](World*) {}), 0) << name;
  }
}

TEST(ExactSnapshot, ReplayIsBitExactWithExactJoints) { ExpectEqualReplay(JointSolving::kExact); }

TEST(ExactSnapshot, ReplayIsBitExactIfCostChoosesTheSolver) {
  ExpectEqualReplay(JointSolving::kAuto);
}

TEST(ExactSnapshot, ReplayIsBitExactWithPrescribedAndKinematicBodies) {
  for (const Activity activity : {Activity::kPrescribed, Activity::kKinematic}) {
    for (const char* name : {"bridge", "crane-grip", "car-terrain"}) {
      Scene scene = LoadScene(std::string("scenes/hard/") + name + ".toml");
      scene.solver.joints = JointSolving::kExact;
      const auto lead = [activity](World* world) {
        const int body = world->body_count() / 2;
        world->SetActivity(body, activity);
        BodyState state = world->Read(body);
        state.velocity = {0.25f, 0.125f};
        world->Write(body, state);
      };
      EXPECT_EQ(DifferentTicks(scene, 180, 4, lead), 0)
          << name << (activity == Activity::kPrescribed ? ", led" : ", kinematic");
    }
  }
}

TEST(ExactSnapshot, ABarrierChangesNoState) {
  Scene scene = LoadScene("scenes/hard/bridge.toml");
  scene.solver.joints = JointSolving::kExact;
  World world(scene);
  Steps(&world, 60);
  const std::uint64_t before = world.Hash();
  world.Barrier();
  EXPECT_EQ(world.Hash(), before);
}

/// A mechanism far from a pile of boxes that falls and comes to rest.
std::string MechanismAndPile(const char* joints) {
  return std::string("[solver]\njoints = \"") + joints + "\"\n" + kGround + PostText(-30, 6) +
         ChainText(5, -30, 6) + HingeText("top", "post", "link.0", -30, 6) +
         PartText("box",
                  "box = [0.8, 0.5]\nposition = [20, 1]\nangle = 0.2\nrestitution = 0.3\n"
                  "repeat = {count = [4, 5], step = [0.7, 0.9]}") +
         PartText("ball", "circle = 0.3\nposition = [20.4, 7]\nvelocity = [1, -9]");
}

TEST(ExactSnapshot, FreeBodiesHaveTheSameBitsBesideAnExactMechanism) {
  World exact(ParseScene(MechanismAndPile("exact"), "s.toml"));
  World stock(ParseScene(MechanismAndPile("iterative"), "s.toml"));
  bool other_chain = false;
  for (int t = 0; t < 400; ++t) {
    exact.Step();
    stock.Step();
    for (int body = 0; body < exact.body_count(); ++body) {
      const BodyState a = exact.Read(body), b = stock.Read(body);
      const bool same = a.position == b.position && a.angle == b.angle &&
                        a.velocity == b.velocity && a.spin == b.spin &&
                        exact.awake(body) == stock.awake(body);
      if (a.position.x() > 0) {
        ASSERT_TRUE(same) << "body " << body << " at tick " << t;
      } else {
        other_chain = other_chain || !same;
      }
    }
  }
  EXPECT_TRUE(other_chain) << "the chain was to be solved in another way";
}

}  // namespace exact_snapshot_test
}  // namespace seam
