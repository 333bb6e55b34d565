/// seam-lab check: each mistake is found at its place, and a correct scene has no findings.

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/lab/check/scene_check.h"
#include "tests/support/program.h"
#include "tests/support/source_tree.h"

namespace seam {
namespace lab_check_test {

namespace fs = std::filesystem;

constexpr const char* kGround = R"([[part]]
name = "ground"
chain = [[-50, 0], [50, 0]]
)";
constexpr const char* kBox = R"([[part]]
name = "box"
box = [1, 1]
position = [0, 0.5]
)";

/// "LINE: text" of each finding.
std::vector<std::string> Found(const std::string& text) {
  std::vector<std::string> lines;
  for (const Finding& finding : CheckMeaning(ParseScene(text, "test.toml"))) {
    lines.push_back(std::to_string(finding.line) + ": " + finding.text);
  }
  return lines;
}

/// Expects one finding, which begins with "LINE: " and contains `what`.
void ExpectOne(const std::string& text, int line, const std::string& what) {
  const std::vector<std::string> found = Found(text);
  ASSERT_EQ(found.size(), 1u) << ::testing::PrintToString(found) << "\nin\n" << text;
  EXPECT_EQ(found[0].rfind(std::to_string(line) + ": ", 0), 0u) << found[0];
  EXPECT_NE(found[0].find(what), std::string::npos) << found[0];
}

std::string Player(const std::string& name, const std::string& more) {
  return "[[player]]\nname = \"" + name + "\"\n" + more + "\n";
}

TEST(LabCheck, FindsNothingInACorrectScene) {
  EXPECT_EQ(Found(std::string(kGround) + kBox), std::vector<std::string>{});
  // Touching, or as far in as two decimals round it.
  EXPECT_EQ(Found(std::string(kGround) + kBox +
                  "[[part]]\nname = \"top\"\nbox = [1, 1]\nposition = [0.3, 1.49]\n"),
            std::vector<std::string>{});
}

TEST(LabCheck, FindsABodyInTerrain) {
  ExpectOne(std::string(kGround) + "[[part]]\nname = \"box\"\nbox = [1, 1]\nposition = [0, 0.3]\n",
            4, "part 'box' begins 0.20 m inside the anchored part 'ground'");
  ExpectOne(
      "[[part]]\nname = \"wall\"\nbox = [1, 10]\nanchored = true\n[[part]]\nname = \"ball\"\n"
      "circle = 0.5\nposition = [0.8, 0]\n",
      5, "part 'ball' begins 0.20 m inside the anchored part 'wall'");
}

TEST(LabCheck, FindsBodiesThatBeginInOneAnother) {
  const std::string second = "[[part]]\nname = \"other\"\nbox = [1, 1]\nposition = [0.6, 0.5]\n";
  ExpectOne(std::string(kGround) + kBox + second, 8,
            "part 'other' begins 0.40 m inside part 'box'");
  // Parts that never collide may overlap.
  EXPECT_EQ(Found(std::string(kGround) + kBox + "group = -1\n" + second + "group = -1\n"),
            std::vector<std::string>{});
}

TEST(LabCheck, FindsABodyInABrick) {
  const std::string bricks =
      "[[bricks]]\nname = \"house\"\nbrick = [1, 0.5]\n"
      "position = [4, 0]\ncount = [3, 4]\n";
  const std::string ball = "[[part]]\nname = \"ball\"\ncircle = 0.2\nposition = ";
  ExpectOne(kGround + bricks + ball + "[5.5, 1.2]\n", 9,
            "part 'ball' begins with its middle in a brick of 'house'");
  EXPECT_EQ(Found(kGround + bricks + ball + "[7.3, 1.2]\n"), std::vector<std::string>{});
}

TEST(LabCheck, FindsAnglesThatMayBeDegrees) {
  const std::string arm = "[[part]]\nname = \"arm\"\nbox = [1, 0.2]\nposition = [0.5, 5]\n";
  ExpectOne(std::string(kGround) + arm + "angle = 90\n", 8,
            "angle = 90 is more than a turn: angles are in radians, 90 degrees are 1.571");
  const std::string hinge =
      "[[joint]]\nname = \"pivot\"\nkind = \"hinge\"\na = \"arm\"\nb = \"box\"\nanchor = [0, 5]\n";
  ExpectOne(std::string(kGround) + kBox + arm + hinge + "limits = [-45, 45]\n", 18,
            "limits = -45 is more than a turn");
  EXPECT_EQ(Found(std::string(kGround) + kBox + arm + hinge + "limits = [-6.28, 3]\n"),
            std::vector<std::string>{});
  EXPECT_EQ(Found(std::string(kGround) + arm + "# check: meant, twice round\nangle = 14\n"),
            std::vector<std::string>{});
}

TEST(LabCheck, AReversedChainIsOneFinding) {
  ExpectOne("[[part]]\nname = \"ground\"\nchain = [[50, 0], [-50, 0]]\n" + std::string(kBox) +
                "[[part]]\nname = \"ball\"\ncircle = 0.5\nposition = [4, 0.3]\n",
            1, "chain 'ground' faces the wrong way: 'box' and 1 more are on its solid side");
}

TEST(LabCheck, FindsAChainThatFacesTheWrongWay) {
  ExpectOne(std::string("[[part]]\nname = \"ground\"\nchain = [[50, 0], [-50, 0]]\n") + kBox, 1,
            "chain 'ground' faces the wrong way: 'box' is on its solid side");
}

TEST(LabCheck, FindsABodyBelowTheGround) {
  ExpectOne(
      std::string(kGround) + kBox + "[[part]]\nname = \"lost\"\ncircle = 0.5\nposition = [5, -8]\n",
      8, "part 'lost' begins on the solid side of 'ground' with nothing below it");
  // In a cave it is where it should be.
  EXPECT_EQ(Found(std::string(kGround) + kBox +
                  "[[part]]\nname = \"miner\"\ncircle = 0.5\nposition = [5, -8]\n"
                  "[[part]]\nname = \"cave\"\nchain = [[0, -20], [50, -20]]\n"),
            std::vector<std::string>{});
}

TEST(LabCheck, FindsRegionsThatOverlapOrLeaveANarrowGap) {
  const std::string ann = Player("ann", "region = [[-50, -50], [0, 50]]");
  ExpectOne(ann + Player("bob", "region = [[-3, -50], [50, 50]]") + kGround + kBox, 4,
            "the regions of 'ann' and 'bob' overlap by 3 m x 100 m");
  ExpectOne(ann + Player("bob", "region = [[0.5, -50], [50, 50]]") + kGround + kBox, 4,
            "have a gap of 0.5 m between them");
  for (const char* good : {"[[0.001, -50], [50, 50]]", "[[5, -50], [50, 50]]"}) {
    EXPECT_EQ(Found(ann + Player("bob", std::string("region = ") + good) + kGround + kBox),
              std::vector<std::string>{})
        << good;
  }
}

TEST(LabCheck, FindsAPlayerWithoutAVehicle) {
  ExpectOne(Player("ann", "") + kGround + kBox, 1,
            "player 'ann' has no vehicle, owns nothing and drives nothing");
  EXPECT_EQ(Found(Player("ann", "vehicle = \"box\"") + kGround + kBox), std::vector<std::string>{});
  EXPECT_EQ(Found(Player("ann", "") + kGround + kBox + "owner = \"ann\"\n"),
            std::vector<std::string>{});
}

TEST(LabCheck, FindsTriggersThatNothingCanEnterOrThatDoNothing) {
  const std::string scene = std::string("bounds = [[-100, -100], [100, 100]]\n") + kGround + kBox;
  const std::string trigger = "[[trigger]]\nname = \"goal\"\nbox = [2, 2]\nfor = \"box\"\n";
  ExpectOne(scene + trigger + "score = 1\nposition = [200, 0]\n", 9,
            "trigger 'goal' lies out of the scene's bounds");
  ExpectOne(scene + trigger + "position = [20, 0]\n", 9, "trigger 'goal' is never used");
  ExpectOne(scene +
                "[[part]]\nname = \"rock\"\nbox = [1, 1]\nposition = [30, 5]\nanchored = true\n"
                "[[trigger]]\nname = \"goal\"\nbox = [2, 2]\nfor = \"rock\"\nscore = 1\nposition = "
                "[0, 9]\n",
            14, "trigger 'goal' looks for what never moves");
  EXPECT_EQ(Found(scene + trigger + "score = 1\nposition = [20, 0]\n"), std::vector<std::string>{});
}

TEST(LabCheck, FindsJointLimitsThatTheJointBeginsOutsideOf) {
  const std::string scene = std::string(kGround) + kBox +
                            "[[part]]\nname = \"arm\"\nbox = [2, 0.2]\nposition = [1, 1.1]\n";
  const std::string hinge =
      "[[joint]]\nname = \"j\"\nkind = \"hinge\"\na = \"box\"\nb = \"arm\"\nanchor = [0, 1.05]\n";
  ExpectOne(scene + hinge + "limits = [0.5, 1]\n", 12,
            "joint 'j': begins at 0, outside its limits 0.5 to 1");
  EXPECT_EQ(Found(scene + hinge + "limits = [-0.5, 1]\n"), std::vector<std::string>{});
  ExpectOne(scene +
                "[[joint]]\nname = \"r\"\nkind = \"rope\"\na = \"box\"\nb = \"arm\"\n"
                "anchor_a = [0, 1]\nanchor_b = [2, 1]\nlength = 1\n",
            12, "joint 'r': its ends begin 2.00 m apart, the rope is 1 m");
  const std::string slide =
      "[[joint]]\nname = \"j\"\nkind = \"prismatic\"\na = \"box\"\nb = "
      "\"arm\"\naxis = [1, 0]\nlocal_a = [0, 0]\nlocal_b = [1, 0]\n";
  EXPECT_EQ(Found(scene + slide + "limits = [1.5, 4]\n"), std::vector<std::string>{})
      << "its ends begin 2 m apart";
  ExpectOne(scene + slide + "limits = [-1, 1]\n", 12,
            "joint 'j': begins at 2, outside its limits -1 to 1");
}

TEST(LabCheck, ACommentSuppressesAFinding) {
  const std::string inside = "name = \"box\"\nbox = [1, 1]\nposition = [0, 0.3]\n";
  EXPECT_EQ(Found(std::string(kGround) + "[[part]]  # check: meant\n" + inside),
            std::vector<std::string>{});
  EXPECT_EQ(
      Found(std::string(kGround) + "# falls out of the ground; check: meant\n[[part]]\n" + inside),
      std::vector<std::string>{});
  EXPECT_EQ(Found(std::string(kGround) + "# check this\n[[part]]\n" + inside).size(), 1u);
}

TEST(LabCheck, FindsNothingInOurOwnScenes) {
  int count = 0;
  for (const char* folder : {"scenes", "scenes/hard", "scenes/exact"}) {
    for (const auto& entry : fs::directory_iterator(Root() / folder)) {
      if (entry.path().extension() != ".toml") continue;
      ++count;
      for (const Finding& finding : CheckMeaning(LoadScene(entry.path().string()))) {
        ADD_FAILURE() << entry.path().string() << ":" << finding.line << ": " << finding.text;
      }
    }
  }
  EXPECT_GT(count, 60);
}

TEST(LabCheckProgram, PrintsThePlaceAndDrawsTheScene) {
  const Workspace folder;
  folder.Write("bad.toml",
               std::string("[[part]]\nname = \"ground\"\nchain = [[50, 0], [-50, 0]]\n") + kBox);
  Program bad({BuiltProgram("seam-lab"), "check", "bad.toml", "-o", "bad.png"}, folder.path());
  ASSERT_TRUE(bad.Wait(60));
  EXPECT_EQ(bad.status(), 1) << bad.Story();
  EXPECT_EQ(bad.output().rfind("bad.toml:1: chain 'ground' faces the wrong way", 0), 0u)
      << bad.Story();
  EXPECT_GT(fs::file_size(folder / "bad.png"), 3000u);
  Program good({BuiltProgram("seam-lab"), "check", "crossing", "wall"}, Root().string());
  ASSERT_TRUE(good.Wait(60));
  EXPECT_EQ(good.status(), 0) << good.Story();
  EXPECT_EQ(good.output(),
            "scenes/crossing.toml: nothing found\nscenes/wall.toml: nothing found\n");
  Program two({BuiltProgram("seam-lab"), "check", "crossing", "wall", "-o", folder / "two.png"},
              Root().string());
  ASSERT_TRUE(two.Wait(60));
  EXPECT_EQ(two.status(), 2);
  EXPECT_EQ(two.errors(), "seam-lab: -o draws one scene, not several\n");
}

}  // namespace lab_check_test
}  // namespace seam
