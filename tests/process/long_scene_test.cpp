/// Scenes longer than a message of the bus, with real processes: joined over UDP, captured by the
/// stock lcm-logger, read, measured and drawn; one byte too much is refused in one line.

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/process/big_scene.h"
#include "tests/support/in_namespace.h"
#include "tests/support/live_session.h"

namespace seam {
namespace long_scene_test {

constexpr std::size_t kLongest = 4000000;
/// s; a scene takes seconds to parse, three times, on a machine that does other things, too.
constexpr double kLongSceneWait = 240;

class LongScene : public InNamespace {
 protected:
  std::string Written(std::size_t bytes) {
    const std::string path = folder_ / ("scene-" + std::to_string(bytes) + ".toml");
    std::ofstream(path, std::ios::binary) << BigScene(bytes);
    return path;
  }
  Workspace folder_;
};

TEST_F(LongScene, IsJoinedRecordedMeasuredAndDrawn) {
  SEAM_INSIDE_ONLY();
  int index = 60;
  for (const std::size_t bytes : {std::size_t{200000}, std::size_t{1000000}, kLongest}) {
    SCOPED_TRACE(bytes);
    SessionPlan plan;
    plan.name = "long-" + std::to_string(bytes);
    plan.scene = Written(bytes);
    plan.server_flags = {"--wait", "1", "--quiet"};
    plan.clients["ann"] = {"--drive", "bot", "--quiet", "--join-timeout", "60"};
    LiveSession session(folder_, index++, plan);
    ASSERT_TRUE(session.Begin());
    // The room starts when she is there; then she parses its scene. The stock logger may lose parts
    // of it, which come again.
    const auto played = [&](const Recording& r) {
      const auto hers = r.views.find(1);
      return r.room.scene_text.size() == bytes && hers != r.views.end() &&
             hers->second.size() > 120;
    };
    for (int s = 0; s < kLongSceneWait && !played(session.Captured()); ++s) sleep(1);
    session.server().Signal(SIGTERM);
    ASSERT_TRUE(session.Finish(kLongSceneWait)) << session.Story();
    SCOPED_TRACE(session.Story());
    EXPECT_EQ(session.server().status(), 0);
    EXPECT_EQ(session.client("ann").status(), 0);
    EXPECT_NE(session.client("ann").errors().find("the server closed the room"), std::string::npos);
    const Recording captured = session.Captured();
    EXPECT_EQ(captured.room.scene_text, BigScene(bytes));
    EXPECT_EQ(captured.undecodable, 0);
    ASSERT_EQ(captured.views.size(), 2u);
    EXPECT_GT(captured.views.at(1).size(), 120u) << "ann played";

    Program measure({BuiltProgram("seam-measure"), session.capture_path()});
    ASSERT_TRUE(measure.Wait(kLongSceneWait));
    EXPECT_EQ(measure.status(), 0) << measure.Story();
    const std::string picture = folder_ / (plan.name + ".png");
    Program render({BuiltProgram("seam-render"), session.capture_path(), "-o", picture, "--sheet",
                    "2", "--size", "320x240"});
    ASSERT_TRUE(render.Wait(kLongSceneWait));
    EXPECT_EQ(render.status(), 0) << render.Story();
    EXPECT_TRUE(std::filesystem::exists(picture));
  }
}

TEST_F(LongScene, OneByteTooMuchIsRefusedInOneLine) {
  const std::string path = Written(kLongest + 1);
  const std::string line = path + ":1: a scene may have at most 4000000 bytes; this one has more\n";
  Program server({BuiltProgram("seam-server"), path, "--lcm-url", "none", "--port", "17399"});
  ASSERT_TRUE(server.Wait(kLongSceneWait));
  EXPECT_EQ(server.status(), 2);
  EXPECT_EQ(server.errors(), "seam-server: " + line);
  Program check({BuiltProgram("seam-lab"), "check", path});
  ASSERT_TRUE(check.Wait(kLongSceneWait));
  EXPECT_EQ(check.status(), 2);
  EXPECT_NE((check.output() + check.errors()).find(line), std::string::npos) << check.Story();
}

}  // namespace long_scene_test
}  // namespace seam
