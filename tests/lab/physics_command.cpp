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
#include "tests/lab/experiment/experiment.h"
#include "tests/lab/experiment/jobs.h"
#include "tests/lab/physics_row.h"

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

/// Makes the rows of a plan. A crash is a result: the engine gave up.
Experiment PhysicsExperiment(const PhysicsPlan& plan, const References& references) {
  Experiment experiment;
  experiment.key_columns = PhysicsKeyColumns();
  experiment.value_columns = PhysicsValueColumns();
  for (const PhysicsPoint& point : plan.points) {
    experiment.keys.push_back(CsvRow(PhysicsKey(point)));
  }
  experiment.measure = [&](std::size_t row) {
    const PhysicsPoint& point = plan.points[row];
    const auto reference = references.find(point.hard);
    return CsvRow(
        PhysicsValues(point, reference == references.end() ? nullptr : &reference->second));
  };
  experiment.rescue = [](std::size_t, const std::string& why) -> std::optional<std::string> {
    if (why.rfind("crashed", 0) != 0) return std::nullopt;
    return CsvRow(CrashedValues(why));
  };
  return experiment;
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

/// Opens the table at its usual place. It is begun anew when it is of another version of the
/// scenes: nobody asked for it to be kept.
std::unique_ptr<ResultTable> OpenUsualTable(const Experiment& experiment, TableFlags flags) {
  std::error_code ignored;  // the table says that it cannot be written
  fs::create_directories(fs::path(flags.table).parent_path(), ignored);
  try {
    return OpenTable(experiment, flags);
  } catch (const OperatorError&) {
    flags.force = true;
    return OpenTable(experiment, flags);
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
  TableFlags& flags = command.output;
  const bool draws = flags.table.empty();
  if (draws && command.scenes.empty()) throw OperatorError("-o FILE says where the table goes");
  const GridSize size = SizeOf(command.grid);
  const std::vector<HardCase> own = OwnCases(command);
  std::vector<const HardCase*> cases = ChosenCases(command.cases, !own.empty());
  for (const HardCase& hard : own) cases.push_back(&hard);
  if (draws) flags.table = UsualTable(own).string();
  StopOnSignals();
  const std::vector<double> awake = AwakeShares(cases, size, command.folder, JobsOr(flags.jobs));
  if (g_stop != 0) return 1;  // before there was a plan
  const PhysicsPlan plan = PlanPhysics(cases, size, awake, command.folder);
  References references;
  const Experiment experiment = PhysicsExperiment(plan, references);
  const std::size_t rows = experiment.keys.size();
  const auto table = draws ? OpenUsualTable(experiment, flags) : OpenTable(experiment, flags);
  for (const std::string& line : plan.left_out) {
    if (!flags.quiet) std::fprintf(stderr, "%s\n", line.c_str());
  }
  references = MakeReferences(plan, MissingRows(*table, rows));
  const RowsDone done = MakeRows(experiment, flags, table.get());
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < rows; ++i) lines.push_back(table->line(i));
  std::printf("%s", CaseLines(own).c_str());
  PrintPhysics(plan, lines);
  const int status = PrintRows(flags, *table, rows, done);
  if (!own.empty() && table->count() > 0) std::printf("%s", FrontLines(flags.table).c_str());
  if (draws && status == 0) DrawTable(flags.table);
  return status;
}

}  // namespace seam
