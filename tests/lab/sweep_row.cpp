#include "tests/lab/sweep_row.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "common/base/bytes.h"
#include "common/base/process.h"
#include "common/measure/limit/held_inputs.h"
#include "common/measure/measure.h"
#include "common/measure/preconditions.h"
#include "common/measure/screen/response.h"
#include "tests/lab/validity/loss.h"

namespace seam {
namespace {

/// A hash of all that is published: two runs of one digest would have written the same log.
class Digest : public Recorder {
 public:
  void Publish(const std::string& channel, std::int64_t utime, ByteView message) override {
    value_ = Fnv1a(channel.data(), channel.size(), value_);
    value_ = Fnv1a(&utime, sizeof utime, value_);
    value_ = Fnv1a(message.data, message.size, value_);
  }
  void EndTick(const std::string&, const LogSeal&, bool) override {}  // says no more than the rest
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = Fnv1a("", 0);
};

/// Six digits; whole numbers in full. An absent value is empty.
Value Number(const char* column, std::optional<double> value) {
  const bool whole = value && *value == std::floor(*value) && std::fabs(*value) < 1e15;
  return whole ? Decimals(column, *value, 0) : Significant(column, value);
}

/// What is computed beside the measures: of the oracles alone, so the same for all methods.
struct Floors {
  std::optional<double> floor_m, wire_m, barrier_m;
  std::optional<double> limit_m;  ///< of this recording's network
};

/// Everything that is known of a run.
struct SweptRun {
  Measures measures;
  Floors floors;
  std::int64_t stepped_again = 0, deferred = 0;  ///< of all peers
  bool barriers = false;                         ///< the oracle had them
  std::string invalid;                           ///< why the measures say nothing
  std::uint64_t digest = 0;
  double cpu_s = 0, server_cpu_s = 0, server_us_per_body = 0;
};

Values MeasureValues(const SweptRun& run) {
  const Measures& m = run.measures;
  const auto given = [](bool applies, double value) {
    return applies ? std::optional<double>(value) : std::nullopt;
  };
  const bool any = m.compared > 0;
  return {Number("error_others_m", m.error_others_m),
          Number("error_own_m", m.error_own_m),
          Number("error_server_m", m.error_server_m),
          Number("error_served_m", m.error_served_m),
          Number("inputs_late", m.inputs_late),
          Number("path_error_rms_m", m.path_error_rms_m),
          Number("view_age_ms", m.view_age_ms),
          Number("response_own_ms", m.response_own_ms),
          Number("response_server_ms", m.response_server_ms),
          Number("response_other_ms", m.response_other_ms),
          Number("seen", m.seen),
          Number("overlap_p99_m", m.overlap_p99_m),
          Number("energy_ratio_min", m.energy_ratio_min),
          Number("energy_ratio_max", m.energy_ratio_max),
          Number("hottest_ratio", m.hottest_ratio),
          Number("error_rms_m", given(any, m.error_rms_m)),
          Number("error_p95_m", given(any, m.error_p95_m)),
          Number("error_max_m", given(any, m.error_max_m)),
          Number("error_rms_rad", given(any, m.error_rms_rad)),
          Number("stutter_mps2", given(any, m.stutter_mps2)),
          Number("stutter_shown_mps2", given(any, m.stutter_shown_mps2)),
          Number("backsteps", given(any, static_cast<double>(m.backsteps))),
          Number("seam_rms_m", m.seam_rms_m),
          Number("seam_stutter_mps2", m.seam_stutter_mps2),
          Number("rebound", m.rebound),
          Number("rest_ticks", m.rest_ticks),
          Number("jitter_rest_mps", m.jitter_rest_mps),
          Number("penetration_m", m.penetration_m),
          Number("oracle_penetration_m", m.oracle_penetration_m),
          Number("joint_drift_m", m.joint_drift_m),
          Number("oracle_joint_drift_m", m.oracle_joint_drift_m),
          Number("energy_gain_j", m.energy_gain_j),
          Number("handovers", static_cast<double>(m.handovers)),
          Number("handover_jump_m", given(m.handovers > 0, m.handover_jump_m)),
          Number("handover_gap_m", m.handover_gap_m),
          Number("handover_dv_mps", m.handover_dv_mps),
          Number("handover_gap_p95_m", m.handover_gap_p95_m),
          Number("handover_dv_p95_mps", m.handover_dv_p95_mps),
          Number("topology_lag_s", m.topology_lag_s),
          Number("lost", given(m.lost.has_value(), static_cast<double>(m.lost.value_or(0)))),
          Number("left_bounds", given(m.lost.has_value(), static_cast<double>(m.left_bounds))),
          Number("floor_m", run.floors.floor_m),
          Number("floor_wire_m", run.floors.wire_m),
          Number("floor_barrier_m", run.floors.barrier_m),
          Number("info_limit_m", run.floors.limit_m),
          Number("bytes_per_s", given(m.bytes_per_s > 0, m.bytes_per_s)),
          Number("sent_bytes_per_s", given(m.sent_bytes_per_s > 0, m.sent_bytes_per_s)),
          Number("ticks_stepped_again", static_cast<double>(run.stepped_again)),
          Number("replays_deferred", static_cast<double>(run.deferred)),
          Number("compared", static_cast<double>(m.compared))};
}

Values ValuesOf(const GridPoint& point, const SweptRun& run) {
  Values values = PointValues(point);
  const Values measures = MeasureValues(run);
  const Values shown = run.invalid.empty() ? measures : Emptied(measures);
  values.insert(values.end(), shown.begin(), shown.end());
  const Values last = {{"oracle", run.barriers ? "barrier" : "plain"},
                       {"valid", run.invalid},
                       {"digest", fmt::format("{:016x}", run.digest)},
                       Decimals("cpu_s", run.cpu_s, 4),
                       Decimals("server_cpu_s", run.server_cpu_s, 4),
                       Decimals("server_us_per_body", run.server_us_per_body, 4)};
  values.insert(values.end(), last.begin(), last.end());
  return values;
}

/// Measures a session that has ended, and decides by which oracle and whether the measures mean
/// anything.
void JudgeRun(const GridPoint& point, const SweepOptions& options, Cluster* cluster,
              SweptRun* run) {
  const Recording& recording = cluster->recording();
  run->barriers = JudgedByBarriers(recording.room);
  const Oracle plain = ComputeOracle(recording);
  std::optional<Oracle> with_barriers;
  if (run->barriers || options.floor) {
    with_barriers = ComputeOracle(recording, WithBarriers(recording.room));
  }
  const Oracle& oracle = run->barriers ? *with_barriers : plain;
  run->measures = Measure(recording, oracle);
  MeasureResponse(recording, oracle, &run->measures);
  run->invalid = WhyNotValid(recording, oracle, run->measures);
  const ImpairProfile network = FindProfile(point.settings.impair);
  if (run->invalid.empty() && LossTooSmall(network, cluster->server_net().traffic())) {
    run->invalid = "the network lost less than its profile says";
  }
  run->stepped_again = cluster->ticks_stepped_again();
  run->deferred = cluster->replays_deferred();
  if (!run->invalid.empty()) return;
  if (options.floor) {
    run->floors.floor_m = ErrorFloor(recording, plain, kNudge);
    run->floors.wire_m = ErrorFloor(recording, plain, kWireNudge);
    run->floors.barrier_m = OracleDistance(recording, plain, *with_barriers);
  }
  if (options.limit) run->floors.limit_m = HeldInputsError(recording);
}

GridPoint BlankPoint() {
  GridPoint blank;
  blank.scene = std::make_shared<Scene>();
  return blank;
}

}  // namespace

std::string SweepKeyColumns() { return CsvColumns(GridKey(BlankPoint())); }

std::string SweepValueColumns() { return CsvColumns(ValuesOf(BlankPoint(), {})); }

Values SweepValues(const GridPoint& point, const SweepOptions& options) {
  ClusterConfig config = Configure(point.settings, *point.scene);
  Digest digest;
  config.recorder = &digest;
  const std::int64_t begin_us = CpuUs();
  Cluster cluster(config);
  cluster.Run();
  RequireScripts(cluster.server());
  SweptRun run;
  run.cpu_s = static_cast<double>(CpuUs() - begin_us) * 1e-6;
  run.digest = digest.value();
  run.server_cpu_s = cluster.server_cpu_us() * 1e-6;
  const int bodies = std::max(1, cluster.server().replica().world().body_count());
  const std::int64_t ticks = std::max<std::int64_t>(1, cluster.server().tick());
  run.server_us_per_body = cluster.server_cpu_us() / (bodies * static_cast<double>(ticks));
  JudgeRun(point, options, &cluster, &run);
  return ValuesOf(point, run);
}

}  // namespace seam
