/// The figure of speed against error of the solver, from tables written by hand.

#include "tests/lab/report/joints/solver_speed.h"

#include <gtest/gtest.h>

#include <cmath>

namespace seam {
namespace solver_speed_test {

std::string Row(const std::string& name, const std::string& role, const std::string& levers,
                const std::string& joints, const std::string& figures) {
  return name + ",formula,m," + role + "," + levers + ",on,body," + joints + "," + figures + ",\n";
}

/// Three cases with joints and two without. Levers: rate, substeps, iterations, warm, skin.
CsvTable Table() {
  const std::string stock = "60,1,8,3,on,", fine = "60,2,8,3,on,", thin = "60,1,8,3,on,0.0025";
  std::string text =
      "case,truth,unit,role,tick_hz,substeps,velocity_iterations,position_iterations,"
      "warm_starting,skin,continuous,welds,joints,joint_substeps,contacts,contact_substeps,error,"
      "failure,cost_ratio,valid\n";
  const auto add = [&](const char* name, const char* role, const std::string& levers,
                       const char* joints,
                       const char* figures) { text += Row(name, role, levers, joints, figures); };
  for (const char* name : {"arm", "bridge", "crane"}) {
    const bool fails = std::string(name) == "crane";
    add(name, "stock", stock, "iterative,1,engine,1", fails ? "9,fell,1" : "0.4,,1");
    add(name, "scene", stock, "exact,2,engine,1", "0.001,,0.9");
    add(name, "grid", fine, "iterative,1,engine,1", fails ? "0.1,,2.2" : "0.2,,1.8");
    add(name, "grid", thin, "iterative,1,engine,1", "0.8,fell,1.1");
    add(name, "exact", stock, "exact,1,engine,1", "0.004,,0.8");
  }
  add("arm", "grid", "240,1,8,3,on,", "iterative,1,engine,1", "0.3,,4");  // on one case alone
  add("arm", "grid", "30,2,8,3,on,", "exact,1,engine,1", "0.3,,4");       // of no kind
  for (const char* name : {"pile", "wall"}) {
    add(name, "stock", stock, "iterative,1,engine,1", "0.4,,1");
    add(name, "soft", stock, "iterative,1,soft,4", "0.1,,0.5");
  }
  return CsvTable::Parse(text, "t.csv");
}

const SolverSetting* Find(const std::vector<SolverSetting>& settings, const std::string& name) {
  for (const SolverSetting& s : settings) {
    if (s.name == name) return &s;
  }
  return nullptr;
}

TEST(SolverSpeed, TakesEachSettingOverTheCasesThatHaveJointsOrHaveNone) {
  const auto cases = ViewPhysics(Table());
  const auto jointed = SolverSettings(cases, true), others = SolverSettings(cases, false);
  const SolverSetting* fine = Find(jointed, "60 Hz, 8/3 × 2");
  ASSERT_NE(fine, nullptr);
  EXPECT_EQ(fine->kind, "engine");
  EXPECT_EQ(fine->errors, (std::vector<double>{0.5, 0.5, 0}));  // 0: stock alone fails
  EXPECT_EQ(fine->costs, (std::vector<double>{1.8, 1.8, 2.2}));
  EXPECT_EQ(fine->failed, 0);
  const SolverSetting* thin = Find(jointed, "60 Hz, 8/3 × 1, skin 0.0025 m");
  ASSERT_NE(thin, nullptr);
  EXPECT_EQ(thin->kind, "engine, thin skin");
  EXPECT_EQ(thin->failed, 3);
  EXPECT_TRUE(std::isinf(thin->errors[0]));
  ASSERT_NE(Find(jointed, "exact × 1"), nullptr);
  EXPECT_DOUBLE_EQ(Find(jointed, "exact × 1")->errors[0], 0.01);
  EXPECT_EQ(Find(jointed, "each scene's own")->kind, "each scene's own");
  EXPECT_EQ(Find(jointed, "240 Hz, 8/3 × 1"), nullptr) << "tried on fewer than half of the cases";
  EXPECT_EQ(Find(jointed, "30 Hz, 8/3 × 2"), nullptr) << "exact joints are no engine's setting";
  EXPECT_EQ(Find(jointed, "soft × 4"), nullptr);
  ASSERT_NE(Find(others, "soft × 4"), nullptr);
  EXPECT_EQ(others.size(), 2u);
}

TEST(SolverSpeed, DrawsOneDotASettingAtItsMediansAndPrintsTheSameNumbers) {
  const auto cases = ViewPhysics(Table());
  const Figure figure = SolverSpeed(cases, "make");
  ASSERT_EQ(figure.panels.size(), 2u);
  const PlotPanel& panel = figure.panels[0];
  bool drawn = false;
  for (const PlotCurve& curve : panel.curves) {
    if (curve.name != "engine") continue;
    ASSERT_EQ(curve.points.size(), 1u);
    EXPECT_EQ(curve.points[0].x, 1.8);
    EXPECT_EQ(curve.points[0].y, 0.5);
    drawn = true;
  }
  EXPECT_TRUE(drawn);
  std::string named;
  for (const Note& note : panel.notes) named += note.text + ";";
  EXPECT_NE(named.find("exact × 1"), std::string::npos) << named;
  EXPECT_EQ(named.find("8/3 × 2"), std::string::npos) << "beaten in both, so not named: " << named;
  const TextTable table = SolverSpeedTable(cases, "make");
  EXPECT_EQ(table.rows.size(), 7u);
  EXPECT_EQ(table.rows[0][1], "exact × 1") << "by rising cost";
  EXPECT_EQ(table.rows[0][5], "0.8");
}

TEST(SolverSpeed, IsLeftOutOfATableWithoutSettingsToCompare) {
  EXPECT_TRUE(SolverSpeed({}, "make").panels.empty());
}

}  // namespace solver_speed_test
}  // namespace seam
