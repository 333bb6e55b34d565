#include "tests/lab/physics_row.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/base/bytes.h"
#include "common/measure/table.h"
#include "tests/lab/grid.h"
#include "tests/lab/report/csv_table.h"
#include "tests/lab/session.h"
#include "tests/lab/sweep_table.h"

namespace seam {
namespace {

// Columns behind the key.
enum Column { kError = kPhysicsKeyColumns, kFailure, kCostRatio = kError + 9, kReferenceChange };

/// The failure of all rows of a case whose reference has an error like those that it should judge.
constexpr const char* kNotConverged = "not converged";

const char* Word(Truth truth) {
  switch (truth) {
    case Truth::kFormula: return "formula";
    case Truth::kConverged: return "converged";
    case Truth::kInvariant: break;
  }
  return "invariant";
}

std::string OnOff(bool on) { return on ? "on" : "off"; }

std::string Number(double value) { return fmt::format("{:.6g}", value); }

std::string Maybe(const std::optional<double>& value) { return value ? Number(*value) : ""; }

/// Why the error says nothing; no comma. What went wrong in the run itself is its failure.
std::string WhyNotValid(const HardCase& hard, const Observation& seen, const Reference* reference) {
  if (hard.truth == Truth::kConverged && reference == nullptr) return "no converged run";
  if (reference != nullptr && !std::isfinite(reference->change_m)) {
    return "the converged run diverged";
  }
  return seen.seconds <= 0 && seen.failure.empty() ? "nothing was simulated" : "";
}

}  // namespace

std::string PhysicsHeader() {
  return "version,case,truth,unit,role,tick_hz,substeps,velocity_iterations,position_iterations,"
         "warm_starting,skin,continuous,welds,joints,joint_substeps,seconds,error,failure,"
         "penetration_m,joint_drift_m,"
         "energy_gain,jitter_mps,asleep_s,cpu_us_per_s,stock_cpu_us_per_s,cost_ratio,"
         "reference_change,valid";
}

std::string PhysicsKey(const PhysicsPoint& point) {
  const HardCase& hard = *point.hard;
  const Solver& s = point.scene.solver;
  const std::string& text = point.scene.text;
  const auto hash = static_cast<std::uint32_t>(Fnv1a(text.data(), text.size()));
  return fmt::format("{}/{:08x},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}", kLabVersion, hash,
                     CsvField(hard.name), Word(hard.truth), CsvField(hard.unit), point.role,
                     s.tick_hz, s.substeps, s.velocity_iterations, s.position_iterations,
                     OnOff(s.warm_starting), s.skin > 0 ? fmt::format("{}", s.skin) : "",
                     OnOff(s.continuous), s.weld_joints ? "joint" : "body", JointsWord(s.joints),
                     s.joints == JointSolving::kIterative ? 1 : s.joint_substeps, hard.seconds);
}

std::string PhysicsRow(const PhysicsPoint& point, const Reference* reference) {
  const HardCase& hard = *point.hard;
  const Observation seen =
      Observe(hard, point.scene, hard.seconds, reference ? &reference->finest : nullptr);
  // A run that lost a body costs what it cost until then; the engine may not survive more of it.
  const double seconds = std::max(seen.seconds, 1.0 / point.scene.solver.tick_hz);
  const Cost cost = CompareCost(point.scene, WithSolver(point.scene, StockSolver()), seconds);
  const std::string valid = WhyNotValid(hard, seen, reference);
  if (!valid.empty()) return PhysicsKey(point) + ",,,,,,,,,,,," + valid;
  const bool undecided = reference != nullptr && !reference->converged() && seen.failure.empty();
  const std::string failure = undecided ? kNotConverged : seen.failure;
  return PhysicsKey(point) + fmt::format(",{},{},{},{},{},{},{},{:.5g},{:.5g},{:.4f},{},",
                                         Number(seen.error), CsvField(failure),
                                         Number(seen.penetration_m), Number(seen.joint_drift_m),
                                         Maybe(seen.energy_gain), Number(seen.jitter_mps),
                                         Maybe(seen.asleep_s), cost.us_per_s, cost.stock_us_per_s,
                                         cost.ratio, reference ? Number(reference->change_m) : "");
}

std::string CrashedRow(const PhysicsPoint& point, const std::string& why) {
  return PhysicsKey(point) + ",inf," + CsvField(why) + ",,,,,,,,,,";
}

void PrintPhysics(const PhysicsPlan& plan, const std::vector<std::string>& lines) {
  std::printf("%-22s %-5s %10s %10s %9s %9s  %s\n", "case", "unit", "stock", "scene's", "its error",
              "its cost", "failures (stock | scene's), settings tried, of them held");
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const HardCase& hard = *plan.points[i].hard;
    if (plan.points[i].role != "stock") continue;
    std::vector<std::string> stock, scene;
    int tried = 0, held = 0;
    for (std::size_t k = i; k < lines.size() && plan.points[k].hard == &hard; ++k) {
      if (lines[k].empty()) continue;
      const std::vector<std::string> fields = CsvFields(lines[k]);
      ++tried;
      held += fields[kFailure].empty() ? 1 : 0;
      if (k == i) stock = fields;
      if (plan.points[k].role == "scene") scene = fields;
    }
    if (stock.empty() || scene.empty()) continue;
    if (stock[kError].empty() || scene[kError].empty()) continue;  // not valid
    const double before = std::stod(stock[kError]), after = std::stod(scene[kError]);
    const double ratio = before == after ? 1 : after / before;
    const std::string cost = scene[kCostRatio].empty() ? "-" : scene[kCostRatio];
    std::printf("%-22s %-5s %10.4g %10.4g %9.3g %9s  %s | %s, %d, %d\n", hard.name.c_str(),
                hard.unit.c_str(), before, after, ratio, cost.c_str(),
                stock[kFailure].empty() ? "-" : stock[kFailure].c_str(),
                scene[kFailure].empty() ? "-" : scene[kFailure].c_str(), tried, held);
    if (hard.truth == Truth::kConverged && !stock[kReferenceChange].empty()) {
      const bool converged = stock[kFailure] != kNotConverged && scene[kFailure] != kNotConverged;
      std::printf("%-22s halving the step of the reference changes it by %.3g %s: %s\n", "",
                  std::stod(stock[kReferenceChange]), hard.unit.c_str(),
                  converged ? "converged"
                            : "not converged; the errors above say nothing about the settings");
    }
  }
}

}  // namespace seam
