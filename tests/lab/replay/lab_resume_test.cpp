/// A recorded room goes on from a tick, as it was or with an edit.

#include <gtest/gtest.h>

#include <algorithm>

#include "common/record/recording.h"
#include "common/scene/scene.h"
#include "tests/support/lab_workspace.h"
#include "tests/support/program.h"
#include "tests/support/source_tree.h"

namespace seam {
namespace lab_resume_test {

using Words = std::vector<std::string>;

std::string Lab(Words words, int status = 0) {
  words.insert(words.begin(), LabProgram());
  Program lab(words);
  EXPECT_TRUE(lab.Wait(120));
  EXPECT_EQ(lab.status(), status) << lab.Story();
  return status == 2 ? lab.errors() : lab.output();
}

void Record(const LabWorkspace& files, const std::string& scene, const std::string& mode) {
  Lab({"run", (Root() / ("scenes/" + scene + ".toml")).string(), "--mode", mode, "--impair", "demo",
       "--drive", "bot", "--duration", "4", "--no-floor", "--force", "-o", files / "run.lcm"});
}

TEST(LabResume, WithNothingChangedEachTickHasTheRecordedHash) {
  LabWorkspace files;
  for (const auto& [scene, mode] : {std::pair("crossing", "buffer"), std::pair("rally", "central"),
                                    std::pair("gluehouse", "buffer")}) {
    Record(files, scene, mode);
    for (const char* tick : {"1", "100", "239"}) {
      const std::string said =
          Lab({"resume", files / "run.lcm", "--tick", tick, "-o", files / "on.lcm", "--force"});
      EXPECT_NE(said.find("each tick with the recorded hash"), std::string::npos) << said;
    }
    // The log that it wrote is the same room.
    EXPECT_NE(Lab({"replay", files / "on.lcm"}).find("240 ticks done again"), std::string::npos);
    const Recording was = ReadRecording(files / "run.lcm"), is = ReadRecording(files / "on.lcm");
    EXPECT_NE(was.room.session, is.room.session);
    EXPECT_EQ(was.edits.size(), is.edits.size());
    EXPECT_EQ(was.views.at(0).rbegin()->second.x, is.views.at(0).rbegin()->second.x);
  }
}

TEST(LabResume, WithAnEditItDiffersFromThereOnAndCanBeDoneAgain) {
  LabWorkspace files;
  Record(files, "rally", "central");
  const Recording was = ReadRecording(files / "run.lcm");
  const Scene scene = ParseScene(was.room.scene_text, was.room.scene_name);
  const std::string body =
      scene.parts[static_cast<std::size_t>(was.views.at(0).begin()->second.id[0])].name;
  for (const std::string& edit :
       {"push " + body + " 900 2000", "remove " + body,
        std::string("insert [[part]]\n name = \"new\"\n circle = 0.3\n position = [0, 9]")}) {
    const std::string said = Lab({"resume", files / "run.lcm", "--tick", "120", "--for", "3",
                                  "--edit", edit, "-o", files / "on.lcm", "--force"});
    const std::string differs = " is the first that differs";
    const std::size_t at = said.find(differs);
    ASSERT_NE(at, std::string::npos) << edit << ": " << said;
    const int first = std::stoi(said.substr(said.rfind(' ', at - 1)));
    EXPECT_GT(first, 120) << said;
    EXPECT_LT(first, 135) << said;
    EXPECT_NE(Lab({"replay", files / "on.lcm"}).find("300 ticks done again"), std::string::npos);
    const Recording is = ReadRecording(files / "on.lcm");
    EXPECT_EQ(is.views.at(0).at(119).x, was.views.at(0).at(119).x) << "as it was before";
    EXPECT_EQ(is.last_tick, 300);
  }
}

TEST(LabResume, MistakesAreOneLine) {
  LabWorkspace files;
  Record(files, "crossing", "buffer");
  const std::string log = files / "run.lcm";
  for (const Words& words :
       {Words{"resume", log, "--tick", "900"}, Words{"resume", log, "--tick", "9", "--for", "90"},
        Words{"resume", log, "--tick", "9", "--edit", "push nobody 1 2"},
        Words{"resume", log, "--tick", "9", "--edit", "jump"},
        Words{"resume", log, "--tick", "9", "--edit", "push ground 1 x"},
        Words{"resume", log, "--tick", "9", "-o", log}}) {
    const std::string errors = Lab(words, 2);
    EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 1) << errors;
  }
}

}  // namespace lab_resume_test
}  // namespace seam
