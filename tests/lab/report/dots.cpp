#include "tests/lab/report/dots.h"

#include <fmt/format.h>

#include "tests/lab/report/method_look.h"

namespace seam {
namespace {

/// Adds a dot and its name for each method that has both measures; names the others in `without`.
PlotPanel DotsPanel(const Sweep& sweep, const SweepGroup& group, double x, const SweepMeasure& cost,
                    const SweepMeasure& error, std::string* without) {
  PlotPanel panel;
  panel.x.label = cost.Label();
  panel.y.label = error.Label();
  panel.y.log = error.log;
  without->clear();
  for (const std::string& method : group.methods) {
    const auto found = group.runs.at(method).find(x);
    if (found == group.runs.at(method).end()) continue;
    const auto price = QuartilesOf(sweep.table, cost, found->second);
    const auto value = QuartilesOf(sweep.table, error, found->second);
    if (!price || !value) {
      *without += (without->empty() ? "" : ", ") + method;
      continue;
    }
    PlotCurve dot;
    dot.look = MethodLook(method);
    dot.look.width = 0;
    dot.look.size = 1.2;
    dot.points.push_back({price->median, value->median, value->low, value->high});
    panel.curves.push_back(std::move(dot));
    panel.notes.push_back({price->median, value->median, method, false, 0});
  }
  return panel;
}

}  // namespace

Figure DotsOf(const Sweep& sweep, const SweepGroup& group) {
  const double x = group.xs[group.xs.size() / 2];
  Figure figure;
  figure.name =
      sweep.name + '-' + group.scene + (group.drive == "script" ? "" : '-' + group.drive) + "-dots";
  figure.title = fmt::format("{}{}: each method's place", group.scene,
                             group.drive == "bot" ? ", bots drive" : "");
  figure.columns = 2;
  figure.panel_width_px = 560;
  figure.panel_height_px = 400;
  std::string without;
  for (const char* error : {"seen", HeadlineOf(sweep).id.c_str()}) {
    for (const char* cost : {"bytes", "cpu"}) {
      PlotPanel panel =
          DotsPanel(sweep, group, x, MeasureNamed(cost), MeasureNamed(error), &without);
      if (panel.curves.size() < 2) continue;
      SpreadNotes(figure.panel_width_px - 92, figure.panel_height_px - 82, &panel);
      figure.panels.push_back(std::move(panel));
    }
  }
  figure.caption = fmt::format(
      "Medians with quartiles at {} {:g}{}{}. Left and below is better. {}", sweep.view.axis.name,
      x, sweep.view.axis.unit.empty() ? "" : " ", sweep.view.axis.unit, sweep.view.fixed);
  if (!without.empty()) figure.caption += ". Without valid runs: " + without;
  figure.command = sweep.command;
  return figure;
}

}  // namespace seam
