/// The table of exact joints, from tables written by hand.

#include "tests/lab/report/joints/exact_joints.h"

#include <gtest/gtest.h>

namespace seam {
namespace exact_joints_test {

/// A row of `seam-lab physics`; the other columns are as in all rows.
std::string Row(const std::string& name, const std::string& role, const std::string& joints,
                int joint_substeps, const std::string& figures) {
  return name + ",formula,m," + role + ",60,1,8,3,on,,on,body," + joints + "," +
         std::to_string(joint_substeps) + "," + figures + ",\n";
}

CsvTable TableOf(const std::string& rows) {
  return CsvTable::Parse(
      "case,truth,unit,role,tick_hz,substeps,velocity_iterations,position_iterations,"
      "warm_starting,skin,continuous,welds,joints,joint_substeps,error,failure,penetration_m,"
      "joint_drift_m,cost_ratio,valid\n" +
          rows,
      "t.csv");
}

/// error, failure, overlap, drift, cost.
const std::string kCrane = Row("crane-grip", "stock", "iterative", 1, "2,slipped out,0,0.05,1") +
                           Row("crane-grip", "scene", "auto", 2, "0.0005,,0.004,1e-6,1.6") +
                           Row("crane-grip", "iterative", "iterative", 1, "0.002,,0,1e-3,6") +
                           Row("crane-grip", "exact", "exact", 1, "0.002,,0.02,1e-5,1.2") +
                           Row("crane-grip", "exact", "exact", 2, "0.0005,,0.004,1e-6,1.6");

std::vector<std::string> RowOf(const std::string& rows) {
  const TextTable table = ExactJointsTable(ViewPhysics(TableOf(rows)), "make");
  EXPECT_EQ(table.rows.size(), 1u);
  return table.rows.at(0);
}

TEST(ExactJoints, ARowHasErrorOverlapAndCostOfEachSettingAndTheMissedBars) {
  EXPECT_EQ(RowOf(kCrane),
            (std::vector<std::string>{"crane-grip", "m", "2, slipped out / 0 / 1", "0.002 / 0 / 6",
                                      "0.002 / 0.02 / 1.2", "5.0e-04 / 0.004 / 1.6",
                                      "≤ 0.001 / ≤ 0.01 / ≤ 1.5", "missed: cost (× 2)"}));
}

TEST(ExactJoints, OneSettingMustHoldAllOfABar) {
  const std::string better = Row("crane-grip", "exact", "exact", 4, "0.0005,,0.004,1e-6,1.5");
  EXPECT_EQ(RowOf(kCrane + better).back(), "met (× 4)");
  EXPECT_EQ(RowOf(kCrane + better)[5], "× 4: 5.0e-04 / 0.004 / 1.5");
}

TEST(ExactJoints, AFailedOrNanRunMeetsNoBar) {
  const std::string stock = Row("joint-load-hinge", "stock", "iterative", 1, "0.1,,0,0.1,1");
  const auto verdict = [&](const std::string& figures) {
    return RowOf(stock + Row("joint-load-hinge", "exact", "exact", 2, figures)).back();
  };
  EXPECT_EQ(verdict("1e-6,,0,0,2"), "met (× 2)");
  EXPECT_EQ(verdict("1e-6,came apart,0,0,2"), "missed: came apart (× 2)");
  EXPECT_EQ(verdict("inf,,0,0,2"), "missed: diverged (× 2)");
  EXPECT_EQ(verdict("1e-6,,0,0,"), "missed: cost (× 2)");
}

TEST(ExactJoints, AMissedBarRanksAboveAFailure) {
  const std::string failed = Row("crane-grip", "exact", "exact", 1, "2,slipped out,0,0,1");
  const std::string held = Row("crane-grip", "exact", "exact", 2, "0.1,,0.5,0,9");
  EXPECT_EQ(RowOf(failed + held).back(), "missed: error, overlap, cost (× 2)");
}

TEST(ExactJoints, DriftIsTheErrorOfMechanismsThatAreJudgedOtherwise) {
  const std::string rows = Row("scissor-lift", "stock", "iterative", 1, "20,,0,0.5,1") +
                           Row("scissor-lift", "exact", "exact", 1, "0.004,,0.001,5e-6,1");
  EXPECT_EQ(RowOf(rows)[2], "0.5 / 0 / 1");
  EXPECT_EQ(RowOf(rows).back(), "met (× 1)");
}

TEST(ExactJoints, WithoutABarOfItsOwnStockIsTheBar) {
  const std::string stock = Row("ragdoll-pile-impact", "stock", "iterative", 1, "0.2,,0,0,1");
  const auto verdict = [&](const char* error) {
    return RowOf(stock +
                 Row("ragdoll-pile-impact", "exact", "exact", 2, std::string(error) + ",,0,0,1"))
        .back();
  };
  EXPECT_EQ(verdict("0.2"), "met (× 2)");
  EXPECT_EQ(verdict("0.21"), "missed: error (× 2)");
}

TEST(ExactJoints, WithoutJointsTheSceneItselfIsJudged) {
  const std::string rows = Row("disc-box-x4", "stock", "iterative", 1, "0.06,,0,0,1") +
                           Row("disc-box-x4", "scene", "iterative", 1, "0.03,,0,0,3");
  EXPECT_EQ(RowOf(rows).back(), "missed: error (no joints)");
}

TEST(ExactJoints, TheSummaryTakesTheCheapestSettingThatIsNoWorse) {
  const std::string rows = kCrane + Row("tower-10", "stock", "iterative", 1, "0.01,,0,0,1") +
                           Row("tower-10", "scene", "iterative", 1, "0.005,,0,0,0.6") +
                           Row("tower-10", "grid", "iterative", 1, "0.02,,0,0,0.1");
  const CsvTable overhead = CsvTable::Parse("scene,ratio\na,1.01\nb,1.02\nc,1.2\n", "o.csv");
  const TextTable table = ExactJointsSummary(ViewPhysics(TableOf(rows)), &overhead, "make");
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_EQ(table.rows[0][1], "0.6 (0.6–1.6)");
  EXPECT_EQ(table.rows[1][1], "0.6 (0.6–6)");
  EXPECT_EQ(table.rows[2][1], "0.6 (0.6–1.2)");
  EXPECT_EQ(table.rows[2][3], "missed");
  EXPECT_EQ(table.rows[3][1], "1.02 (1.01–1.2)");
  EXPECT_EQ(table.rows[3][3], "met");
  EXPECT_NE(table.note.find("no better and dearer: none."), std::string::npos) << table.note;
}

TEST(ExactJoints, NamesTheCasesThatExactJointsLose) {
  const std::string rows = Row("joint-grid", "stock", "iterative", 1, "0.4,,0,0,1") +
                           Row("joint-grid", "scene", "auto", 2, "0.02,,0,0,3") +
                           Row("joint-grid", "iterative", "iterative", 1, "0.01,,0,0,1");
  const TextTable table = ExactJointsSummary(ViewPhysics(TableOf(rows)), nullptr, "make");
  EXPECT_NE(table.note.find("joint-grid"), std::string::npos) << table.note;
  EXPECT_EQ(table.rows[3][3], "not measured");
}

}  // namespace exact_joints_test
}  // namespace seam
