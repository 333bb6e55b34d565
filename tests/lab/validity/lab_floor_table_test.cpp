/// The report's table of floors, and errors as multiples of the error of held inputs.

#include <gtest/gtest.h>

#include "tests/lab/report/sweep_section.h"

namespace seam {
namespace lab_floor_table_test {

Sweep SweepOf(const std::string& rows) {
  CsvTable table = CsvTable::Parse(
      "version,scene,mode,reconcile,impair,drive,seed,error_others_m,error_rms_m,error_max_m,"
      "floor_m,floor_wire_m,floor_barrier_m,info_limit_m,oracle,valid\n" +
          rows,
      "t.csv");
  SweepView view = ViewSweep(table);
  return {"t", "", std::move(table), std::move(view)};
}

/// Two methods within twice the wire's floor of 0.2 m, one beyond; and the oracle's own row.
const char* const kRows =
    "v,wall.toml,buffer,fade,demo,script,1,0.3,9,9,0.1,0.2,0.05,0.25,plain,\n"
    "v,wall.toml,buffer,snap,demo,script,1,0.4,9,9,0.1,0.2,0.05,0.25,plain,\n"
    "v,wall.toml,strict,,demo,script,1,5,9,9,0.1,0.2,0.05,0.25,plain,\n";
const char* const kOracleRow = "v,wall.toml,oracle,,perfect,script,1,0,0,0,0.1,0.2,0.05,,plain,\n";

TEST(FloorTable, HasAScenesFloorsAndTheMethodsThatChaosMakesEqual) {
  const TextTable table = FloorTable({SweepOf(kRows), SweepOf(kOracleRow)});
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.rows[0],
            (std::vector<std::string>{"wall", "0", "0.1", "0.2", "0.05", "0.25", "fade, snap"}));
}

TEST(FloorTable, OneMethodNearTheFloorDiffersFromTheOthers) {
  const TextTable table =
      FloorTable({SweepOf("v,wall.toml,buffer,fade,demo,script,1,0.3,9,9,0.1,0.2,0.05,0.25,plain,\n"
                          "v,wall.toml,strict,,demo,script,1,0.5,9,9,0.1,0.2,0.05,0.25,plain,\n")});
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.rows[0].back(), "–");
  EXPECT_EQ(table.rows[0][1], "–") << "mode oracle was not run";
}

TEST(FloorTable, WithoutFloorsHasNoRows) {
  EXPECT_TRUE(FloorTable({SweepOf("v,wall.toml,buffer,fade,demo,script,1,0.3,9,9,,,,,plain,\n")})
                  .rows.empty());
  EXPECT_TRUE(FloorTable({}).rows.empty());
}

TEST(HeldInputs, IsATableOfMultiplesIfASweepHasIt) {
  const Sweep sweep = SweepOf(kRows);
  EXPECT_DOUBLE_EQ(LimitMeasure().value(sweep.table, 0).value(), 0.3 / 0.25);
  EXPECT_DOUBLE_EQ(LimitMeasure().value(sweep.table, 2).value(), 20);
  EXPECT_FALSE(LimitMeasure().value(SweepOf(kOracleRow).table, 0).has_value());
  const Sweep latencies = SweepOf(
      "v,wall.toml,buffer,fade,delay=20ms,script,1,0.3,9,9,0.1,0.2,0.05,0.25,plain,\n"
      "v,wall.toml,buffer,fade,delay=40ms,script,1,0.4,9,9,0.1,0.2,0.05,0.25,plain,\n");
  int tables = 0;
  for (const PageItem& item : SweepSection(latencies).items) {
    const auto* table = std::get_if<TextTable>(&item);
    tables += table != nullptr && table->name == "t-wall-limit" ? 1 : 0;
  }
  EXPECT_EQ(tables, 1);
}

}  // namespace lab_floor_table_test
}  // namespace seam
