/// A recording that cannot be written: the room runs on, the operator is informed at once and at
/// the end, and the exit status is 1.

#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/program.h"

namespace seam {
namespace record_failure_test {

using Words = std::vector<std::string>;

/// `words` run where no file may grow beyond 1 kB, as on a full disk.
Words OnAFullDisk(const Workspace& folder, const Words& words) {
  // GCOV_PREFIX: under coverage its counters go elsewhere, not half into everybody's files.
  Words all = {"env", "GCOV_PREFIX=" + folder.path(),           "sh",
               "-c",  "trap '' XFSZ; ulimit -f 2; exec \"$@\"", "sh"};
  all.insert(all.end(), words.begin(), words.end());
  return all;
}

Words Server(const std::string& record, const std::string& duration_s) {
  return {BuiltProgram("seam-server"),
          std::filesystem::absolute("scenes/crossing.toml").string(),
          "--bind",
          "127.0.0.1:0",
          "--wait",
          "0",
          "--duration",
          duration_s,
          "--lcm-url",
          "none",
          "--quiet",
          "--record",
          record};
}

/// Counts the lines of `text` that contain `part`.
int LinesWith(const std::string& text, const std::string& part) {
  int lines = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    if (text.substr(at, end - at).find(part) != std::string::npos) ++lines;
    at = end + 1;
  }
  return lines;
}

TEST(RecordFailure, AFullDiskIsReportedAtOnceAndAtTheEndAndTheRoomRunsOn) {
  const Workspace folder;
  Program server(OnAFullDisk(folder, Server(folder / "full.lcm", "0")));
  ASSERT_TRUE(server.WaitForErrors("full.lcm: ", 30)) << server.Story();
  EXPECT_FALSE(server.Wait(1)) << "the room runs on: " << server.Story();
  server.Signal(SIGTERM);
  ASSERT_TRUE(server.Wait(30));
  EXPECT_EQ(server.status(), 1) << server.Story();
  EXPECT_EQ(LinesWith(server.errors(), " ticks; dropped "), 1) << server.Story();
  EXPECT_EQ(LinesWith(server.errors(), "full.lcm: cannot be written: "), 2) << server.Story();
}

TEST(RecordFailure, AnUnwritablePlaceIsReportedAtOnceAndAtTheEnd) {
  Program server(Server("/proc/seam.lcm", "0.5"));
  ASSERT_TRUE(server.Wait(30));
  if (server.status() == 2) GTEST_SKIP() << "not root: refused before it begins";
  EXPECT_EQ(server.status(), 1) << server.Story();
  EXPECT_EQ(LinesWith(server.errors(), " ticks; dropped "), 1) << server.Story();
  EXPECT_EQ(LinesWith(server.errors(), "/proc/seam.lcm: cannot be created: "), 2) << server.Story();
}

TEST(RecordFailure, AClientPlaysOnAndEndsWithStatus1) {
  const Workspace folder;
  Words words = Server(folder / "whole.lcm", "0");
  Program server(words);
  ASSERT_TRUE(server.WaitForErrors("waiting for", 10)) << server.Story();
  const std::string said = server.errors();
  const std::size_t at = said.find("on 127.0.0.1:") + 3;
  const std::string address = said.substr(at, said.find('\n', at) - at);
  Program client(
      OnAFullDisk(folder, {BuiltProgram("seam-client"), address, "--watch", "--duration", "2",
                           "--quiet", "--lcm-url", "none", "--record", folder / "full.lcm"}));
  ASSERT_TRUE(client.Wait(30));
  EXPECT_EQ(client.status(), 1) << client.Story();
  EXPECT_EQ(LinesWith(client.errors(), "seam-client: left"), 1) << client.Story();
  EXPECT_EQ(LinesWith(client.errors(), "full.lcm: cannot be written: "), 2) << client.Story();
  server.Signal(15);
  ASSERT_TRUE(server.Wait(30));
  EXPECT_EQ(server.status(), 0) << server.Story();
}

TEST(RecordFailure, TheLabAndTheMeasuresFailToo) {
  const Workspace folder;
  Program lab(OnAFullDisk(folder, {BuiltProgram("seam-lab"), "run", "scenes/crossing.toml", "-o",
                                   folder / "full.lcm", "--duration", "0.5", "--no-floor"}));
  ASSERT_TRUE(lab.Wait(60));
  EXPECT_NE(lab.status(), 0) << lab.Story();
  EXPECT_EQ(LinesWith(lab.errors(), "full.lcm: cannot be written: "), 1) << lab.Story();
}

}  // namespace record_failure_test
}  // namespace seam
