#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/lab/report/figure.h"

namespace seam {
namespace {

constexpr double kNotePx = 12;     ///< height of a line of text
constexpr double kLetterPx = 6.2;  ///< width of a letter in the mean
constexpr double kPointPx = 5;     ///< half of a point's size
constexpr int kAttempts = 22;      ///< places that are tried, by turns right and left

/// Pixels inside a panel, from its lower left corner.
struct Box {
  double left, bottom, right, top;
  bool Meets(const Box& o) const {
    return left < o.right && o.left < right && bottom < o.top && o.bottom < top;
  }
};

double Pixel(const PlotRange& range, double value, bool log, double size) {
  const double at = PlaceOn(range, value, log);
  if (log) return std::log(at / range.low) / std::log(range.high / range.low) * size;
  return (at - range.low) / (range.high - range.low) * size;
}

std::size_t Letters(const std::string& text) {  // of UTF-8
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  }));
}

}  // namespace

void SpreadNotes(double width_px, double height_px, PlotPanel* panel) {
  const PlotRanges ranges = RangesOf(*panel);
  const auto x_of = [&](double v) { return Pixel(ranges.x, v, panel->x.log, width_px); };
  const auto y_of = [&](double v) { return Pixel(ranges.y, v, panel->y.log, height_px); };
  std::vector<Box> taken;
  for (const PlotCurve& curve : panel->curves) {
    for (const PlotPoint& point : curve.points) {
      const double x = x_of(point.x), y = y_of(point.y), half = kPointPx * curve.look.size;
      taken.push_back({x - half, y - half, x + half, y + half});
    }
  }
  for (Note& note : panel->notes) {
    const double x = x_of(note.x), y = y_of(note.y);
    const double length = kLetterPx * static_cast<double>(Letters(note.text));
    bool placed = false;
    for (int attempt = 0; attempt < kAttempts && !placed; ++attempt) {
      const bool left = attempt % 2 == 1;
      const int step = (attempt / 2 + 1) / 2 * (attempt / 2 % 2 == 1 ? 1 : -1);
      const double begin = left ? x - kBesidePx - length : x + kBesidePx;
      const double at = y + step * kNotePx;
      const Box box = {begin, at - kNotePx / 2, begin + length, at + kNotePx / 2};
      const bool inside =
          box.left > 0 && box.right < width_px && box.bottom > 0 && box.top < height_px;
      const bool meets = std::any_of(taken.begin(), taken.end(),
                                     [&](const Box& other) { return box.Meets(other); });
      if (!inside || meets) continue;
      note.left = left;
      note.lift_px = step * kNotePx;
      taken.push_back(box);
      placed = true;
    }
    if (!placed) note.text.clear();  // the table has it
  }
  panel->notes.erase(std::remove_if(panel->notes.begin(), panel->notes.end(),
                                    [](const Note& note) { return note.text.empty(); }),
                     panel->notes.end());
}

}  // namespace seam
