/// seam-lab report: a dot for each method.

#include <gtest/gtest.h>

#include <variant>

#include "tests/lab/report/dots.h"
#include "tests/lab/report/sweep_section.h"

namespace seam {
namespace lab_dots_test {

/// Two methods with `seen`, one of them without valid runs in one column.
TEST(Dots, EachMethodIsADotAgainstItsBytesAndItsCpu) {
  std::string csv =
      "scene,mode,reconcile,impair,drive,seed,error_rms_m,error_others_m,seen,bytes_per_s,cpu_s,"
      "duration_s\n";
  for (const int seed : {1, 2, 3}) {
    const std::string s = std::to_string(seed);
    csv += "wall,buffer,rollback,demo,bot," + s + ",0.01,0.01,0.0" + s + ",900" + s + ",1,6\n";
    csv += "wall,central,all,demo,bot," + s + ",0.02,0.02,0.1" + s + ",500" + s + ",0.5,6\n";
    csv += "wall,strict,,demo,bot," + s + ",,,,,0.1,6\n";
  }
  Sweep sweep{"must", "make report", CsvTable::Parse(csv, "must.csv"), {}};
  sweep.view = ViewSweep(sweep.table);
  const Figure* dots = nullptr;
  const Section section = SweepSection(sweep);
  for (const auto& item : section.items) {
    const auto* figure = std::get_if<Figure>(&item);
    if (figure != nullptr && figure->name == "must-wall-bot-dots") dots = figure;
  }
  ASSERT_NE(dots, nullptr);
  ASSERT_EQ(dots->panels.size(), 4u);
  const PlotPanel& seen = dots->panels[0];
  EXPECT_EQ(seen.x.label, MeasureNamed("bytes").Label());
  EXPECT_EQ(seen.y.label, MeasureNamed("seen").Label());
  ASSERT_EQ(seen.curves.size(), 2u);
  EXPECT_EQ(seen.notes[0].text, "central/all");
  EXPECT_NEAR(seen.curves[0].points[0].y, 0.12, 1e-9);
  EXPECT_NEAR(seen.curves[1].points[0].y, 0.02, 1e-9);
  EXPECT_NE(dots->caption.find("Without valid runs: strict"), std::string::npos) << dots->caption;
}

}  // namespace lab_dots_test
}  // namespace seam
