/// Each large scene matches its title in every peer's view over the 4g profile; `make soak` plays
/// more seeds.

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/lab/session.h"
#include "tests/lab/titles/titles.h"
#include "tests/support/soak.h"

namespace seam {
namespace lab_titles_test {

class TitleOfScene : public ::testing::TestWithParam<Title> {
 protected:
  static Recording Play(std::int64_t seed, double duration_s) {
    SessionSettings settings;
    settings.scene = std::string("scenes/") + GetParam().scene + ".toml";
    settings.impair = "4g";
    settings.seed = seed;
    settings.duration_s = duration_s > 0 ? duration_s : GetParam().test_s;
    settings.players = GetParam().players;
    Recording recording;
    RunSession(Configure(settings), &recording);
    return recording;
  }
};

TEST_P(TitleOfScene, IsTrueOnEveryScreenUnder4g) {
  for (const int seed : SoakSeeds(1, 2)) {
    EXPECT_EQ(MissedBy(GetParam(), Play(seed, 0)), "") << "seed " << seed;
  }
}

TEST_P(TitleOfScene, IsNotTrueYetAfterASecond) {
  EXPECT_NE(MissedBy(GetParam(), Play(1, 1)), "") << "the test would see nothing";
}

INSTANTIATE_TEST_SUITE_P(Scenes, TitleOfScene, ::testing::ValuesIn(Titles()),
                         [](const auto& title) { return std::string(title.param.scene); });

TEST(Titles, TheDocsHaveEachSentence) {
  std::ifstream page("docs/scenes.md");
  std::stringstream text;
  text << page.rdbuf();
  const std::string docs = text.str();
  for (const Title& title : Titles()) {
    EXPECT_NE(docs.find(title.sentence), std::string::npos) << title.scene;
  }
}

}  // namespace lab_titles_test
}  // namespace seam
