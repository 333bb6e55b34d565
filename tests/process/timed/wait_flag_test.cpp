/// seam-server --wait takes as many players as a scene may have.

#include <gtest/gtest.h>
#include <signal.h>

#include "common/base/limits.h"
#include "tests/support/program.h"

namespace seam {
namespace wait_flag_test {

/// The longest that anything is waited for, s; a busy machine takes its time.
constexpr double kPatience = 60;

std::vector<std::string> Server(const std::string& wait) {
  return {BuiltProgram("seam-server"),
          "swarm1000",
          "--wait",
          wait,
          "--bind",
          "127.0.0.1:0",
          "--lcm-url",
          "none",
          "--duration",
          "0",
          "--quiet"};
}

TEST(ServerProgramWaits, ForAnyNumberOfPlayersThatASceneMayHave) {
  for (const int players : {40, static_cast<int>(kPlayersMax)}) {
    Program server(Server(std::to_string(players)));
    const std::string line = "waiting for " + std::to_string(players) + " player(s)";
    ASSERT_TRUE(server.WaitForErrors(line, kPatience)) << server.Story();
    server.Signal(SIGTERM);
    EXPECT_TRUE(server.Wait(kPatience)) << server.Story();
  }
  Program refused(Server(std::to_string(kPlayersMax + 1)));
  ASSERT_TRUE(refused.Wait(kPatience));
  EXPECT_EQ(refused.status(), 2) << refused.Story();
}

}  // namespace wait_flag_test
}  // namespace seam
