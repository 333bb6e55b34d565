#include "tests/lab/report/joints/solver_speed.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "tests/lab/report/figure.h"
#include "tests/lab/report/statistics.h"

namespace seam {
namespace {

struct Kind {
  const char* name;
  Look look;
};
/// In the order of the legend.
const std::array<Kind, 6> kKinds = {{{"engine", {"#56b4e9", "solid", 0, 7, 0.8}},
                                     {"engine, thin skin", {"#0072b2", "solid", 0, 6, 0.8}},
                                     {"soft contacts", {"#009e73", "solid", 1.2, 9, 1.1}},
                                     {"exact joints", {"#cc79a7", "solid", 1.2, 5, 1.1}},
                                     {"each scene's own", {"#d55e00", "solid", 0, 12, 2.0}},
                                     {"stock", {"#000000", "solid", 0, 4, 1.6}}}};

bool HasJoints(const PhysicsCase& c) {
  return std::any_of(c.all.begin(), c.all.end(),
                     [](const PhysicsRun& run) { return run.role == "exact"; });
}

/// Returns kind and name of a run's setting; no kind for what is tried on one case alone.
std::pair<std::string, std::string> SettingOf(const PhysicsRun& run) {
  if (run.role == "stock") return {"stock", run.levers};
  if (run.role == "scene") return {"each scene's own", "each scene's own"};
  if (run.role == "exact") {
    return {"exact joints", fmt::format("exact × {}", run.joint_substeps)};
  }
  if (run.role == "soft") {
    return {"soft contacts", fmt::format("soft × {}", run.contact_substeps)};
  }
  if (run.role != "grid" || run.joints != "iterative") return {};
  return {run.levers.find("skin") == std::string::npos ? "engine" : "engine, thin skin",
          run.levers};
}

double MedianOf(const std::vector<double>& values) { return FindQuartiles(values)->median; }

PlotPanel SpeedPanel(const std::vector<SolverSetting>& settings, const std::string& where) {
  PlotPanel panel;
  panel.x = {"CPU time, ratio to stock; " + where, true, {}, "crashed", "0", {}};
  panel.y = {"error, ratio to stock", true, {}, "fails", "0", {}};
  panel.uprights.push_back({1, ""});
  panel.levels.push_back({1, ""});
  std::vector<CostError> trials;
  for (const SolverSetting& s : settings) trials.push_back({MedianOf(s.costs), MedianOf(s.errors)});
  for (const Kind& kind : kKinds) {
    PlotCurve curve;
    curve.name = kind.name;
    curve.look = kind.look;
    for (std::size_t i = 0; i < settings.size(); ++i) {
      if (settings[i].kind != kind.name) continue;
      const auto error = *FindQuartiles(settings[i].errors);
      const bool tells = settings[i].kind == "engine" || settings[i].kind == "engine, thin skin";
      // Bars of dozens of settings over each other say nothing.
      const double low = tells ? error.median : error.low, high = tells ? low : error.high;
      curve.points.push_back({trials[i].cost, error.median, low, high});
    }
    if (!curve.points.empty()) panel.curves.push_back(std::move(curve));
  }
  const std::vector<std::size_t> front = ParetoFront(trials);
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const bool special = settings[i].kind != "engine" && settings[i].kind != "engine, thin skin";
    if (!special && std::find(front.begin(), front.end(), i) == front.end()) continue;
    panel.notes.push_back({trials[i].cost, trials[i].error, settings[i].name, false, 0});
  }
  return panel;
}

std::size_t CountOf(const std::vector<PhysicsCase>& cases, bool jointed) {
  return static_cast<std::size_t>(
      std::count_if(cases.begin(), cases.end(),
                    [&](const PhysicsCase& c) { return c.stock && HasJoints(c) == jointed; }));
}

}  // namespace

std::vector<SolverSetting> SolverSettings(const std::vector<PhysicsCase>& cases, bool jointed) {
  std::map<std::pair<std::string, std::string>, SolverSetting> found;
  for (const PhysicsCase& c : cases) {
    if (!c.stock || HasJoints(c) != jointed) continue;
    for (const PhysicsRun& run : c.all) {
      const auto setting = SettingOf(run);
      if (setting.first.empty() || std::isnan(run.cost_ratio)) continue;
      SolverSetting& into = found[setting];
      into.kind = setting.first;
      into.name = setting.second;
      into.errors.push_back(ErrorRatio(run, *c.stock));
      into.costs.push_back(run.cost_ratio);
      into.failed += run.held() ? 0 : 1;
    }
  }
  std::vector<SolverSetting> settings;
  for (auto& [key, setting] : found) {
    if (2 * setting.errors.size() >= CountOf(cases, jointed)) {
      settings.push_back(std::move(setting));
    }
  }
  std::stable_sort(settings.begin(), settings.end(),
                   [](const SolverSetting& a, const SolverSetting& b) {
                     return MedianOf(a.costs) < MedianOf(b.costs);
                   });
  return settings;
}

Figure SolverSpeed(const std::vector<PhysicsCase>& cases, const std::string& command) {
  Figure figure;
  figure.name = "solver-speed";
  figure.title = "Speed against error of the solver: a dot is a setting, the median of all cases";
  figure.command = command;
  figure.columns = 2;
  figure.panel_width_px = 560;
  figure.panel_height_px = 460;
  for (const bool jointed : {true, false}) {
    const std::vector<SolverSetting> settings = SolverSettings(cases, jointed);
    if (settings.size() < 2) continue;
    PlotPanel panel = SpeedPanel(
        settings,
        fmt::format("{} cases with{} joints", CountOf(cases, jointed), jointed ? "" : "out"));
    SpreadNotes(figure.panel_width_px - 92, figure.panel_height_px - 82, &panel);
    figure.panels.push_back(std::move(panel));
  }
  figure.caption =
      "Left and below is better. Bars are quartiles over the cases. Names: the settings that none "
      "beats, velocity/position iterations × substeps; soft contacts go with the scene's own "
      "joints. "
      "An error counts as 0 where stock fails and as infinite where the setting alone fails.";
  return figure;
}

TextTable SolverSpeedTable(const std::vector<PhysicsCase>& cases, const std::string& command) {
  TextTable table;
  table.name = "solver-speed";
  table.title = "Speed against error of the solver, by setting";
  table.header = {"cases", "setting", "of", "tried on", "failed", "cost ratio", "error ratio"};
  for (const bool jointed : {true, false}) {
    for (const SolverSetting& s : SolverSettings(cases, jointed)) {
      table.rows.push_back({jointed ? "with joints" : "without joints", s.name, s.kind,
                            std::to_string(s.errors.size()), std::to_string(s.failed),
                            Digits(*FindQuartiles(s.costs)), Digits(*FindQuartiles(s.errors))});
    }
  }
  table.note = "Medians (quartiles) of the ratios to stock on the same case.";
  table.command = command;
  return table;
}

}  // namespace seam
