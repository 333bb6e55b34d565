/// Notes of a plot, by geometry: none covers a point or another note.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/lab/report/figure.h"

namespace seam {
namespace spread_notes_test {

struct Area {
  double left, bottom, right, top;
  bool Meets(const Area& o) const {
    return left < o.right && o.left < right && bottom < o.top && o.bottom < top;
  }
};

/// A panel with a cloud of points, and a note at every second one.
PlotPanel Cloud(bool log_x, bool log_y) {
  PlotPanel panel;
  panel.x.log = log_x;
  panel.y.log = log_y;
  PlotCurve curve;
  curve.look.size = 0.8;
  for (int i = 0; i < 40; ++i) {
    const double x = 1 + 0.1 * (i % 8), y = std::pow(10, i % 5) * (1 + 0.2 * (i % 3));
    curve.points.push_back({x, y, y / 10, y * 1000});  // bars reach beyond the points
    if (i % 2 == 0) panel.notes.push_back({x, y, "setting × " + std::to_string(i), false, 0});
  }
  panel.curves.push_back(curve);
  panel.uprights.push_back({0.1, ""});
  return panel;
}

TEST(SpreadNotes, NoNoteCoversAPointOrAnotherNote) {
  const double width = 468, height = 378;
  for (const bool log_x : {false, true}) {
    for (const bool log_y : {false, true}) {
      PlotPanel panel = Cloud(log_x, log_y);
      SpreadNotes(width, height, &panel);
      EXPECT_GE(panel.notes.size(), log_y ? 8u : 3u) << "those that have a place";
      const PlotRanges ranges = RangesOf(panel);
      const auto place = [](const PlotRange& r, double v, bool log, double size) {
        const auto way = [&](double value) { return log ? std::log(value) : value; };
        return (way(v) - way(r.low)) / (way(r.high) - way(r.low)) * size;
      };
      std::vector<Area> taken;
      for (const PlotPoint& p : panel.curves[0].points) {
        const double x = place(ranges.x, p.x, log_x, width);
        const double y = place(ranges.y, p.y, log_y, height);
        taken.push_back({x - 4, y - 4, x + 4, y + 4});
      }
      for (const Note& note : panel.notes) {
        const double length = 6 * static_cast<double>(note.text.size() - 1);  // × has two bytes
        const double x = place(ranges.x, note.x, log_x, width);
        const double y = place(ranges.y, note.y, log_y, height) + note.lift_px;
        const double left = note.left ? x - 8 - length : x + 8;
        const Area area = {left, y - 5, left + length, y + 5};
        for (const Area& other : taken) EXPECT_FALSE(area.Meets(other)) << note.text;
        EXPECT_GT(area.left, 0);
        EXPECT_LT(area.right, width);
        taken.push_back(area);
      }
    }
  }
}

}  // namespace spread_notes_test
}  // namespace seam
