/// The "falls freely" flag of a holder, and a copy that is only displayed from now on.

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "tests/support/followed_copy.h"
#include "tests/support/water_world.h"

namespace seam {
namespace falls_freely_test {

const char* const kGround = "[[part]]\nname = \"ground\"\nchain = [[-90, 0], [90, 0]]\n";

/// Numbers of a part's states from the 20th tick to the 200th: all, and those flagged as falling.
struct Told {
  int states = 0, falling = 0;
};

/// Counts by the part's index, for a single peer.
std::map<int, Told> ToldOf(const std::string& scene) {
  Replica peer(ParseScene(scene, "s.toml"), MakeSyncConfig("buffer", "retrospect"), 1, -1);
  AuthorityRecord own;
  own.authority = 1;
  for (int m = 0; m < peer.authority().count(); ++m) peer.authority().Set(m, own);
  peer.RolesChanged();
  peer.StartAt(0);
  std::map<int, Told> told;
  while (peer.tick() < 200) {
    peer.Step();
    for (const States& states : peer.TakeStates()) {
      for (std::size_t i = 0; i < states.id.size() && peer.tick() >= 20; ++i) {
        Told& one = told[states.id[i]];
        ++one.states;
        one.falling += (states.flags[i] & kStateFalls) != 0 ? 1 : 0;
      }
    }
  }
  return told;
}

TEST(FallsFreely, AppliesToThrownAndBouncingBodies) {
  std::map<int, Told> told = ToldOf(
      "[[part]]\nname = \"ground\"\nchain = [[-90, 0], [90, 0]]\nfriction = 0.5\n"
      "[[part]]\nname = \"thrown\"\nbox = [1, 0.5]\nposition = [-30, 300]\nvelocity = [4, 9]\n"
      "spin = 3\n"
      "[[part]]\nname = \"ball\"\ncircle = 0.5\nposition = [0, 6]\nvelocity = [3, 0]\n"
      "restitution = 0.9\n");
  ASSERT_GE(told[1].states, 80);
  EXPECT_EQ(told[1].falling, told[1].states);
  // It bounces three times: at each bounce the flag may be missing for one tick.
  ASSERT_GE(told[2].states, 80);
  EXPECT_GE(told[2].falling, told[2].states - 4);
}

TEST(FallsFreely, ExcludesBodiesThatRestSlideRollHangOrSwim) {
  std::map<int, Told> told = ToldOf(
      std::string("[solver]\nsleep = false\n") + kGround +
      "[[part]]\nname = \"lies\"\nbox = [1, 1]\nposition = [0, 0.5]\n"
      "[[part]]\nname = \"slides\"\nbox = [1, 1]\nposition = [4, 0.5]\nvelocity = [14, 0]\n"
      "friction = 0.3\n"
      "[[part]]\nname = \"rolls\"\ncircle = 0.5\nposition = [-20, 0.5]\nvelocity = [-6, 0]\n"
      "[[part]]\nname = \"upper\"\nbox = [0.2, 2]\nposition = [-4, 9]\nangle = 0.8\n"
      "[[part]]\nname = \"lower\"\nbox = [0.2, 2]\nposition = [-4, 7]\n"
      "[[joint]]\nname = \"hook\"\nkind = \"hinge\"\na = \"upper\"\nb = \"lower\"\n"
      "anchor = [-4, 8]\n");
  for (int part = 1; part <= 3; ++part) {
    ASSERT_GE(told[part].states, 80) << part;
    EXPECT_EQ(told[part].falling, 0) << part;
  }
  ASSERT_GE(told[4].states, 80) << "of what has joints it is not said, though both fall";
  EXPECT_EQ(told[4].falling + told[5].falling, 0);

  told = ToldOf("[solver]\nsleep = false\n" + Sea() +
                Floater("swims", "box = [1, 1]\ndensity = 0.5\nposition = [0, -0.3]") +
                Floater("sinks", "box = [1, 1]\ndensity = 4\nposition = [5, -2]"));
  for (int part = 0; part <= 1; ++part) {
    ASSERT_GE(told[part].states, 80) << part;
    EXPECT_EQ(told[part].falling, 0) << part;
  }
}

/// A copy of a flying ball is struck, `silent` ticks after the last state of its holder, by an
/// impact that the holder's lacks, and is no longer followed. Returns the distance of its displayed
/// pose from the holder's half a second later, m.
float ApartAfterABlow(int silent) {
  FollowedCopy pair(
      "[[part]]\nname = \"ball\"\ncircle = 0.5\nposition = [0, 60]\nvelocity = [4, 0]\n",
      "retrospect", 2);
  pair.Steps(20);
  pair.talking = false;
  pair.Steps(silent);
  EXPECT_LT(pair.Apart(0).norm(), 0.01f) << "before";
  BodyState struck = pair.copy_world().Read(0);
  struck.velocity += Vec2(0, -8);
  pair.PutCopy(0, struck);
  AuthorityRecord shown;
  shown.epoch = 1;
  pair.copy.authority().Set(0, shown);
  pair.copy.RolesChanged();
  pair.Steps(30);
  return (pair.Shown(0) - pair.truth.Read(0).position).norm();
}

TEST(FallsFreely, ABodyStruckOnlyHereContinuesFromARecentState) {
  EXPECT_LT(ApartAfterABlow(2), 1);
  EXPECT_GT(ApartAfterABlow(40), 2) << "of what was long ago the copy knows better";
}

}  // namespace falls_freely_test
}  // namespace seam
