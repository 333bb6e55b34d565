#include "render/draw/draw_strip.h"

#include <algorithm>
#include <cmath>

#include "render/canvas/palette.h"
#include "render/playback/format.h"

namespace seam {
namespace {

constexpr double kLowDecade = -3;  ///< log10 m: the base line is a millimetre

/// The plot area and its two scales.
struct Axes {
  Rect plot;
  double from_s = 0, to_s = 1;
  double high_decade = 0;

  float X(double s) const {
    return plot.x + plot.width * static_cast<float>((s - from_s) / (to_s - from_s));
  }
  float Y(double metres) const {
    const double decade = std::log10(std::max(metres, 1e-9));
    const double share = std::clamp((decade - kLowDecade) / (high_decade - kLowDecade), 0.0, 1.0);
    return plot.bottom() - plot.height * static_cast<float>(share);
  }
};

double HighDecade(const std::vector<Curve>& curves) {
  double most = 0.05;
  for (const Curve& curve : curves)
    for (double e : *curve.errors_m) most = std::max(most, e);
  return std::min(std::ceil(std::log10(most) - 1e-9), 4.0);
}

void DrawDecades(DrawList& list, const Axes& axes) {
  const float scale = list.font().scale();
  for (double decade = kLowDecade; decade <= axes.high_decade; ++decade) {
    const float y = std::floor(axes.Y(std::pow(10.0, decade))) + 0.5f;
    list.Stroke({{axes.plot.x, y}, {axes.plot.right(), y}}, false,
                {1, decade == kLowDecade ? kFrame : kGrid, 0});
    if (axes.high_decade - kLowDecade > 4 && std::fmod(decade - kLowDecade, 2) != 0) continue;
    static const char* const kLengthNames[] = {"1 mm", "1 cm",  "10 cm", "1 m",
                                               "10 m", "100 m", "1 km",  "10 km"};
    list.Text(axes.plot.x - 6 * scale, y + 4 * scale, TextStyle::kSmall,
              kLengthNames[static_cast<int>(decade - kLowDecade)], kFaintInk, Align::kRight);
  }
}

void DrawSeconds(DrawList& list, const Axes& axes) {
  const float scale = list.font().scale();
  const double least = (axes.to_s - axes.from_s) * 70 * scale / std::max(axes.plot.width, 1.0f);
  double step = std::pow(10.0, std::floor(std::log10(least)));
  for (double factor : {1.0, 2.0, 5.0, 10.0})
    if (factor * step >= least) {
      step *= factor;
      break;
    }
  for (double k = std::ceil(axes.from_s / step - 1e-9); k * step <= axes.to_s + 1e-9; ++k) {
    const float x = std::floor(axes.X(k * step)) + 0.5f;
    list.Stroke({{x, axes.plot.bottom()}, {x, axes.plot.bottom() + 4 * scale}}, false,
                {1, kGroundEdge, 0});
    list.Text(x, axes.plot.bottom() + 15 * scale, TextStyle::kSmall,
              FormatNumber(k * step + 0.0, step < 0.95 ? 1 : 0) + " s", kFaintInk, Align::kCentre);
  }
}

/// Returns the curve as one point per pixel column, the greatest error of the column's ticks; in
/// pieces, with gaps where errors are unknown.
std::vector<std::vector<Vec2>> Pieces(const Axes& axes, const Curve& curve) {
  std::vector<std::vector<Vec2>> pieces;
  const auto& errors = *curve.errors_m;
  float last_column = -1;
  bool known = false;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double s =
        (static_cast<double>(curve.first_tick) + static_cast<double>(i)) / curve.tick_hz;
    if (s < axes.from_s - 1e-9 || s > axes.to_s + 1e-9) continue;
    const bool before = known;
    known = !std::isnan(errors[i]);
    if (!known) continue;
    if (!before) pieces.emplace_back();
    std::vector<Vec2>& points = pieces.back();
    const float x = axes.X(s), y = axes.Y(errors[i]);
    if (before && std::floor(x) == last_column) {
      points.back().y() = std::min(points.back().y(), y);
      continue;
    }
    last_column = std::floor(x);
    points.emplace_back(x, y);
  }
  return pieces;
}

/// Leaves out points within a tenth of a pixel of a straight line. x increases, so the allowed
/// slopes of a line from the last kept point are an interval, which each left-out point narrows.
std::vector<Vec2> Thinned(const std::vector<Vec2>& points) {
  constexpr float kOff = 0.1f, kAny = 1e9f;  // px
  std::vector<Vec2> kept{points.front()};
  float low = -kAny, high = kAny;
  for (std::size_t i = 1; i < points.size(); ++i) {
    Vec2 way = points[i] - kept.back();
    if (way.y() < low * way.x() || way.y() > high * way.x()) {
      kept.push_back(points[i - 1]);
      way = points[i] - kept.back();
      low = -kAny;
      high = kAny;
    }
    low = std::max(low, (way.y() - kOff) / way.x());
    high = std::min(high, (way.y() + kOff) / way.x());
  }
  if (points.size() > 1) kept.push_back(points.back());
  return kept;
}

/// Returns the part of a line up to `x`; it may be empty.
std::vector<Vec2> UpTo(const std::vector<Vec2>& points, float x) {
  const auto after =
      std::find_if(points.begin(), points.end(), [&](const Vec2& point) { return point.x() > x; });
  std::vector<Vec2> past(points.begin(), after);
  if (past.empty() || after == points.end()) return past;
  const Vec2 way = *after - past.back();
  past.push_back(past.back() + way * ((x - past.back().x()) / way.x()));
  return past;
}

void DrawPart(DrawList& list, const Axes& axes, const Curve& curve, const std::vector<Vec2>& points,
              bool past, bool filled) {
  const Colour under = Faded(curve.colour, past ? 0.16f : 0.07f);
  for (std::size_t i = 1; filled && i < points.size(); ++i) {
    const Vec2 quad[4] = {points[i - 1],
                          points[i],
                          {points[i].x(), axes.plot.bottom()},
                          {points[i - 1].x(), axes.plot.bottom()}};
    list.FillShaded(quad, under, under);
  }
  list.Stroke(points, false,
              {(curve.bold ? 1.8f : 1.1f) * list.font().scale(),
               Faded(curve.colour, past ? 1.0f : 0.35f), 0});
}

Axes AxesOf(const Rect& area, float scale, const std::vector<Curve>& curves,
            const StripLook& look) {
  Axes axes;
  axes.plot = {area.x + 48 * scale, area.y + 22 * scale, area.width - 60 * scale,
               area.height - 42 * scale};
  axes.from_s = look.from_s;
  axes.to_s = std::max(look.to_s, look.from_s + 1e-3);
  axes.high_decade = HighDecade(curves);
  return axes;
}

/// Draws the curves. `past`: strong, up to the playhead; else pale, in full length.
void DrawCurves(DrawList& list, const Rect& area, const Axes& axes,
                const std::vector<Curve>& curves, const StripLook& look, bool past) {
  const Rect clip{axes.plot.x - 1, area.y, axes.plot.width + 2, area.height};
  list.Clip(clip);
  for (const Curve& curve : curves) {
    for (const std::vector<Vec2>& points : Pieces(axes, curve)) {
      const std::vector<Vec2> all = Thinned(points);
      DrawPart(list, axes, curve, past ? UpTo(all, axes.X(look.now_s) + 0.5f) : all, past,
               curves.size() == 1);
    }
  }
  list.NoClip();
}

void DrawNow(DrawList& list, const Axes& axes, const std::vector<Curve>& curves,
             const StripLook& look) {
  const float scale = list.font().scale();
  const float x = std::floor(axes.X(look.now_s)) + 0.5f;
  list.Stroke({{x, axes.plot.y - 2 * scale}, {x, axes.plot.bottom() + 1}}, false,
              {1.2f * scale, kInk, 0});
  const float tip = axes.plot.y + 3 * scale, wing = 4 * scale;
  list.Fill({{x - wing, tip - 6 * scale}, {x + wing, tip - 6 * scale}, {x, tip}}, kInk);
  for (const Curve& curve : curves) {
    const auto i =
        static_cast<std::int64_t>(std::floor(look.now_s * curve.tick_hz + 1e-6)) - curve.first_tick;
    if (i < 0 || i >= static_cast<std::int64_t>(curve.errors_m->size()) || !curve.bold) continue;
    const double error = (*curve.errors_m)[static_cast<std::size_t>(i)];
    if (std::isnan(error)) continue;
    const Vec2 at(x, axes.Y(error));
    list.Disc(at, 4.5f * scale, kPanel);
    list.Disc(at, 3.2f * scale, curve.colour);
  }
}

}  // namespace

void DrawStrip(DrawList& list, const Rect& area, const std::vector<Curve>& curves,
               const StripLook& look) {
  const float scale = list.font().scale();
  const Axes axes = AxesOf(area, scale, curves, look);
  list.FillRect(axes.plot, kPanel);
  DrawDecades(list, axes);
  DrawSeconds(list, axes);
  const std::string title = curves.empty()
                                ? "error: unknown without an oracle"
                                : "error against the oracle at the tick shown, RMS, log scale";
  float x = axes.plot.x;
  const float base = area.y + 12 * scale;
  x += list.Text(x, base, TextStyle::kSmall, title, kFaintInk) + 22 * scale;
  for (const Curve& curve : curves) {
    if (curve.label.empty()) continue;
    list.FillRect({x, base - 5 * scale, 16 * scale, (curve.bold ? 3.0f : 1.5f) * scale},
                  curve.colour);
    x += 22 * scale;
    x += list.Text(x, base, TextStyle::kSmall, curve.label, kInk) + 18 * scale;
  }
  DrawCurves(list, area, axes, curves, look, false);
}

void DrawStripNow(DrawList& list, const Rect& area, const std::vector<Curve>& curves,
                  const StripLook& look) {
  const Axes axes = AxesOf(area, list.font().scale(), curves, look);
  DrawCurves(list, area, axes, curves, look, true);
  DrawNow(list, axes, curves, look);
}

}  // namespace seam
