/// Values per body or mechanism are columns (common/sync/table), which an edit renumbers in one
/// place. A vector by body or mechanism does not survive an edit, and its comment says so.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/source_tree.h"

namespace seam {
namespace tables_test {

/// Folders whose indices are not those of a replica: columns themselves, and the planner, which
/// numbers the mechanisms of each plan's view.
bool NumbersByItself(const std::string& path) {
  const bool planner =
      path.rfind("server/authority/", 0) == 0 && path.find("/authority_") == std::string::npos;
  return planner || path.rfind("common/sync/table/", 0) == 0;
}

/// "FILE:LINE" of each member that is a container by body or mechanism, and is neither scratch nor
/// rebuilt, a line each.
std::string Uncolumned(const std::vector<Source>& sources) {
  const Regex member(
      " *(mutable )?std::(vector|deque|map)<.*>.* [a-z_]+_;.*//.*by "
      "(moving )?(body|mechanism).*");
  const Regex passing(".*// (scratch|rebuilt)[ ,].*");
  std::string offenders;
  for (const Source& source : sources) {
    if (NumbersByItself(source.path)) continue;
    for (std::size_t i = 0; i < source.lines.size(); ++i) {
      if (!member.Matches(source.lines[i]) || passing.Matches(source.lines[i])) continue;
      offenders += source.path + ":" + std::to_string(i + 1) + "\n";
    }
  }
  return offenders;
}

TEST(Tables, ValuesThatSurviveAnEditAreColumns) {
  EXPECT_EQ(Uncolumned(Sources({"common/sync", "server", "client"}, {".h", ".cpp"})), "");
}

TEST(Tables, AVectorByBodyIsFoundUnlessItSaysThatItIsScratchOrRebuilt) {
  Source source;
  source.path = "server/a.h";
  source.lines = {"  std::vector<int> a_;  // by body",
                  "  BodyColumn<int> b_;  // its place",
                  "  std::vector<int> c_;  // scratch, by body",
                  "  std::vector<int> d_;  // bodies",
                  "  mutable std::map<int, bool> e_;  // rebuilt by Look, by mechanism",
                  "  std::map<int, bool> f_;  // true: seen; by mechanism"};
  EXPECT_EQ(Uncolumned({source}), "server/a.h:1\nserver/a.h:6\n");
  source.path = "server/authority/plan.h";
  EXPECT_EQ(Uncolumned({source}), "");
}

TEST(Tables, NothingButTheTableRenumbers) {
  const Regex remap(".*[^A-Za-z]Remap\\(.*"), renumber(".*[^a-z:>.]Renumber\\(const BodyRemap.*");
  std::string offenders;
  int found = 0;
  for (const Source& source : Sources(kProduct, {".h", ".cpp"})) {
    for (std::size_t i = 0; i < source.lines.size(); ++i) {
      const bool own = renumber.Matches(source.lines[i]);
      found += own ? 1 : 0;
      const bool may = source.path.rfind("common/sync/table/", 0) == 0 ||
                       source.path == "common/sync/history.h";  // a column by tick and body
      if ((own && !may) || remap.Matches(source.lines[i])) {
        offenders += source.path + ":" + std::to_string(i + 1) + "\n";
      }
    }
  }
  EXPECT_EQ(offenders, "");
  EXPECT_GE(found, 4);
}

}  // namespace tables_test
}  // namespace seam
