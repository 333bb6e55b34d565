/// The first page of the report: bars that are held or missed, and medians without invalid runs.

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "common/sync/blend/reconcile.h"
#include "tests/lab/grid.h"
#include "tests/lab/report/hurry_section.h"

namespace seam {
namespace lab_bars_test {

constexpr const char* kHead =
    "scene,set,mode,reconcile,impair,drive,smooth,seed,error_others_m,error_rms_m,stutter_mps2,"
    "seen,info_limit_m,floor_wire_m,duration_s,cpu_s,valid\n";

/// One run of crossing with bots.
std::string Row(const std::string& method, const std::string& rest, const std::string& scene,
                const std::string& set = "") {
  return "scenes/" + scene + ".toml," + set + "," + method + "," + rest + "\n";
}

std::string OneRun(const std::string& method, int seed, const std::string& others,
                   const std::string& rms) {
  return Row(
      method,
      "demo,bot,on," + std::to_string(seed) + "," + others + "," + rms + ",8,0.1,0.02,0.001,6,0.3,",
      "crossing");
}

std::vector<CaseTable> TablesOf(const std::string& rows, const std::string& name = "must-bots") {
  return {{name, "seam-lab sweep x", CsvTable::Parse(kHead + rows, name + ".csv")}};
}

/// The default at 0.05, and central/all at `central`.
std::string TwoMethods(const std::string& own, const std::string& rms, const std::string& central) {
  std::string rows;
  for (const int seed : {1, 2, 3}) {
    rows +=
        OneRun("buffer,rollback", seed, own, rms) + OneRun("central,all", seed, central, "0.01");
  }
  return rows;
}

std::string VerdictOf(const std::string& rows) {
  const std::vector<CaseTable> tables = TablesOf(rows);
  const TextTable table = BarTable(FindCases(tables), nullptr);
  return table.rows.size() == 1 ? table.rows[0].back() : "no row";
}

TEST(Bars, AreHeldOrMissedAndNameTheMethod) {
  EXPECT_EQ(VerdictOf(TwoMethods("0.05", "0.05", "0.05")), "held");
  EXPECT_EQ(VerdictOf(TwoMethods("0.056", "0.05", "0.05")), "missed: default");
  EXPECT_EQ(VerdictOf(TwoMethods("0.05", "0.05", "0.051")), "missed: central/all");
  EXPECT_EQ(VerdictOf(TwoMethods("0.06", "0.05", "0.06")), "missed: default, central/all");
  EXPECT_EQ(VerdictOf(TwoMethods("0.05", "0.067", "0.05")), "missed: default's error_rms_m")
      << "the roots may err by a fifth more";
}

TEST(Bars, SayThatEvenHeldInputsMissTheBar) {
  std::string rows;
  for (const char* method : {"buffer,rollback", "central,all"}) {
    rows += Row(method, "demo,bot,on,1,0.07,0.03,8,0.1,0.06,0.001,6,0.3,", "crossing");
  }
  EXPECT_EQ(VerdictOf(rows), "missed: default, central/all; inputs held miss it too");
}

TEST(Bars, AMethodThatDidNotRunMisses) {
  std::string rows;
  for (const int seed : {1, 2}) {
    rows +=
        OneRun("buffer,rollback", seed, "0.01", "0.01") + OneRun("buffer,fade", seed, "0.3", "0.3");
  }
  EXPECT_EQ(VerdictOf(rows), "missed: central/all");
}

TEST(Bars, StandBesideTheEarlierValues) {
  const std::vector<CaseTable> tables = TablesOf(TwoMethods("0.05", "0.05", "0.05"));
  const Before before{CsvTable::Parse(
      "scene,drive,impair,reconcile,error_others_m,error_rms_m,stutter_mps2,seen\n"
      "crossing,bot,demo,retrospect,0.456,0.146,9,0.5\ncrossing,bot,demo,fade,0.4,0.1,7,0.6\n"
      "crossing,bot,4g,fade,9,9,1,0.6\n",
      "before.csv")};
  const std::vector<ReportCase> cases = FindCases(tables);
  const TextTable bars = BarTable(cases, &before);
  ASSERT_EQ(bars.rows.size(), 1u);
  EXPECT_EQ(bars.rows[0][0], "crossing, bots");
  EXPECT_EQ(bars.rows[0][1], "0.456");
  EXPECT_EQ(bars.rows[0][2], "0.146");
  const TextTable stutter = StutterTable(cases, &before);
  ASSERT_EQ(stutter.rows.size(), 1u);
  EXPECT_EQ(stutter.rows[0][1], "7") << "the lowest of the methods over this network";
  EXPECT_EQ(stutter.rows[0][4], "missed") << "the default's is 8";
}

/// A time is no bar: it depends on the machine and its load. The ratio is printed.
TEST(Bars, PrintTheDefaultsCpuAsARatioToRetrospects) {
  std::string rows = TwoMethods("0.05", "0.05", "0.05");
  rows += Row("buffer,retrospect", "demo,bot,on,1,0.1,0.1,8,0.1,0.02,0.001,6,0.12,", "crossing");
  const std::vector<CaseTable> tables = TablesOf(rows);
  const TextTable stutter = StutterTable(FindCases(tables), nullptr);
  ASSERT_EQ(stutter.rows.size(), 1u);
  EXPECT_EQ(stutter.header.back(), "CPU, default by retrospect");
  EXPECT_EQ(stutter.rows[0].back(), "2.5");
}

TEST(Cases, InvalidRunsAreLeftOutAndCounted) {
  const std::string invalid =
      Row("buffer,rollback", "demo,bot,on,9,,,,,,,6,0.3,no contact", "crossing");
  const std::vector<CaseTable> tables = TablesOf(TwoMethods("0.05", "0.05", "0.07") + invalid);
  const std::vector<ReportCase> cases = FindCases(tables);
  const TextTable glance = GlanceTable(cases);
  ASSERT_EQ(glance.rows.size(), 1u);
  EXPECT_EQ(glance.header, (std::vector<std::string>{"scene", "central/all", "rollback"}));
  EXPECT_EQ(glance.rows[0][1], "0.07");
  EXPECT_EQ(glance.rows[0][2], "✓ 0.05 (1 of 4 not valid)");
  const std::vector<CaseTable> none = TablesOf(invalid + OneRun("central,all", 1, "0.1", "0.1"));
  EXPECT_EQ(GlanceTable(FindCases(none)).rows[0][2], "not valid: no contact");
}

TEST(Cases, TheShortTableHasTheCasesOfTheReadmeAlone) {
  std::string rows = TwoMethods("0.05", "0.05", "0.07");
  for (const char* method : {"buffer,rollback", "central,all"}) {
    rows += Row(method, "demo,bot,on,1,0.1,0.1,8,0.1,0.02,0.001,6,0.3,", "relay");
  }
  const std::vector<CaseTable> tables = TablesOf(rows);
  const std::vector<ReportCase> cases = FindCases(tables);
  EXPECT_EQ(GlanceTable(cases).rows.size(), 2u);
  const TextTable table = ShortTable(cases);
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.rows[0][0], "crossing, bots");
}

TEST(Cases, ASceneSettingMakesACaseOfItsOwn) {
  std::vector<CaseTable> tables = TablesOf(TwoMethods("0.05", "0.05", "0.07"));
  const std::string alone =
      Row("buffer,rollback", "demo,bot,on,1,0.2,0.1,8,0.1,,,6,0.3,", "crossing", "follow=0");
  tables.push_back(TablesOf(alone, "changes")[0]);
  const Before before{CsvTable::Parse(
      "scene,drive,impair,reconcile,error_others_m\ncrossing,bot,demo,fade,0.4\n", "b.csv")};
  const TextTable changes = ChangeTable(FindCases(tables), &before);
  ASSERT_EQ(changes.rows.size(), 1u);
  EXPECT_EQ(changes.rows[0], (std::vector<std::string>{"crossing, bots", "0.4", "–", "–", "–",
                                                       "0.2", "0.05", "–", "0.07"}));
}

TEST(Report, TheFirstPageNamesTheMostExactAndTheCheapestOfThoseNearlyAsExact) {
  std::string csv = kHead;
  const auto add = [&csv](const char* method, int ms, const char* error, const char* cpu_s) {
    csv += std::string("scenes/crossing.toml,,") + method + ",delay=" + std::to_string(ms) +
           "ms,script,on,1," + error + ",1,1,0,,,10," + cpu_s + ",\n";
  };
  for (const int ms : {50, 100}) {
    add("buffer,rollback", ms, "0.1", "0.2");
    add("buffer,fade", ms, "0.12", "0.05");
    add("central,all", ms, "0.13", "0.01");
  }
  Sweep sweep{"latency", "x", CsvTable::Parse(csv, "latency.csv"), {}};
  sweep.view = ViewSweep(sweep.table);
  const TextTable which = WhichTable({sweep});
  ASSERT_EQ(which.rows.size(), 2u);
  EXPECT_EQ(which.rows[1],
            (std::vector<std::string>{"crossing, 100 ms", "rollback 0.1, 20 ms/s",
                                      "fade 0.12, 5 ms/s", "0.1, 20 ms/s", "0.13, 1 ms/s", "–"}));
}

TEST(Report, TheSweepsItRunsCanBeRunAndLeaveNoReconcilerOut) {
  for (const char* folder : {"tests/lab/sweeps", "tests/lab/sweeps/quick"}) {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() != ".toml") continue;
      const std::string stem = entry.path().stem();
      const std::set<std::string> few = {
          "worlds",      "crowds",      "must-heap",
          "must-worlds", "must-gas",                         // dear
          "floors",      "floors-demo", "floors-gluehouse",  // of the measure itself
          "changes",     "input-delay", "must-limit",
          "smoother",    "show-age"};  // the best of each kind
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

}  // namespace lab_bars_test
}  // namespace seam
