/// The sweep files that `make report` runs.

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "common/sync/reconcile/reconcile.h"
#include "tests/lab/grid.h"

namespace seam {
namespace {

TEST(Report, TheSweepsItRunsCanBeRunAndLeaveNoReconcilerOut) {
  for (const char* folder : {"tests/lab/sweeps", "tests/lab/sweeps/quick"}) {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() != ".toml") continue;
      const std::string stem = entry.path().stem();
      const std::set<std::string> few = {
          "worlds",  "crowds",      "must-heap", "must-worlds", "must-gas",  // dear
          "floors",  "floors-demo",                 // of the measure itself
          "changes", "input-delay", "must-limit"};  // the best of each kind
      if (few.count(stem) > 0) continue;
      ++count;
      std::set<std::string> rules;
      for (const GridPoint& point : ReadGrid(entry.path().string()).points) {
        rules.insert(point.settings.reconcile);
      }
      for (const NamedReconciler& known : Reconcilers()) {
        EXPECT_EQ(rules.count(known.name), 1u) << entry.path() << " leaves out " << known.name;
      }
    }
    EXPECT_GE(count, 3u) << folder;
  }
}

}  // namespace
}  // namespace seam
