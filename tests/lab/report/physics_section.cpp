#include "tests/lab/report/physics_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tests/lab/report/joints/solver_speed.h"

namespace seam {
namespace {

constexpr const char* kStockColour = "#000000";
constexpr const char* kSceneColour = "#d55e00";

/// Grid settings by rate: from few ticks a second, pale, to many, dark.
struct Rate {
  double up_to_hz;
  const char* name;
  const char* colour;
};
constexpr std::array<Rate, 4> kRates = {{{30, "30 Hz", "#a6cee3"},
                                         {60, "60 Hz", "#56b4e9"},
                                         {120, "120 Hz", "#0072b2"},
                                         {1e9, "240 Hz", "#08306b"}}};

/// Ratios below are drawn as zero: what a formula gives to rounding would leave no room for the
/// rest.
constexpr double kRatioMin = 1e-4;
constexpr const char* kRatioMinText = "< 10⁻⁴";

double ShownRatio(const PhysicsCase& c) {
  const double ratio = ErrorRatio(*c.scene, *c.stock);
  return ratio < kRatioMin ? 0 : ratio;
}

PlotCurve PointsOnly(const std::string& name, const std::string& colour, int point, double size) {
  return {name, {colour, "solid", 0, point, size}, {}};
}

PlotPoint At(const PhysicsRun& run) { return {run.cost_ratio, run.error, run.error, run.error}; }

PlotCurve FrontCurve(const std::vector<PhysicsRun>& runs) {
  PlotCurve front;
  front.name = "front";
  front.look = {"#f3c9a9", "solid", 6, 0, 0};
  for (const std::size_t i : ParetoFront(PhysicsTrials(runs))) {
    if (!front.points.empty()) {
      const double before = front.points.back().y;
      front.points.push_back({runs[i].cost_ratio, before, before, before});
    }
    front.points.push_back(At(runs[i]));
  }
  return front;
}

}  // namespace

Figure WorkPrecision(const PhysicsCase& c, const std::string& command) {
  Figure figure;
  figure.name = "case-" + c.name;
  std::replace(figure.name.begin(), figure.name.end(), '_', '-');
  figure.title = c.name;
  figure.command = command;
  figure.panel_width_px = 560;
  figure.panel_height_px = 380;
  figure.small = true;
  PlotPanel panel;
  panel.x = {"CPU time, ratio to stock measured beside it", true, {}, "crashed", "0", {}};
  panel.y = {fmt::format("error ({}; {})", c.unit, c.truth), true, {}, "diverged", "0", {}};
  panel.uprights.push_back({1, ""});
  panel.curves.push_back(FrontCurve(c.all));
  for (std::size_t i = 0; i < kRates.size(); ++i) {
    PlotCurve warm = PointsOnly(kRates[i].name, kRates[i].colour, 7, 0.75);
    PlotCurve cold = PointsOnly("", kRates[i].colour, 6, 0.75);
    for (const PhysicsRun& run : c.all) {
      const double above = i == 0 ? 0 : kRates[i - 1].up_to_hz;
      if (run.tick_hz <= above || run.tick_hz > kRates[i].up_to_hz) continue;
      (run.warm ? warm : cold).points.push_back(At(run));
    }
    if (warm.points.empty()) cold.name = warm.name;
    for (PlotCurve* curve : {&warm, &cold}) {
      if (!curve->points.empty()) panel.curves.push_back(std::move(*curve));
    }
  }
  PlotCurve failed = PointsOnly("failed", "#c41e3a", 2, 0.9);
  for (const PhysicsRun& run : c.all) {
    if (!run.held()) failed.points.push_back(At(run));
  }
  if (!failed.points.empty()) panel.curves.push_back(std::move(failed));
  const auto mark = [&](const std::optional<PhysicsRun>& run, const char* name, const char* colour,
                        int point, double size) {
    if (!run) return;
    PlotCurve curve = PointsOnly(name, colour, point, size);
    curve.points.push_back(At(*run));
    panel.curves.push_back(std::move(curve));
  };
  mark(c.stock, "stock", kStockColour, 4, 1.6);
  mark(c.scene, "scene's own", kSceneColour, 12, 2.0);
  figure.panels.push_back(std::move(panel));
  const auto says = [](const std::optional<PhysicsRun>& run) {
    if (!run) return std::string("not measured");
    return Digits(run->error) + (run->held() ? "" : " (" + run->failure + ")");
  };
  figure.caption = fmt::format(
      "{} settings, open circles without warm starting. Stock: {}. The scene's own ({}): {}, at {} "
      "× the cost.",
      c.all.size(), says(c.stock), c.scene ? c.scene->setting : "none", says(c.scene),
      c.scene ? Digits(c.scene->cost_ratio) : "–");
  return figure;
}

Figure PhysicsList(const std::vector<PhysicsCase>& cases, const std::string& command) {
  std::vector<const PhysicsCase*> order;
  for (const PhysicsCase& c : cases) {
    if (c.stock && c.scene) order.push_back(&c);
  }
  std::stable_sort(order.begin(), order.end(), [](const PhysicsCase* a, const PhysicsCase* b) {
    return ErrorRatio(*a->scene, *a->stock) < ErrorRatio(*b->scene, *b->stock);
  });
  PlotPanel panel;
  panel.x = {"ratio to stock: left of the line is better", true, {}, "fails", kRatioMinText, {}};
  panel.uprights.push_back({1, ""});
  PlotCurve error = PointsOnly("error", kSceneColour, 7, 0.9);
  PlotCurve rescued = PointsOnly("error; stock fails", "#0072b2", 9, 1.0);
  PlotCurve cost = PointsOnly("CPU time", kStockColour, 4, 0.9);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const PhysicsCase& c = *order[i];
    const auto y = static_cast<double>(i);
    panel.y.names.push_back(c.name);
    const PlotPoint point = {ShownRatio(c), y, y, y};
    (c.stock->held() || !c.scene->held() ? error : rescued).points.push_back(point);
    cost.points.push_back({c.scene->cost_ratio, y, y, y});
  }
  for (PlotCurve* curve : {&cost, &error, &rescued}) panel.curves.push_back(std::move(*curve));
  Figure figure;
  figure.name = "hard-cases-list";
  figure.title = "Hard cases: error and CPU time of each scene's own setting";
  figure.caption = "The same by name, by falling gain.";
  figure.command = command;
  figure.panel_width_px = 1100;
  figure.panel_height_px = 100 + 16 * static_cast<int>(order.size());
  figure.left_px = 190;
  figure.panels.push_back(std::move(panel));
  return figure;
}

Figure PhysicsSummary(const std::vector<PhysicsCase>& cases, const std::string& command) {
  Figure figure;
  figure.name = "hard-cases";
  figure.title = "Hard cases: each scene's own setting against stock";
  figure.command = command;
  figure.panel_width_px = 1100;
  figure.panel_height_px = 680;
  PlotPanel panel;
  panel.x = {"CPU time, ratio to stock", true, {}, "crashed", "0", {}};
  panel.y = {"error, ratio to stock", true, {}, "fails", kRatioMinText, {}};
  panel.uprights.push_back({1, "stock's cost"});
  panel.levels.push_back({1, "stock's error"});
  PlotCurve held = PointsOnly("both hold", kSceneColour, 7, 0.9);
  PlotCurve rescued = PointsOnly("stock fails", "#0072b2", 9, 1.1);
  PlotCurve failed = PointsOnly("own fails", "#c41e3a", 2, 1.1);
  PlotCurve both = PointsOnly("both fail", "#999999", 2, 1.1);
  for (const PhysicsCase& c : cases) {
    if (!c.stock || !c.scene) continue;
    const double ratio = ShownRatio(c);
    const PlotPoint point = {c.scene->cost_ratio, ratio, ratio, ratio};
    PlotCurve& kind =
        c.scene->held() ? (c.stock->held() ? held : rescued) : (c.stock->held() ? failed : both);
    kind.points.push_back(point);
    panel.notes.push_back({point.x, point.y, c.name, false, 0});
  }
  for (PlotCurve* curve : {&held, &rescued, &failed, &both}) {
    if (!curve->points.empty()) panel.curves.push_back(std::move(*curve));
  }
  SpreadNotes(figure.panel_width_px - 92, figure.panel_height_px - 82, &panel);
  figure.panels.push_back(std::move(panel));
  figure.caption =
      "Below the line: less error than the stock setting (60 Hz, 8/3 iterations) on the same "
      "scene; left of it: less CPU time. At the lower edge: less than a ten-thousandth of stock's "
      "error, or stock fails and the scene's setting does not. Points without a name: in the list.";
  return figure;
}

Section PhysicsSection(const CsvTable& table, const std::string& command) {
  const std::vector<PhysicsCase> cases = ViewPhysics(table);
  Section section;
  section.id = "hard-cases";
  section.title = "Hard cases for the solver";
  section.intro =
      "Every setting that was tried, at its cost as a ratio to the stock setting timed beside it "
      "in the same run, against its error: from a formula, from the scene's own converged run, "
      "or by what must not happen (invariant). Settings that failed are marked; those that "
      "diverged are at the upper edge.";
  section.items.emplace_back(PhysicsSummary(cases, command));
  Figure speed = SolverSpeed(cases, command);
  if (!speed.panels.empty()) {
    section.items.emplace_back(std::move(speed));
    section.items.emplace_back(SolverSpeedTable(cases, command));
  }
  section.items.emplace_back(PhysicsList(cases, command));
  for (TextTable t : {PhysicsTable(cases, command), PhysicsSearchTable(cases, command),
                      PhysicsSideTable(table, cases, command)}) {
    t.open = t.name == "hard-cases";
    section.items.emplace_back(std::move(t));
  }
  for (const PhysicsCase& c : cases) section.items.emplace_back(WorkPrecision(c, command));
  return section;
}

}  // namespace seam
