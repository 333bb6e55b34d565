/// One class decides each body's activity; all others read it.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/source_tree.h"

namespace seam {
namespace activity_test {

const char* const kDecider = "common/sync/reach/activities.cpp";
/// A world of its own, of which no peer knows.
const char* const kSpare = "common/sync/audit/spare_world.cpp";

/// "FILE:LINE" of each call that sets an activity outside the decider, a line each.
std::string SetElsewhere(const std::vector<Source>& sources) {
  const Regex sets(".*(\\.|->)SetActivity\\(.*");
  std::string offenders;
  for (const Source& source : sources) {
    if (source.path == kDecider || source.path == kSpare) continue;
    for (std::size_t i = 0; i < source.lines.size(); ++i) {
      if (sets.Matches(source.lines[i])) {
        offenders += source.path + ":" + std::to_string(i + 1) + "\n";
      }
    }
  }
  return offenders;
}

TEST(Activity, OnlyActivitiesSetsIt) {
  const std::vector<Source> sources = Sources(kProduct, {".h", ".cpp"});
  EXPECT_EQ(SetElsewhere(sources), "");
  int found = 0;
  for (const Source& source : sources) found += source.path == kDecider ? 1 : 0;
  EXPECT_EQ(found, 1) << "the decider has another name now";
}

TEST(Activity, ASecondDeciderIsFound) {
  Source source;
  source.path = "common/sync/display.cpp";
  source.lines = {"  world_.SetActivity(body, Activity::kParked);", "  world_.activity(body);",
                  "  world->SetActivity(body, wanted);"};
  EXPECT_EQ(SetElsewhere({source}), "common/sync/display.cpp:1\ncommon/sync/display.cpp:3\n");
  source.path = kDecider;
  EXPECT_EQ(SetElsewhere({source}), "");
}

}  // namespace activity_test
}  // namespace seam
