#include <fmt/format.h>

#include <cstdio>

#include "common/base/bytes.h"
#include "common/base/find_scene.h"
#include "common/base/process.h"
#include "common/measure/table.h"
#include "common/sync/blend/reconcile.h"
#include "tests/lab/commands.h"
#include "tests/lab/fairness/fairness.h"
#include "tests/lab/report/sessions/fairness_section.h"
#include "tests/lab/rows.h"
#include "tests/lab/scene_settings.h"

namespace seam {
namespace {

const char* const kKeyHeader = "version,scene,scene_hash,method,near_path,far_path,drive,near,seed";
constexpr int kKeyColumns = 9;
const char* const kHeader =
    ",valid,crash_tick,closing_mps,momentum_oracle_ns,momentum_near_own_ns,momentum_far_own_ns,"
    "momentum_near_server_ns,momentum_far_server_ns,advantage_own_ns,advantage_server_ns";
/// Of the rows of a table, so many at most may be invalid.
constexpr double kInvalidShareMax = 0.1;

std::vector<std::string> AllMethods() {
  std::vector<std::string> methods = {"oracle", "central", "strict"};
  for (const NamedReconciler& rule : Reconcilers()) {
    methods.push_back(std::string("buffer/") + rule.name);
  }
  return methods;
}

FairnessRun MakeRun(const FairnessCommand& command, const std::string& method, bool random,
                    int near, int seed) {
  FairnessRun run;
  run.random = random;
  run.near_path = command.near_path;
  run.far_path = command.far_path;
  run.near = near;
  run.session.scene = FindScene(command.scene);
  run.session.seed = seed;
  const std::size_t slash = method.find('/');
  run.session.mode = method.substr(0, slash);
  if (slash != std::string::npos) run.session.reconcile = method.substr(slash + 1);
  return run;
}

std::string Figures(const FairnessResult& r) {
  if (!r.invalid.empty()) return "," + CsvField(r.invalid) + ",,,,,,,,,";
  return fmt::format(",,{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}", r.crash,
                     r.closing_mps, r.oracle_ns, r.own_ns[0], r.own_ns[1], r.server_ns[0],
                     r.server_ns[1], r.advantage_own_ns(), r.advantage_server_ns());
}

}  // namespace

int RunFairnessTable(const FairnessCommand& command) {
  const Scene scene = LoadSceneWith(FindScene(command.scene), {});
  std::vector<FairnessRun> runs;
  std::vector<std::string> keys;
  const auto hash = Fnv1a(scene.text.data(), scene.text.size());
  const auto add = [&](const std::string& method, bool random, int seed, int near) {
    runs.push_back(MakeRun(command, method, random, near, seed));
    Configure(runs.back().session, scene);  // throws what is wrong with the method
    keys.push_back(fmt::format(
        "{},{},{:016x},{},{},{},{},{},{}", kLabVersion, CsvField(command.scene), hash,
        CsvField(method), CsvField(command.near_path), CsvField(command.far_path),
        random ? "random" : "script", scene.players.at(static_cast<std::size_t>(near)).name, seed));
  };
  for (const bool random : {false, true}) {
    for (const std::string& method : command.methods.empty() ? AllMethods() : command.methods) {
      for (int seed = 1; seed <= command.seeds; ++seed) {
        for (const int near : {0, 1}) add(method, random, seed, near);
      }
    }
  }
  SweepTable table(command.table, std::string(kKeyHeader) + kHeader, kKeyColumns, keys,
                   command.force);
  StopOnSignals();
  RowMaker maker;
  maker.make = [&](std::size_t row) { return keys[row] + Figures(RunFairness(runs[row])); };
  const RowsDone done = MakeRows(keys, MissingRows(table, keys.size()), maker, JobsOr(command.jobs),
                                 command.quiet, &table);
  const int status = PrintRows(command.table, table, keys.size(), done);
  const CsvTable csv = CsvTable::Load(command.table);
  for (const char* drive : {"script", "random"}) {
    const TextTable shown = FairnessTable(csv, drive, "seam-lab fairness -o " + command.table);
    std::printf("\n%s\n\n%s", shown.title.c_str(), Markdown(shown).c_str());
  }
  const std::size_t invalid = InvalidRows(csv);
  if (static_cast<double>(invalid) <= kInvalidShareMax * static_cast<double>(csv.rows())) {
    return status;
  }
  std::fprintf(stderr, "seam-lab: %s: %zu of %zu rows are not valid\n", command.table.c_str(),
               invalid, csv.rows());
  return 1;
}

}  // namespace seam
