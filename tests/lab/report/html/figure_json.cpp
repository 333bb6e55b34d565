#include "tests/lab/report/html/figure_json.h"

#include <fmt/format.h>

#include <cmath>

#include "common/base/json_text.h"

namespace seam {
namespace {

std::string Number(double value) {
  return std::isfinite(value) ? fmt::format("{:.6g}", value) : "null";
}

/// "[a,b,...]" of what `each` makes of every item.
template <typename Items, typename Each>
std::string List(const Items& items, const Each& each) {
  std::string out;
  for (const auto& item : items) out += (out.empty() ? "" : ",") + each(item);
  return "[" + out + "]";
}

std::string AxisJson(const Axis& axis) {
  return fmt::format(R"({{"label":{},"log":{},"tics":{},"names":{},"inf":{},"zero":{}}})",
                     JsonText(axis.label), axis.log, List(axis.tics, Number),
                     List(axis.names, JsonText), JsonText(axis.at_infinity),
                     JsonText(axis.at_zero));
}

std::string CurveJson(const PlotCurve& curve) {
  const Look& look = curve.look;
  const std::string points = List(curve.points, [](const PlotPoint& p) {
    std::string text = "[" + Number(p.x) + "," + Number(p.y);
    if (p.low != p.high) text += "," + Number(p.low) + "," + Number(p.high);
    return text + "]";
  });
  return fmt::format(R"({{"name":{},"colour":{},"dash":{},"width":{:g},"point":{},"p":{}}})",
                     JsonText(curve.name), JsonText(look.colour), JsonText(look.dash), look.width,
                     look.point, points);
}

std::string LevelJson(const Level& level) {
  return "[" + Number(level.y) + "," + JsonText(level.name) + "]";
}

std::string PanelJson(const PlotPanel& panel) {
  const std::string notes = List(panel.notes, [](const Note& note) {
    return "[" + Number(note.x) + "," + Number(note.y) + "," + JsonText(note.text) + "]";
  });
  return fmt::format(R"({{"x":{},"y":{},"curves":{},"levels":{},"uprights":{},"notes":{}}})",
                     AxisJson(panel.x), AxisJson(panel.y), List(panel.curves, CurveJson),
                     List(panel.levels, LevelJson), List(panel.uprights, LevelJson), notes);
}

}  // namespace

std::string FigureJson(const Figure& figure) {
  return fmt::format(R"({{"columns":{},"width":{},"height":{},"left":{},"panels":{}}})",
                     figure.columns, figure.panel_width_px, figure.panel_height_px, figure.left_px,
                     List(figure.panels, PanelJson));
}

}  // namespace seam
