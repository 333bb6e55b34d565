/// The messages on a machine that lacks a multicast route, which LCM needs.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "tests/support/in_namespace.h"
#include "tests/support/program.h"

namespace seam {
namespace no_route_test {

class NoRoute : public InNamespace {};

TEST_F(NoRoute, EveryBusProgramNamesTheFixInOneLineAndWritesNothing) {
  SEAM_INSIDE_ONLY("ip link set lo up");
  const std::string scene = std::filesystem::absolute("scenes/crossing.toml").string();
  const std::vector<std::vector<std::string>> commands = {
      {"seam-server", scene, "--bind", "127.0.0.1:0", "--record", "new.lcm"},
      {"seam-client", "127.0.0.1:9", "--watch", "--record", "new.lcm"},
      {"seam-render", "--live", "-o", "new"},
      {"seam-view", "--port", "0"}};
  for (std::vector<std::string> words : commands) {
    const Workspace folder;
    const std::string begin = words[0] + ": LCM: this machine has no route for multicast; ";
    words[0] = BuiltProgram(words[0]);
    Program program(words, folder.path());
    EXPECT_TRUE(program.Wait(30));
    SCOPED_TRACE(program.Story());
    EXPECT_EQ(program.status(), 2);
    EXPECT_EQ(program.output(), "");
    const std::string line = program.errors();
    EXPECT_EQ(line.rfind(begin, 0), 0u);
    EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1);
    EXPECT_NE(line.find("ip link set lo up multicast on; ip route add 224.0.0.0/4 dev lo"),
              std::string::npos);
    EXPECT_TRUE(folder.Content().empty());
  }
}

TEST_F(NoRoute, TheDoctorReportsItAndTheRoomRunsWithoutTheBus) {
  SEAM_INSIDE_ONLY("ip link set lo up");
  Program doctor({BuiltProgram("seam-server"), "--doctor"});
  EXPECT_TRUE(doctor.Wait(30));
  EXPECT_EQ(doctor.status(), 1) << doctor.Story();
  EXPECT_NE(doctor.output().find("ip route add 224.0.0.0/4 dev lo"), std::string::npos);
  Program server({BuiltProgram("seam-server"), "scenes/crossing.toml", "--bind", "127.0.0.1:0",
                  "--wait", "0", "--duration", "0.2", "--lcm-url", "none"});
  EXPECT_TRUE(server.Wait(30));
  EXPECT_EQ(server.status(), 0) << server.Story();
}

}  // namespace no_route_test
}  // namespace seam
