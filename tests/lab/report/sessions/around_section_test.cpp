/// The report's curves around one event, from a table as seam-measure writes it.

#include "tests/lab/report/sessions/around_section.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "common/base/check.h"
#include "common/measure/around/around.h"
#include "tests/support/program.h"

namespace seam {
namespace around_section_test {

TEST(AroundSection, LaysACurveForEachMethodOverTheOthersAtItsEvent) {
  const Workspace folder;
  folder.Write("wall.csv", AroundCsv({{"fade", "contact", 60, 60, -1, {0, 0.2, 0.4}},
                                      {"rollback", "contact", 66, 60, -1, {0.01, 0.02}}}));
  const Section section = AroundSection(folder.path());
  ASSERT_EQ(section.items.size(), 1u);
  const Figure& figure = std::get<Figure>(section.items[0]);
  EXPECT_EQ(figure.name, "around-wall");
  EXPECT_EQ(figure.scene, "wall");
  ASSERT_EQ(figure.panels.size(), 1u);
  const PlotPanel& panel = figure.panels[0];
  ASSERT_EQ(panel.curves.size(), 2u);
  EXPECT_EQ(panel.curves[0].name, "fade");
  ASSERT_EQ(panel.curves[0].points.size(), 3u);
  EXPECT_NEAR(panel.curves[0].points[2].x, 1.0 / 60, 1e-4);
  EXPECT_EQ(panel.curves[0].points[2].y, 0.4);
  EXPECT_EQ(panel.curves[1].points[1].x, 0) << "its own event, though 6 ticks later";
  ASSERT_EQ(panel.uprights.size(), 1u);
  EXPECT_EQ(panel.uprights[0].y, 0);
  EXPECT_EQ(panel.uprights[0].name, "contact");
}

TEST(AroundSection, IsEmptyWithoutAFolderAndRefusesOtherTables) {
  EXPECT_TRUE(AroundSection("/nowhere").items.empty());
  const Workspace folder;
  folder.Write("wall.csv", "a,b\n1,2\n");
  EXPECT_THROW(AroundSection(folder.path()), OperatorError);
}

}  // namespace around_section_test
}  // namespace seam
