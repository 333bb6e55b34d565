#include <fmt/format.h>

#include <cstdio>

#include "common/base/bytes.h"
#include "common/base/check.h"
#include "common/base/find_scene.h"
#include "common/base/process.h"
#include "common/measure/table.h"
#include "tests/lab/commands.h"
#include "tests/lab/load/load.h"
#include "tests/lab/rows.h"
#include "tests/lab/scene_settings.h"

namespace seam {
namespace {

const char* const kKeyHeader = "version,scene,scene_hash,method,network,seed";
constexpr int kKeyColumns = 6;
const char* const kColumns =
    ",valid,players,bodies,awake,stepped,server_us_per_tick,server_p99_us,client_us_per_tick,"
    "to_client_kb_per_s,from_client_kb_per_s,held_share,split_share";

/// "buffer", "buffer/rollback", "central/own": the mode, and its rule or what it predicts.
void SetMethod(const std::string& method, SessionSettings* settings) {
  const std::size_t slash = method.find('/');
  settings->mode = method.substr(0, slash);
  const std::string detail = slash == std::string::npos ? "" : method.substr(slash + 1);
  (settings->mode == "central" ? settings->predict : settings->reconcile) = detail;
}

std::string Figures(const SessionLoad& load) {
  return fmt::format(",,{},{},{:.1f},{:.1f},{:.1f},{:.1f},{:.1f},{:.2f},{:.2f},{:.4f},{:.4f}",
                     load.players, load.bodies, load.awake, load.stepped, load.server_us,
                     load.server_p99_us, load.client_us, load.to_client_kbps, load.from_client_kbps,
                     load.held_share, load.split_share);
}

}  // namespace

int RunLoad(const LoadCommand& command) {
  std::vector<SessionSettings> runs;
  std::vector<std::string> keys;
  // Methods of one scene and seed one after the other: they are compared.
  for (const std::string& name : command.scenes) {
    SessionSettings settings;
    settings.scene = FindScene(name);
    settings.duration_s = command.seconds;
    settings.drive = command.drive;
    settings.impair = command.network;
    const Scene scene = LoadSceneWith(settings.scene, {});
    const auto hash = Fnv1a(scene.text.data(), scene.text.size());
    for (int seed = 1; seed <= command.seeds; ++seed) {
      for (const std::string& method : command.methods) {
        settings.seed = seed;
        settings.mode = settings.reconcile = settings.predict = "";
        SetMethod(method, &settings);
        Configure(settings, scene);  // throws what is wrong
        runs.push_back(settings);
        keys.push_back(fmt::format("{},{},{:016x},{},{},{}", kLabVersion, CsvField(scene.name),
                                   hash, method, CsvField(command.network), seed));
      }
    }
  }
  SweepTable table(command.table, std::string(kKeyHeader) + kColumns, kKeyColumns, keys,
                   command.force);
  StopOnSignals();
  RowMaker maker;
  maker.make = [&](std::size_t row) {
    return keys[row] + Figures(MeasureLoad(Configure(runs[row])));
  };
  const RowsDone done =
      MakeRows(keys, MissingRows(table, keys.size()), maker, command.jobs, command.quiet, &table);
  return PrintRows(command.table, table, keys.size(), done);
}

}  // namespace seam
