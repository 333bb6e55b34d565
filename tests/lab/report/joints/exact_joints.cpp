#include "tests/lab/report/joints/exact_joints.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace seam {
namespace {

constexpr double kNoWorse = 1.0005;  // equal in the three digits that are shown
constexpr double kSameCost = 1.1;    // as far as two timings of one setting can tell
constexpr double kCostMedian = 0.5;  // of all hard cases
constexpr double kCoreStep = 1.03;   // beside raw Box2D

double ErrorOf(const JointBar& bar, const PhysicsRun& run) {
  return bar.drift ? run.joint_drift_m : run.error;
}

std::string Figures(const JointBar& bar, const PhysicsRun* run) {
  if (run == nullptr) return "–";
  return fmt::format("{}{} / {} / {}", Digits(ErrorOf(bar, *run)),
                     run->held() ? "" : ", " + run->failure, Digits(run->penetration_m),
                     Digits(run->cost_ratio));
}

std::string Words(const JointBar& bar) {
  std::string words = bar.error ? "≤ " + Digits(*bar.error) : "≤ stock";
  words += bar.overlap_m ? " / ≤ " + Digits(*bar.overlap_m) : " / –";
  return words + (bar.cost ? " / ≤ " + Digits(*bar.cost) : " / –");
}

/// The runs with exact joints, by their substeps.
std::vector<const PhysicsRun*> ExactRuns(const PhysicsCase& c) {
  std::vector<const PhysicsRun*> runs;
  for (const PhysicsRun& run : c.all) {
    if (run.role == "exact") runs.push_back(&run);
  }
  std::stable_sort(runs.begin(), runs.end(), [](const PhysicsRun* a, const PhysicsRun* b) {
    return a->joint_substeps < b->joint_substeps;
  });
  return runs;
}

/// The scene's setting with iterative joints: what it is anyway, where its joints are not said.
const PhysicsRun* Iterative(const PhysicsCase& c) {
  for (const PhysicsRun& run : c.all) {
    if (run.role == "iterative") return &run;
  }
  return c.scene ? &*c.scene : nullptr;
}

std::string Joined(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
  return all;
}

std::string VerdictOf(const JointBar& bar, const PhysicsCase& c) {
  std::vector<const PhysicsRun*> runs = ExactRuns(c);
  const bool exact = !runs.empty();
  if (!exact && c.scene) runs.push_back(&*c.scene);
  const PhysicsRun* best = nullptr;
  std::vector<std::string> least;
  for (const PhysicsRun* run : runs) {
    const std::vector<std::string> missed = Missed(bar, *run, c.stock);
    // What holds at all is nearer than what does not.
    const bool nearer = best == nullptr || (run->held() && !best->held()) ||
                        (run->held() == best->held() && missed.size() < least.size());
    if (!nearer) continue;
    best = run;
    least = missed;
  }
  if (best == nullptr) return "not measured";
  const std::string which = exact ? fmt::format(" (× {})", best->joint_substeps) : " (no joints)";
  return (least.empty() ? "met" : "missed: " + Joined(least)) + which;
}

std::optional<Quartiles> CostsNoWorse(const std::vector<PhysicsCase>& cases, bool exact_too) {
  std::vector<double> costs;
  for (const PhysicsCase& c : cases) {
    PhysicsCase some = c;
    some.all.clear();
    for (const PhysicsRun& run : c.all) {
      if (exact_too || run.joints == "iterative") some.all.push_back(run);
    }
    if (const PhysicsRun* best = CheapestNoWorse(some)) costs.push_back(best->cost_ratio);
  }
  return FindQuartiles(costs);
}

std::optional<Quartiles> CostsOfScenes(const std::vector<PhysicsCase>& cases) {
  std::vector<double> costs;
  for (const PhysicsCase& c : cases) {
    if (c.scene && !std::isnan(c.scene->cost_ratio)) costs.push_back(c.scene->cost_ratio);
  }
  return FindQuartiles(costs);
}

/// Cases that the scene's own setting does worse than, or as well but dearer than, with iterative
/// joints.
std::string Losers(const std::vector<PhysicsCase>& cases) {
  std::vector<std::string> losers;
  for (const PhysicsCase& c : cases) {
    const PhysicsRun* before = Iterative(c);
    if (!c.scene || before == nullptr || before->role != "iterative") continue;
    const double error = ErrorRatio(*c.scene, *before);
    const double cost = c.scene->cost_ratio / before->cost_ratio;
    if (error > kNoWorse || (error > 1 / kNoWorse && cost > kSameCost)) losers.push_back(c.name);
  }
  return losers.empty() ? "none" : Joined(losers);
}

std::string MetBelow(const std::optional<Quartiles>& value, double most) {
  if (!value) return "not measured";
  return value->median <= most ? "met" : "missed";
}

}  // namespace

const std::vector<JointBar>& JointBars() {
  static const std::vector<JointBar> bars = [] {
    std::vector<JointBar> all = {{"pendulum-energy", false, 5e-3, {}, 1},
                                 {"pendulum-double", false, 5e-3, {}, 2.2},
                                 {"motor-loop", false, 3e-4, {}, 1.2},
                                 {"chain-heavy-end", false, 1e-5, {}, 0.5},
                                 {"chain-heavy-end-nudged", false, 1e-5, {}, 0.5},
                                 {"ball-and-chain", false, 1e-4, {}, 2.5},
                                 {"scissor-lift", true, 1e-5, 0.02, 2},
                                 {"bridge", true, 1e-5, 0.02, 4},
                                 {"crane-grip", false, 1e-3, 0.01, 1.5},
                                 {"mass-ratio-hung", false, 0.5, 0.01, 2},
                                 {"tower-linkage", false, 0.8, 0.01, 2},
                                 {"car-terrain", true, 1e-5, 0.015, 1.5},
                                 {"ragdoll-pile", false, 1e-5, {}, 4},
                                 {"ragdoll-pile-impact", false, {}, {}, 4},
                                 {"ragdoll-pile-late", false, 0.01, {}, 4}};
    for (const char* kind : {"distance", "hinge", "prismatic", "rope", "weld", "wheel"}) {
      all.push_back({std::string("joint-load-") + kind, false, 1e-5, {}, 2.5});
    }
    for (const char* box : {"rod-box", "disc-box"}) {
      for (const int substeps : {1, 2, 4, 8}) {
        all.push_back({fmt::format("{}-x{}", box, substeps), false, 0.01, {}, {}});
      }
    }
    return all;
  }();
  return bars;
}

std::vector<std::string> Missed(const JointBar& bar, const PhysicsRun& run,
                                const std::optional<PhysicsRun>& stock) {
  if (!run.held()) return {run.failure};
  std::vector<std::string> missed;
  const double unheard = std::nan("");
  const double most = bar.error ? *bar.error : stock ? ErrorOf(bar, *stock) * kNoWorse : unheard;
  // What is no number is within no bar.
  if (!(ErrorOf(bar, run) <= most)) missed.emplace_back("error");
  if (bar.overlap_m && !(run.penetration_m <= *bar.overlap_m)) missed.emplace_back("overlap");
  if (bar.cost && !(run.cost_ratio <= *bar.cost)) missed.emplace_back("cost");
  return missed;
}

TextTable ExactJointsTable(const std::vector<PhysicsCase>& cases, const std::string& command) {
  TextTable table;
  table.name = "exact-joints";
  table.title = "Exact joints beside stock: error / overlap (m) / cost of stock";
  table.header = {"case",      "error",     "stock", "scene's, iterative",
                  "exact × 1", "exact × 2", "bar",   "verdict"};
  int met = 0;
  for (const JointBar& bar : JointBars()) {
    const auto found = std::find_if(cases.begin(), cases.end(),
                                    [&](const PhysicsCase& c) { return c.name == bar.name; });
    if (found == cases.end()) continue;
    const PhysicsCase& c = *found;
    std::string once = "–", more = "–";
    for (const PhysicsRun* run : ExactRuns(c)) {
      const int n = run->joint_substeps;
      if (n == 1) {
        once = Figures(bar, run);
      } else {
        more = (n == 2 ? "" : fmt::format("× {}: ", n)) + Figures(bar, run);
      }
    }
    const std::string verdict = VerdictOf(bar, c);
    met += verdict.rfind("met", 0) == 0 ? 1 : 0;
    table.rows.push_back({c.name, bar.drift ? "joint drift, m" : c.unit,
                          Figures(bar, c.stock ? &*c.stock : nullptr), Figures(bar, Iterative(c)),
                          once, more, Words(bar), verdict});
  }
  table.note = fmt::format(
      "{} of {} bars met. Costs are ratios to stock, stepped side by side in one run. Exact: "
      "one step of the engine a tick, the joints' substeps as said; all else as the scene has it. "
      "A "
      "bar is met when one of the exact settings holds all of it.",
      met, table.rows.size());
  table.command = command;
  table.open = true;
  return table;
}

TextTable ExactJointsSummary(const std::vector<PhysicsCase>& cases, const CsvTable* overhead,
                             const std::string& command) {
  TextTable table;
  table.name = "exact-joints-all";
  table.title = "All hard cases: what an error no worse than stock's costs, and what nothing costs";
  table.header = {"what", "ratio: median (quartiles)", "bar", "verdict"};
  const auto row = [&](const std::string& what, const std::optional<Quartiles>& value,
                       std::optional<double> most) {
    table.rows.push_back({what, Digits(value), most ? "≤ " + Digits(*most) : "–",
                          most ? MetBelow(value, *most) : "–"});
  };
  row("cost of the scenes' settings", CostsOfScenes(cases), {});
  row("cost, the cheapest that errs no more than stock, iterative joints",
      CostsNoWorse(cases, false), {});
  row("cost, the cheapest that errs no more than stock", CostsNoWorse(cases, true), kCostMedian);
  std::vector<double> ratios;
  for (std::size_t i = 0; overhead != nullptr && i < overhead->rows(); ++i) {
    if (const auto ratio = overhead->Number(i, "ratio")) ratios.push_back(*ratio);
  }
  row("step of the core beside raw Box2D (table overhead)", FindQuartiles(ratios), kCoreStep);
  table.note = fmt::format(
      "{} cases, each once. Cases that the scene's setting does worse than with iterative joints, "
      "or no better and dearer: {}.",
      cases.size(), Losers(cases));
  table.command = command;
  table.open = true;
  return table;
}

Section ExactJointsSection(const CsvTable& physics, const CsvTable* overhead,
                           const std::string& command) {
  const std::vector<PhysicsCase> cases = ViewPhysics(physics);
  Section section;
  section.id = "exact-joints";
  section.title = "Exact joints";
  section.intro =
      "A mechanism's joints solved as one system, beside the engine's joint after joint: the hard "
      "cases with a bar, each with stock's setting, the scene's own with iterative joints, and "
      "exact joints.";
  for (TextTable table :
       {ExactJointsTable(cases, command), ExactJointsSummary(cases, overhead, command)}) {
    if (!table.rows.empty()) section.items.emplace_back(std::move(table));
  }
  return section;
}

}  // namespace seam
