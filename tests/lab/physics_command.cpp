#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>

#include "common/base/check.h"
#include "common/base/process.h"
#include "tests/lab/commands.h"
#include "tests/lab/jobs.h"
#include "tests/lab/physics_row.h"
#include "tests/lab/rows.h"

namespace seam {
namespace {

std::vector<const HardCase*> ChosenCases(const std::vector<std::string>& names) {
  std::vector<const HardCase*> chosen;
  std::string known;
  for (const HardCase& hard : HardCases()) {
    const bool named = std::count(names.begin(), names.end(), hard.name) > 0;
    if (named || names.empty()) chosen.push_back(&hard);
    known += (known.empty() ? "" : ", ") + hard.name;
  }
  for (const std::string& name : names) {
    if (std::none_of(chosen.begin(), chosen.end(),
                     [&name](const HardCase* hard) { return hard->name == name; })) {
      throw OperatorError("no hard case '" + name + "' (there are " + known + ")");
    }
  }
  return chosen;
}

GridSize SizeOf(const std::string& name) {
  return name == "quick" ? GridSize::kQuick : name == "full" ? GridSize::kFull : GridSize::kReport;
}

std::vector<double> AwakeShares(const std::vector<const HardCase*>& cases, GridSize size,
                                const std::string& folder, int jobs) {
  for (const HardCase* hard : cases) LoadHardScene(*hard, folder);  // a mistake is said at once
  std::vector<double> shares(cases.size(), 1);
  RunJobs(
      cases.size(), jobs,
      [&](std::size_t i) { return fmt::format("{}", AwakeShare(*cases[i], size, folder)); },
      [&](std::size_t i, const JobResult& result) {
        if (result.good) shares[i] = std::stod(result.text);
      },
      [] { return g_stop != 0; });
  return shares;
}

using References = std::map<const HardCase*, Reference>;

/// Of the cases with rows to come that have no judge.
References MakeReferences(const PhysicsPlan& plan, const std::vector<std::size_t>& todo) {
  References references;
  for (const std::size_t i : todo) {
    const PhysicsPoint& point = plan.points[i];
    if (point.hard->judge || references.count(point.hard) != 0 || g_stop != 0) continue;
    const auto own = std::find_if(
        plan.points.begin(), plan.points.end(),
        [&](const PhysicsPoint& p) { return p.hard == point.hard && p.role == "scene"; });
    references.emplace(point.hard, MakeReference(own->scene, point.hard->seconds));
  }
  return references;
}

/// What makes the rows of a plan. A crash is a result: the engine gave up.
RowMaker PhysicsRows(const PhysicsPlan& plan, const References& references) {
  RowMaker maker;
  maker.make = [&](std::size_t row) {
    const PhysicsPoint& point = plan.points[row];
    const auto reference = references.find(point.hard);
    return PhysicsRow(point, reference == references.end() ? nullptr : &reference->second);
  };
  maker.rescue = [&](std::size_t row, const std::string& why) -> std::optional<std::string> {
    if (why.rfind("crashed", 0) != 0) return std::nullopt;
    return CrashedRow(plan.points[row], why);
  };
  return maker;
}

}  // namespace

int RunPhysics(const PhysicsCommand& command) {
  const int jobs = JobsOr(command.jobs);
  const GridSize size = SizeOf(command.grid);
  const std::vector<const HardCase*> cases = ChosenCases(command.cases);
  StopOnSignals();
  const std::vector<double> awake = AwakeShares(cases, size, command.folder, jobs);
  if (g_stop != 0) return 1;  // before there was a plan
  const PhysicsPlan plan = PlanPhysics(cases, size, awake, command.folder);
  std::vector<std::string> keys;
  for (const PhysicsPoint& point : plan.points) keys.push_back(PhysicsKey(point));
  SweepTable table(command.table, PhysicsHeader(), kPhysicsKeyColumns, keys, command.force);
  const std::vector<std::size_t> todo = MissingRows(table, keys.size());
  for (const std::string& line : plan.left_out) {
    if (!command.quiet) std::fprintf(stderr, "%s\n", line.c_str());
  }
  const References references = MakeReferences(plan, todo);
  const RowsDone done =
      MakeRows(keys, todo, PhysicsRows(plan, references), jobs, command.quiet, &table);
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < keys.size(); ++i) lines.push_back(table.line(i));
  PrintPhysics(plan, lines);
  return PrintRows(command.table, table, keys.size(), done);
}

}  // namespace seam
