/// The recorded oracle: the views of a session in mode oracle.

#include <algorithm>

#include "common/base/check.h"
#include "common/measure/oracle.h"
#include "common/measure/revisions.h"
#include "common/sync/edits/edit_order.h"
#include "common/sync/method.h"

namespace seam {

std::vector<std::string> OracleMismatches(const Room& truth, const std::string& truth_path,
                                          const Room& measured, const std::string& path) {
  std::vector<std::string> lines;
  if (!PolicyOf(truth).IsOracle()) {
    lines.push_back(truth_path + ": made in mode " + truth.mode +
                    ", so it is no oracle (seam-server --mode oracle)");
  }
  if (truth.scene_text != measured.scene_text) {
    lines.push_back(path + ": its scene (" + measured.scene_name + ") is not the one of " +
                    truth_path + " (" + truth.scene_name + ")");
  }
  if (truth.tick_hz != measured.tick_hz) {
    lines.push_back(path + ": its tick rate (" + std::to_string(measured.tick_hz) +
                    ") is not the one of " + truth_path + " (" + std::to_string(truth.tick_hz) +
                    ")");
  }
  return lines;
}

void RequireOracleOf(const Room& truth, const std::string& truth_path, const Room& measured,
                     const std::string& path) {
  std::string all;
  for (const std::string& line : OracleMismatches(truth, truth_path, measured, path)) {
    all += (all.empty() ? "" : "; ") + line;
  }
  if (!all.empty()) throw OperatorError(all);
}

Oracle OracleFromRecording(const Recording& recording, const Recording* measured) {
  if (!PolicyOf(recording.room).IsOracle()) {
    throw OperatorError("the oracle's recording was made with --mode " + recording.room.mode +
                        ", not --mode oracle");
  }
  const auto views = recording.views.find(0);
  if (views == recording.views.end() || views->second.empty()) {
    throw OperatorError("the oracle's recording has no views of the server");
  }
  Oracle oracle;
  oracle.first_tick = views->second.begin()->first;
  const View& first = views->second.begin()->second;
  oracle.ids.assign(first.id.begin(), first.id.end());
  oracle.edits = EditsOf(recording);
  const bool scene_known = !recording.room.scene_text.empty();
  const bool changes = !oracle.edits.empty() || (measured && !measured->edits.empty());
  std::optional<Scene> scene;
  std::optional<RevisionHistory> revisions;
  if (scene_known && changes) {
    scene = RecordedScene(recording.room);
    revisions.emplace(*scene, recording);
  }
  const std::int64_t count = views->second.rbegin()->first - oracle.first_tick + 1;
  oracle.ticks.resize(static_cast<std::size_t>(count));
  int key = -1;
  for (const auto& [tick, view] : views->second) {
    const auto row = static_cast<std::size_t>(tick - oracle.first_tick);
    if (revisions && revisions->Key(view.revision) != key) {
      key = revisions->Key(view.revision);
      oracle.Begin(oracle.spans.empty() ? 0 : row, *revisions->At(key), key);
    }
    const std::vector<PartId>& ids = oracle.IdsOf(row);
    if (view.id.size() != ids.size() || !std::equal(ids.begin(), ids.end(), view.id.begin())) {
      continue;
    }
    auto& states = oracle.ticks[row];
    for (std::size_t i = 0; i < view.id.size(); ++i) states.push_back(StateIn(view, i));
  }
  if (scene && measured != nullptr) oracle.Identify(*measured, *scene);
  return oracle;
}

}  // namespace seam
