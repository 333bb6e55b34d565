#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <thread>

#include "common/base/check.h"
#include "common/base/process.h"
#include "tests/lab/commands.h"
#include "tests/lab/jobs.h"
#include "tests/lab/physics_row.h"
#include "tests/lab/progress.h"
#include "tests/lab/sweep_table.h"

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
  for (const HardCase* hard : cases) LoadHardScene(*hard, folder);   // a mistake is said at once
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

/// Runs the points of `todo`; returns how many left no row.
std::size_t RunPoints(const PhysicsPlan& plan, const std::vector<std::size_t>& todo, int jobs,
                      bool quiet, SweepTable* table) {
  const References references = MakeReferences(plan, todo);
  Progress progress(todo.size(), quiet);
  std::size_t failed = 0;
  RunJobs(
      todo.size(), jobs,
      [&](std::size_t i) {
        const PhysicsPoint& point = plan.points[todo[i]];
        const auto reference = references.find(point.hard);
        return PhysicsRow(point, reference == references.end() ? nullptr : &reference->second);
      },
      [&](std::size_t i, const JobResult& result) {
        const PhysicsPoint& point = plan.points[todo[i]];
        if (result.good) {
          table->Add(todo[i], result.text);
        } else if (result.text.rfind("crashed", 0) == 0) {   // the engine gave up: a result
          table->Add(todo[i], CrashedRow(point, result.text));
        } else {
          ++failed;
          std::fprintf(stderr, "seam-lab: failed: %s: %s\n", PhysicsKey(point).c_str(),
                       result.text.c_str());
        }
        progress(i + 1);
      },
      [] { return g_stop != 0; });
  return failed;
}

}  // namespace

int RunPhysics(const PhysicsCommand& command) {
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const int jobs = command.jobs > 0 ? command.jobs : cores;
  const GridSize size = SizeOf(command.grid);
  const std::vector<const HardCase*> cases = ChosenCases(command.cases);
  StopOnSignals();
  const std::vector<double> awake = AwakeShares(cases, size, command.folder, jobs);
  if (g_stop != 0) return 1;   // before there was a plan
  const PhysicsPlan plan = PlanPhysics(cases, size, awake, command.folder);
  std::vector<std::string> keys;
  for (const PhysicsPoint& point : plan.points) keys.push_back(PhysicsKey(point));
  SweepTable table(command.table, PhysicsHeader(), kPhysicsKeyColumns, keys, command.force);
  const std::size_t before = table.count();
  std::vector<std::size_t> todo;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (!table.Has(i)) todo.push_back(i);
  }
  for (const std::string& line : plan.left_out) {
    if (!command.quiet) std::fprintf(stderr, "%s\n", line.c_str());
  }
  const std::size_t failed = RunPoints(plan, todo, jobs, command.quiet, &table);
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < keys.size(); ++i) lines.push_back(table.line(i));
  PrintPhysics(plan, lines);
  std::printf("%s: %zu of %zu rows, %zu of them new", command.table.c_str(), table.count(),
              keys.size(), table.count() - before);
  if (failed > 0) std::printf("; %zu runs failed", failed);
  if (g_stop != 0) std::printf("; stopped: the same command goes on");
  std::printf("\n");
  return table.count() == keys.size() ? 0 : 1;
}

}  // namespace seam
