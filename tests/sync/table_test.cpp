/// Columns after an edit: each merge rule, and the order in which entries follow.

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "common/sync/table/body_column.h"
#include "common/sync/table/mechanism_column.h"

namespace seam {
namespace table_test {

BodyOrigin From(int body, bool same) {
  BodyOrigin origin;
  origin.body = body;
  origin.same = same;
  return origin;
}

/// An edit of three bodies: the last one stays and is the first now, the first one breaks in two,
/// and one is new. Of three mechanisms the last two become one, which comes first; one is new.
BodyRemap Change() {
  BodyRemap change;
  change.bodies = {From(2, true), From(0, false), From(0, false), From(-1, false)};
  change.mechanisms = {{2, 1}, {0}, {}};
  return change;
}

class TableTest : public ::testing::Test {
 protected:
  TableTest() {
    for (int i = 0; i < 3; ++i) {
      by_body_rule_[0][i] = by_body_rule_[1][i] = by_body_rule_[2][i] = 10 + i;
      largest_[i] = first_[i] = fresh_[i] = 20 + i;
    }
  }

  BodyTable table_{3, 3};
  BodyColumn<int> by_body_rule_[3] = {{table_, BodyRule::kFresh, -1},
                                      {table_, BodyRule::kSame, -1},
                                      {table_, BodyRule::kOrigin, -1}};
  MechanismColumn<int> fresh_{table_, MechanismRule::kFresh, -1};
  MechanismColumn<int> largest_{
      table_, [](const int& before, int* into) { *into = std::max(*into, before); }, -1};
  MechanismColumn<int> first_{table_, [](int mechanism, const std::vector<const int*>& before) {
                                return before.empty() ? -mechanism : *before.front();
                              }};
};

TEST_F(TableTest, ColumnsStartWithTheFreshValueOfTheTablesSize) {
  const BodyColumn<int> bodies(table_, BodyRule::kSame, 7);
  const MechanismColumn<int> mechanisms(table_, MechanismRule::kScratch, 8);
  EXPECT_EQ(bodies.values(), std::vector<int>({7, 7, 7}));
  EXPECT_EQ(mechanisms.values(), std::vector<int>({8, 8, 8}));
}

TEST_F(TableTest, BodyRulesChooseWhoKeepsAValue) {
  table_.Renumber(Change());
  EXPECT_EQ(table_.bodies(), 4);
  EXPECT_EQ(by_body_rule_[0].values(), std::vector<int>({-1, -1, -1, -1}));
  EXPECT_EQ(by_body_rule_[1].values(), std::vector<int>({12, -1, -1, -1}));
  EXPECT_EQ(by_body_rule_[2].values(), std::vector<int>({12, 10, 10, -1}));
}

TEST_F(TableTest, BothHalvesOfABodyGetACopyOfWhatItOwned) {
  BodyColumn<std::vector<int>> lists(table_, BodyRule::kOrigin);
  lists[0] = {1, 2};
  lists[2] = {3};
  const int* const kept = lists[2].data();
  table_.Renumber(Change());
  EXPECT_EQ(lists[1], std::vector<int>({1, 2}));
  EXPECT_EQ(lists[2], std::vector<int>({1, 2}));
  EXPECT_EQ(lists[0].data(), kept) << "an unchanged body's value is moved";
}

TEST_F(TableTest, MechanismRulesMergeInTheOrderOfTheRemap) {
  table_.Renumber(Change());
  EXPECT_EQ(table_.mechanisms(), 3);
  EXPECT_EQ(fresh_.values(), std::vector<int>({-1, -1, -1}));
  EXPECT_EQ(largest_.values(), std::vector<int>({22, 20, -1}));
  EXPECT_EQ(first_.values(), std::vector<int>({22, 20, -2}));
}

TEST_F(TableTest, MergeOfABodySeesItsNumberItsOriginAndTheValueBefore) {
  BodyColumn<std::string> said(
      table_,
      [](int body, const BodyOrigin& origin, std::string* before) {
        return std::to_string(body) + (origin.same ? "=" : "<") + (before ? *before : "nothing");
      },
      "a");
  table_.Renumber(Change());
  EXPECT_EQ(said.values(), std::vector<std::string>({"0=a", "1<a", "2<a", "3<nothing"}));
}

TEST_F(TableTest, HooksFollowInTheOrderOfTheirMakingAndSeeColumnsBeforeThem) {
  std::vector<int> seen;
  const EditHook first(table_, [&](const BodyRemap&) { seen.push_back(by_body_rule_[1][0]); });
  BodyColumn<int> late(table_, BodyRule::kOrigin, 5);
  late[2] = 6;
  const EditHook second(table_, [&](const BodyRemap& change) {
    seen.push_back(late[0]);
    seen.push_back(static_cast<int>(change.bodies.size()));
  });
  table_.Renumber(Change());
  EXPECT_EQ(seen, std::vector<int>({12, 6, 4}));
  EXPECT_EQ(table_.renumbered(), 1);
}

TEST_F(TableTest, EntriesLeaveInAnyOrder) {
  int calls = 0;
  const auto hook = [&] {
    return std::make_unique<EditHook>(table_, [&](const BodyRemap&) { ++calls; });
  };
  std::unique_ptr<EditHook> a = hook(), b = hook(), c = hook();
  b.reset();
  table_.Renumber(Change());
  EXPECT_EQ(calls, 2);
  a.reset();
  c.reset();
  calls = 0;
  BodyRemap back;
  back.bodies = {From(0, true)};
  back.mechanisms = {{0}};
  table_.Renumber(back);
  EXPECT_EQ(calls, 0);
  EXPECT_EQ(by_body_rule_[1].values(), std::vector<int>({12}));
}

TEST(BodyTableDeathTest, MustOutliveItsEntries) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH(
      {
        auto table = std::make_unique<BodyTable>(1, 1);
        const BodyColumn<int> column(*table, BodyRule::kFresh);
        table.reset();
      },
      "assertion failed");
}

}  // namespace table_test
}  // namespace seam
