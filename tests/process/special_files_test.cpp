/// A FIFO, a device, a socket or a folder is refused as a scene, as a log and as an output: in one
/// line, at once, with exit status 2. Opening a FIFO would block for ever.

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <deque>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/program.h"

namespace seam {
namespace special_files_test {

using Words = std::vector<std::string>;

/// The names by which each kind is given; `ending`: some outputs must have one.
Words MakeSpecialFiles(const Workspace& folder, const std::string& ending) {
  const std::string fifo = folder / ("fifo" + ending), socket_path = folder / ("socket" + ending);
  const std::string device = folder / ("device" + ending), inside = folder / ("folder" + ending);
  EXPECT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  std::filesystem::create_directory(inside);
  std::filesystem::create_symlink("/dev/zero", device);
  sockaddr_un name{};
  name.sun_family = AF_UNIX;
  std::strncpy(name.sun_path, socket_path.c_str(), sizeof name.sun_path - 1);
  const int s = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  EXPECT_EQ(bind(s, reinterpret_cast<const sockaddr*>(&name), sizeof name), 0);
  close(s);  // the name stays
  return {fifo, inside, device, socket_path};
}

/// Runs each command, a few at a time: one line, status 2, within 10 s.
void ExpectRefused(const std::vector<Words>& commands) {
  struct Running {
    std::string story;
    std::unique_ptr<Program> program;
  };
  std::deque<Running> running;
  const auto judge = [&] {
    Program& program = *running.front().program;
    SCOPED_TRACE(running.front().story);
    EXPECT_TRUE(program.Wait(10)) << "hangs";
    EXPECT_EQ(program.status(), 2) << program.Story();
    const std::string said = program.errors();
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
    running.pop_front();
  };
  for (Words words : commands) {
    std::string story;
    for (const std::string& word : words) story += word + " ";
    words[0] = BuiltProgram(words[0]);
    running.push_back({story, std::make_unique<Program>(words)});
    if (running.size() == 4) judge();
  }
  while (!running.empty()) judge();
}

class SpecialFiles : public ::testing::Test {
 protected:
  void MakeLog() {
    Program lab({BuiltProgram("seam-lab"), "run", "scenes/crossing.toml", "-o", log_, "--duration",
                 "0.2", "--no-floor"});
    ASSERT_TRUE(lab.Wait(60) && lab.status() == 0) << lab.Story();
  }
  const Workspace folder_;
  const std::string log_ = folder_ / "good.lcm";
};

TEST_F(SpecialFiles, AreNoScene) {
  std::vector<Words> commands;
  Words names = MakeSpecialFiles(folder_, ".toml");
  names.push_back("/dev/stdin");
  for (const std::string& name : names) {
    commands.push_back({"seam-server", name, "--bind", "127.0.0.1:0", "--lcm-url", "none"});
    commands.push_back({"seam-lab", "run", name, "-o", folder_ / "new.lcm"});
    commands.push_back({"seam-lab", "sweep", name, "-o", folder_ / "new.csv"});
  }
  ExpectRefused(commands);
}

TEST_F(SpecialFiles, AreNoLogToRead) {
  std::vector<Words> commands;
  for (const std::string& name : MakeSpecialFiles(folder_, ".lcm")) {
    commands.push_back({"seam-measure", name});
    commands.push_back({"seam-export", name, "--csv"});
    commands.push_back({"seam-render", name, "-o", folder_ / "frames"});
  }
  ExpectRefused(commands);
}

TEST_F(SpecialFiles, AreNoRecordingToWrite) {
  std::vector<Words> commands;
  for (const std::string& name : MakeSpecialFiles(folder_, ".lcm")) {
    commands.push_back({"seam-server", "crossing", "--bind", "127.0.0.1:0", "--lcm-url", "none",
                        "--wait", "0", "--duration", "0.2", "--record", name, "--force"});
    commands.push_back({"seam-client", "127.0.0.1:9", "--watch", "--join-timeout", "0.2",
                        "--lcm-url", "none", "--record", name, "--force"});
    commands.push_back({"seam-lab", "run", "crossing", "-o", name, "--force", "--duration", "0.2"});
  }
  ExpectRefused(commands);
}

TEST_F(SpecialFiles, AreNoTableAndNoPictureToWrite) {
  MakeLog();
  std::vector<Words> commands;
  for (const std::string& name : MakeSpecialFiles(folder_, ".csv")) {
    commands.push_back({"seam-measure", log_, "--csv", name});
    commands.push_back({"seam-export", log_, "--csv", "-o", name, "--force"});
    commands.push_back({"seam-measure", log_, "--csv", name, "--append"});
    commands.push_back(
        {"seam-lab", "sweep", "tests/lab/sweeps/quick/rate.toml", "-o", name, "--force"});
    commands.push_back({"seam-lab", "report", name, "-o", folder_ / "report"});
  }
  for (const std::string& name : MakeSpecialFiles(folder_, ".png")) {
    commands.push_back({"seam-render", "--strobe", log_, "-o", name, "--force"});
  }
  ExpectRefused(commands);
}

}  // namespace special_files_test
}  // namespace seam
