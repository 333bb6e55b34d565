/// Items shared among processes: each is drawn once, and every failure is reported.
#include "render/drawing_processes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "common/base/check.h"
#include "tests/support/render_fixture.h"

namespace seam {
namespace drawing_processes_test {

namespace fs = std::filesystem;

void Leave(const std::string& path, int item) {
  std::ofstream(path + "/" + std::to_string(item) + "-" + std::to_string(getpid()));
}

std::string Failure(int count, int processes, const std::function<void(int)>& draw) {
  try {
    DrawInProcesses(count, processes, draw, [](int) {});
  } catch (const OperatorError& error) {
    return error.what();
  }
  return "";
}

TEST(DrawingProcesses, EachItemIsDrawnOnceByOneOfTheChildren) {
  for (const int processes : {1, 2, 7, 64}) {
    const Folder folder;
    int done = 0;
    DrawInProcesses(
        40, processes, [&](int item) { Leave(folder / "", item); },
        [&](int now) { EXPECT_EQ(now, ++done); });
    EXPECT_EQ(done, 40);
    std::multiset<int> items;
    for (const auto& entry : fs::directory_iterator(folder / "")) {
      const std::string name = entry.path().filename();
      items.insert(std::stoi(name));
      EXPECT_NE(name.substr(name.find('-') + 1), std::to_string(getpid()));
    }
    EXPECT_EQ(items.size(), 40u);
    EXPECT_EQ(std::set<int>(items.begin(), items.end()).size(), 40u);
  }
}

TEST(DrawingProcesses, AnExceptionInAChildIsRethrownAndTheOthersStop) {
  const Folder folder;
  EXPECT_EQ(Failure(1000000, 3,
                    [&](int item) {
                      if (item == 20) throw OperatorError("the disk is full");
                      Leave(folder / "", item);
                    }),
            "the disk is full");
  const auto drawn = std::distance(fs::directory_iterator(folder / ""), {});
  EXPECT_LT(drawn, 100000);
}

TEST(DrawingProcesses, AKilledChildIsAnError) {
  EXPECT_THAT(Failure(10, 2,
                      [](int item) {
                        if (item == 3) raise(SIGKILL);
                      }),
              testing::StartsWith("a drawing process was ended: "));
}

}  // namespace drawing_processes_test
}  // namespace seam
