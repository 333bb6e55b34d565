#include "tests/lab/report/physics_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace seam {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Equal in the three digits that are shown.
constexpr double kNoWorse = 1.0005;
/// Costs that two timings of one setting cannot tell apart on a busy machine.
constexpr double kSameCost = 1.1;
constexpr double kMuchBetter = 0.5;

bool IsOn(const std::string& text) { return text == "1" || text == "on" || text == "true"; }

/// What a grid varies.
std::string Levers(const CsvTable& t, std::size_t row) {
  std::string text =
      fmt::format("{} Hz, {}/{} × {}", t.Text(row, "tick_hz"), t.Text(row, "velocity_iterations"),
                  t.Text(row, "position_iterations"), t.Text(row, "substeps"));
  const std::string& skin = t.Text(row, "skin");
  if (!skin.empty() && t.Number(row, "skin").value_or(0.01) != 0.01) {
    text += ", skin " + skin + " m";
  }
  if (!IsOn(t.Text(row, "warm_starting"))) text += ", cold";
  return text;
}

/// The levers, and what the scene says beside them.
std::string Setting(const CsvTable& t, std::size_t row) {
  std::string text = Levers(t, row);
  if (!IsOn(t.Text(row, "continuous"))) text += ", not continuous";
  const bool stock = t.Text(row, "role") == "stock";  // that always has them so
  if (!stock && t.Text(row, "welds") == "joint") text += ", welds jointed";
  return text;
}

PhysicsRun RunOf(const CsvTable& t, std::size_t row) {
  PhysicsRun run;
  run.row = row;
  run.levers = Levers(t, row);
  run.setting = Setting(t, row);
  run.tick_hz = t.Number(row, "tick_hz").value_or(60);
  run.warm = IsOn(t.Text(row, "warm_starting"));
  run.role = t.Text(row, "role");
  if (t.Has("joints")) {
    run.joints = t.Text(row, "joints");
    run.joint_substeps = static_cast<int>(t.Number(row, "joint_substeps").value_or(1));
  }
  if (run.joints != "iterative") {
    run.setting += fmt::format(", joints {} × {}", run.joints, run.joint_substeps);
  }
  if (t.Has("contacts") && t.Text(row, "contacts") == "soft") {
    run.contact_substeps = static_cast<int>(t.Number(row, "contact_substeps").value_or(1));
    run.setting += fmt::format(", soft contacts × {}", run.contact_substeps);
  }
  const auto measured = [&](const char* column) {
    return t.Has(column) ? t.Number(row, column).value_or(kInfinity) : 0;
  };
  run.penetration_m = measured("penetration_m");
  run.joint_drift_m = measured("joint_drift_m");
  run.failure = t.Text(row, "failure");
  run.error = t.Number(row, "error").value_or(kInfinity);
  if (std::isnan(run.error)) run.error = kInfinity;
  if (std::isinf(run.error) && run.failure.empty()) run.failure = "diverged";
  run.cost_ratio = t.Number(row, "cost_ratio").value_or(std::nan(""));
  return run;
}

}  // namespace

std::vector<PhysicsCase> ViewPhysics(const CsvTable& table) {
  table.Require({"case", "truth", "unit", "role", "tick_hz", "substeps", "velocity_iterations",
                 "position_iterations", "warm_starting", "skin", "continuous", "welds", "error",
                 "failure", "cost_ratio"});
  std::vector<PhysicsCase> cases;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (!table.Text(row, "valid").empty()) continue;  // without figures
    const std::string& name = table.Text(row, "case");
    auto found = std::find_if(cases.begin(), cases.end(),
                              [&](const PhysicsCase& c) { return c.name == name; });
    if (found == cases.end()) {
      cases.push_back({name, table.Text(row, "truth"), table.Text(row, "unit"), {}, {}, {}});
      found = cases.end() - 1;
    }
    const PhysicsRun run = RunOf(table, row);
    const std::string& role = table.Text(row, "role");
    if (role == "stock") found->stock = run;
    if (role == "scene") found->scene = run;
    found->all.push_back(run);
  }
  return cases;
}

std::vector<CostError> PhysicsTrials(const std::vector<PhysicsRun>& runs) {
  std::vector<CostError> trials;
  for (const PhysicsRun& run : runs) {
    trials.push_back({run.cost_ratio, run.held() ? run.error : kInfinity});
  }
  return trials;
}

double ErrorRatio(const PhysicsRun& a, const PhysicsRun& b) {
  if (!a.held() || !b.held()) return a.held() ? 0 : b.held() ? kInfinity : 1;
  if (b.error == 0) return a.error == 0 ? 1 : kInfinity;
  return a.error / b.error;
}

const PhysicsRun* CheapestNoWorse(const PhysicsCase& c) {
  const PhysicsRun* best = nullptr;
  for (const PhysicsRun& run : c.all) {
    if (!c.stock || !run.held() || std::isnan(run.cost_ratio)) continue;
    if (ErrorRatio(run, *c.stock) > kNoWorse) continue;
    if (best == nullptr || run.cost_ratio < best->cost_ratio) best = &run;
  }
  return best;
}

const PhysicsRun* BestAtStocksCost(const PhysicsCase& c) {
  const PhysicsRun* best = nullptr;
  for (const PhysicsRun& run : c.all) {
    if (!run.held() || !(run.cost_ratio <= kSameCost)) continue;
    if (best == nullptr || run.error < best->error) best = &run;
  }
  return best;
}

std::string Verdict(const PhysicsCase& c) {
  if (!c.stock || !c.scene) return "not measured";
  if (!c.scene->held()) return c.stock->held() ? "worse: it fails" : "both fail";
  const double error = ErrorRatio(*c.scene, *c.stock), cost = c.scene->cost_ratio;
  const bool same_cost = cost <= kSameCost, much_better = error < kMuchBetter;
  if (!c.stock->held()) return same_cost ? "holds, stock fails" : "holds, stock fails; dearer";
  if (error > kNoWorse) return "worse";
  if (cost <= 1) return much_better ? "much better, cheaper" : "no worse, cheaper";
  if (same_cost) return much_better ? "much better, same cost" : "no worse, same cost";
  return much_better ? "much better, dearer" : "neither";
}

}  // namespace seam
