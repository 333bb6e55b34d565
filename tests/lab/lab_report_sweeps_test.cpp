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
      if (stem == "worlds" || stem == "crowds") continue;  // dear: a few methods have to do
      if (stem == "floors") continue;                      // of the measure itself, not of methods
      if (stem == "input-delay") continue;                 // the best of each kind
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
