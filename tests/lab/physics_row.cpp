#include "tests/lab/physics_row.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>

#include "common/base/bytes.h"
#include "tests/lab/experiment/csv_table.h"
#include "tests/lab/session.h"

namespace seam {
namespace {

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

/// Why the error says nothing; no comma. What went wrong in the run itself is its failure.
std::string WhyNotValid(const HardCase& hard, const Observation& seen, const Reference* reference) {
  if (hard.truth == Truth::kConverged && reference == nullptr) return "no converged run";
  if (reference != nullptr && !std::isfinite(reference->change_m)) {
    return "the converged run diverged";
  }
  return seen.seconds <= 0 && seen.failure.empty() ? "nothing was simulated" : "";
}

/// `reference_m`: how much halving the reference's step changes it, if there is a reference.
Values PhysicsFigures(const Observation& seen, const std::string& failure, const Cost& cost,
                      std::optional<double> reference_m) {
  return {Significant("error", seen.error),
          {"failure", failure},
          Significant("penetration_m", seen.penetration_m),
          Significant("joint_drift_m", seen.joint_drift_m),
          Significant("energy_gain", seen.energy_gain),
          Significant("jitter_mps", seen.jitter_mps),
          Significant("asleep_s", seen.asleep_s),
          Significant("cpu_us_per_s", cost.us_per_s, 5),
          Significant("stock_cpu_us_per_s", cost.stock_us_per_s, 5),
          Decimals("cost_ratio", cost.ratio, 4),
          Significant("reference_change", reference_m),
          {"valid", ""}};
}

Values EmptyFigures() { return Emptied(PhysicsFigures({}, "", {}, {})); }

/// A row by the names of its columns.
std::map<std::string, std::string> ByColumn(const std::string& line) {
  const std::vector<std::string> names =
      CsvFields(PhysicsKeyColumns() + "," + PhysicsValueColumns());
  const std::vector<std::string> fields = CsvFields(line);
  std::map<std::string, std::string> row;
  for (std::size_t i = 0; i < fields.size(); ++i) row[names[i]] = fields[i];
  return row;
}

}  // namespace

Values PhysicsKey(const PhysicsPoint& point) {
  const HardCase& hard = *point.hard;
  const Solver& s = point.scene.solver;
  const std::string& text = point.scene.text;
  const auto hash = static_cast<std::uint32_t>(Fnv1a(text.data(), text.size()));
  const bool iterative = s.joints == JointSolving::kIterative;
  const bool soft = s.contacts == ContactSolving::kSoft;
  return {{"version", fmt::format("{}/{:08x}", kLabVersion, hash)},
          {"case", hard.name},
          {"truth", Word(hard.truth)},
          {"unit", hard.unit},
          {"role", point.role},
          Count("tick_hz", s.tick_hz),
          Count("substeps", s.substeps),
          Count("velocity_iterations", s.velocity_iterations),
          Count("position_iterations", s.position_iterations),
          {"warm_starting", OnOff(s.warm_starting)},
          {"skin", s.skin > 0 ? fmt::format("{}", s.skin) : ""},
          {"continuous", OnOff(s.continuous)},
          {"welds", s.weld_joints ? "joint" : "body"},
          {"joints", JointsWord(s.joints)},
          Count("joint_substeps", iterative ? 1 : s.joint_substeps),
          {"contacts", soft ? "soft" : "engine"},
          Count("contact_substeps", soft ? s.contact_substeps : 1),
          {"seconds", fmt::format("{}", hard.seconds)}};
}

Values PhysicsValues(const PhysicsPoint& point, const Reference* reference) {
  const HardCase& hard = *point.hard;
  const Observation seen =
      Observe(hard, point.scene, hard.seconds, reference ? &reference->finest : nullptr);
  // A run that lost a body costs what it cost until then; the engine may not survive more of it.
  const double seconds = std::max(seen.seconds, 1.0 / point.scene.solver.tick_hz);
  const Cost cost = CompareCost(point.scene, WithSolver(point.scene, StockSolver()), seconds);
  const std::string reason = WhyNotValid(hard, seen, reference);
  if (!reason.empty()) {
    Values values = EmptyFigures();
    values.back().text = reason;
    return values;
  }
  const bool undecided = reference != nullptr && !reference->converged() && seen.failure.empty();
  return PhysicsFigures(seen, undecided ? kNotConverged : seen.failure, cost,
                        reference ? std::optional<double>(reference->change_m) : std::nullopt);
}

Values CrashedValues(const std::string& why) {
  Values values = EmptyFigures();
  values[0].text = "inf";
  values[1].text = why;
  return values;
}

std::string PhysicsKeyColumns() {
  const HardCase none;
  return CsvColumns(PhysicsKey({&none, "", {}}));
}

std::string PhysicsValueColumns() { return CsvColumns(EmptyFigures()); }

void PrintPhysics(const PhysicsPlan& plan, const std::vector<std::string>& lines) {
  std::printf("%-22s %-5s %10s %10s %9s %9s  %s\n", "case", "unit", "stock", "scene's", "its error",
              "its cost", "failures (stock | scene's), settings tried, of them held");
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const HardCase& hard = *plan.points[i].hard;
    if (plan.points[i].role != "stock") continue;
    std::map<std::string, std::string> stock, scene;
    int tried = 0, held = 0;
    for (std::size_t k = i; k < lines.size() && plan.points[k].hard == &hard; ++k) {
      if (lines[k].empty()) continue;
      std::map<std::string, std::string> row = ByColumn(lines[k]);
      ++tried;
      held += row["failure"].empty() ? 1 : 0;
      if (k == i) stock = row;
      if (plan.points[k].role == "scene") scene = row;
    }
    if (stock.empty() || scene.empty()) continue;
    if (stock["error"].empty() || scene["error"].empty()) continue;  // not valid
    const double before = std::stod(stock["error"]), after = std::stod(scene["error"]);
    const double ratio = before == after ? 1 : after / before;
    const std::string cost = scene["cost_ratio"].empty() ? "-" : scene["cost_ratio"];
    std::printf("%-22s %-5s %10.4g %10.4g %9.3g %9s  %s | %s, %d, %d\n", hard.name.c_str(),
                hard.unit.c_str(), before, after, ratio, cost.c_str(),
                stock["failure"].empty() ? "-" : stock["failure"].c_str(),
                scene["failure"].empty() ? "-" : scene["failure"].c_str(), tried, held);
    if (hard.truth == Truth::kConverged && !stock["reference_change"].empty()) {
      const bool converged = stock["failure"] != kNotConverged && scene["failure"] != kNotConverged;
      std::printf("%-22s halving the step of the reference changes it by %.3g %s: %s\n", "",
                  std::stod(stock["reference_change"]), hard.unit.c_str(),
                  converged ? "converged"
                            : "not converged; the errors above say nothing about the settings");
    }
  }
}

}  // namespace seam
