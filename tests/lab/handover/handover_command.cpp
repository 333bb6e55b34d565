#include <fmt/format.h>

#include "common/base/bytes.h"
#include "common/base/find_scene.h"
#include "common/base/process.h"
#include "common/measure/table.h"
#include "tests/lab/commands.h"
#include "tests/lab/handover/handover.h"
#include "tests/lab/rows.h"
#include "tests/lab/scene_settings.h"

namespace seam {
namespace {

const char* const kKeyHeader = "version,scene,scene_hash,players,network,seed";
constexpr int kKeyColumns = 6;
const char* const kColumns =
    ",valid,clients,mechanisms,changes_per_s,dropped_per_s,wish_p50_ms,wish_p99_ms,wish_max_ms,"
    "gap_p95_m,gap_p95_mps,compared,none_share,unsimulated_ticks,several,grants_kb_per_s,"
    "to_client_kb_per_s";

std::string Figures(const HandOvers& h) {
  return fmt::format(
      ",,{},{},{:.1f},{:.1f},{:.0f},{:.0f},{:.0f},{:.4f},{:.4f},{},{:.4f},{},{},{:.3f},{:.2f}",
      h.clients, h.mechanisms, h.per_s, h.dropped_per_s, h.p50_ms, h.p99_ms, h.max_ms, h.gap_p95_m,
      h.gap_p95_mps, h.compared, h.none_share, h.unsimulated, h.several, h.grants_kbps,
      h.to_client_kbps);
}

}  // namespace

int RunHandOver(const HandOverCommand& command) {
  std::vector<SessionSettings> runs;
  std::vector<std::string> keys;
  for (const std::string& name : command.scenes) {
    SessionSettings settings;
    settings.scene = FindScene(name);
    settings.duration_s = command.seconds;
    settings.drive = command.drive;
    settings.players = command.players;
    settings.impair = command.network;
    const Scene scene = LoadSceneWith(settings.scene, {});
    const auto hash = Fnv1a(scene.text.data(), scene.text.size());
    for (int seed = 1; seed <= command.seeds; ++seed) {
      settings.seed = seed;
      Configure(settings, scene);  // throws what is wrong
      runs.push_back(settings);
      keys.push_back(fmt::format("{},{},{:016x},{},{},{}", kLabVersion, CsvField(scene.name), hash,
                                 command.players, CsvField(command.network), seed));
    }
  }
  SweepTable table(command.table, std::string(kKeyHeader) + kColumns, kKeyColumns, keys,
                   command.force);
  StopOnSignals();
  RowMaker maker;
  maker.make = [&](std::size_t row) {
    return keys[row] + Figures(MeasureHandOvers(Configure(runs[row])));
  };
  const RowsDone done =
      MakeRows(keys, MissingRows(table, keys.size()), maker, command.jobs, command.quiet, &table);
  return PrintRows(command.table, table, keys.size(), done);
}

}  // namespace seam
