#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>

#include "common/base/check.h"
#include "common/base/find_scene.h"
#include "common/base/nearest.h"
#include "common/base/process.h"
#include "tests/lab/commands.h"
#include "tests/lab/exact/front.h"
#include "tests/lab/exact/scene_case.h"
#include "tests/lab/jobs.h"
#include "tests/lab/physics_row.h"
#include "tests/lab/rows.h"

namespace seam {
namespace {

namespace fs = std::filesystem;

/// Of hard cases by name: all without names, unless there are scenes.
std::vector<const HardCase*> ChosenCases(const std::vector<std::string>& names, bool scenes) {
  std::vector<const HardCase*> chosen;
  std::string known;
  for (const HardCase& hard : HardCases()) {
    const bool named = std::count(names.begin(), names.end(), hard.name) > 0;
    if (named || (names.empty() && !scenes)) chosen.push_back(&hard);
    known += (known.empty() ? "" : ", ") + hard.name;
  }
  for (const std::string& name : names) {
    if (std::none_of(chosen.begin(), chosen.end(),
                     [&name](const HardCase* hard) { return hard->name == name; })) {
      std::vector<std::string> all;
      for (const HardCase& hard : HardCases()) all.push_back(hard.name);
      throw OperatorError("no hard case '" + name + "' (there are " + known + ")" +
                          DidYouMean(name, all));
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

/// The error of the stock setting; infinite when it diverges or takes its process with it.
double StockError(const HardCase& hard, const Scene& scene, const Reference& reference) {
  double error = std::numeric_limits<double>::infinity();
  RunJobs(
      1, 1,
      [&](std::size_t) {
        const Scene stock = WithSolver(scene, StockSolver());
        const Observation seen = Observe(hard, stock, hard.seconds, &reference.finest);
        return fmt::format("{}", seen.error);
      },
      [&](std::size_t, const JobResult& result) {
        if (result.good) error = std::stod(result.text);
      },
      [] { return g_stop != 0; });
  return error;
}

/// Of the cases with rows to come that have no judge.
References MakeReferences(const PhysicsPlan& plan, const std::vector<std::size_t>& todo) {
  References references;
  for (const std::size_t i : todo) {
    const PhysicsPoint& point = plan.points[i];
    if (point.hard->judge || references.count(point.hard) != 0 || g_stop != 0) continue;
    const auto own = std::find_if(
        plan.points.begin(), plan.points.end(),
        [&](const PhysicsPoint& p) { return p.hard == point.hard && p.role == "scene"; });
    Reference made = MakeReference(own->scene, point.hard->seconds);
    made.stock_m = StockError(*point.hard, own->scene, made);
    references.emplace(point.hard, std::move(made));
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

/// The user's own scenes as cases.
std::vector<HardCase> OwnCases(const PhysicsCommand& command) {
  std::vector<std::string> files;
  for (const std::string& word : command.scenes) files.push_back(FindScene(word));
  return SceneCases(files, command.seconds);
}

/// Where the table of these scenes goes if nobody says.
fs::path UsualTable(const std::vector<HardCase>& own) {
  std::string names;
  for (const HardCase& hard : own) names += (names.empty() ? "" : "+") + hard.name;
  return fs::path("out/physics") / names / "physics.csv";
}

/// The table to complete. One at the usual place is begun anew when it is of another version of the
/// scenes: nobody asked for it to be kept.
std::unique_ptr<SweepTable> OpenTable(const PhysicsCommand& command, bool usual_place,
                                      const std::vector<std::string>& keys) {
  const auto open = [&](bool force) {
    return std::make_unique<SweepTable>(command.table, PhysicsHeader(), kPhysicsKeyColumns, keys,
                                        force);
  };
  if (!usual_place || command.force) return open(command.force);
  std::error_code ignored;  // the table says that it cannot be written
  fs::create_directories(fs::path(command.table).parent_path(), ignored);
  try {
    return open(false);
  } catch (const OperatorError&) {
    return open(true);
  }
}

/// The plots and tables of a folder's physics.csv. Without gnuplot there are none, which is said.
void DrawTable(const fs::path& table) {
  ReportCommand report;
  report.data = report.out = table.parent_path().string();
  try {
    RunReport(report);
  } catch (const OperatorError& e) {
    std::fprintf(stderr, "no plots: %s\n", e.what());
  }
}

}  // namespace

int RunPhysics(const PhysicsCommand& given) {
  PhysicsCommand command = given;
  const bool draws = command.table.empty();
  if (draws && command.scenes.empty()) throw OperatorError("-o FILE says where the table goes");
  const int jobs = JobsOr(command.jobs);
  const GridSize size = SizeOf(command.grid);
  const std::vector<HardCase> own = OwnCases(command);
  std::vector<const HardCase*> cases = ChosenCases(command.cases, !own.empty());
  for (const HardCase& hard : own) cases.push_back(&hard);
  if (draws) command.table = UsualTable(own).string();
  StopOnSignals();
  const std::vector<double> awake = AwakeShares(cases, size, command.folder, jobs);
  if (g_stop != 0) return 1;  // before there was a plan
  const PhysicsPlan plan = PlanPhysics(cases, size, awake, command.folder);
  std::vector<std::string> keys;
  for (const PhysicsPoint& point : plan.points) keys.push_back(PhysicsKey(point));
  const std::unique_ptr<SweepTable> table = OpenTable(command, draws, keys);
  const std::vector<std::size_t> todo = MissingRows(*table, keys.size());
  for (const std::string& line : plan.left_out) {
    if (!command.quiet) std::fprintf(stderr, "%s\n", line.c_str());
  }
  const References references = MakeReferences(plan, todo);
  const RowsDone done =
      MakeRows(keys, todo, PhysicsRows(plan, references), jobs, command.quiet, table.get());
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < keys.size(); ++i) lines.push_back(table->line(i));
  std::printf("%s", CaseLines(own).c_str());
  PrintPhysics(plan, lines);
  const int status = PrintRows(command.table, *table, keys.size(), done);
  if (!own.empty() && table->count() > 0) std::printf("%s", FrontLines(command.table).c_str());
  if (draws && status == 0) DrawTable(command.table);
  return status;
}

}  // namespace seam
