#include "tests/lab/sweep_row.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "common/base/bytes.h"
#include "common/base/process.h"
#include "common/measure/limit/information_limit.h"
#include "common/measure/measure.h"
#include "common/measure/preconditions.h"
#include "common/measure/screen/response.h"
#include "common/measure/table.h"
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
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = Fnv1a("", 0);
};

/// Six digits; counts are whole.
std::string Digits6(double value) {
  const bool whole = value == std::floor(value) && std::fabs(value) < 1e15;
  return whole ? fmt::format(",{:.0f}", value) : fmt::format(",{:.6g}", value);
}

/// A column's name, and its value if it applies.
struct SweepColumn {
  const char* name;
  std::optional<double> value;
};

/// What is computed beside the measures: of the oracles alone, so the same for all methods.
struct Floors {
  std::optional<double> floor_m, wire_m, barrier_m;
  std::optional<double> limit_m;  ///< of this recording's network
};

/// What it took, of all peers.
struct StepWork {
  std::int64_t stepped_again = 0, deferred = 0;
};

/// All columns of the measures, in order.
std::vector<SweepColumn> Columns(const Measures& m, const Floors& floors, const StepWork& work) {
  const auto given = [](bool applies, double value) {
    return applies ? std::optional<double>(value) : std::nullopt;
  };
  const bool any = m.compared > 0;
  return {{"error_others_m", m.error_others_m},
          {"error_own_m", m.error_own_m},
          {"error_server_m", m.error_server_m},
          {"path_error_rms_m", m.path_error_rms_m},
          {"view_age_ms", m.view_age_ms},
          {"response_own_ms", m.response_own_ms},
          {"response_server_ms", m.response_server_ms},
          {"response_other_ms", m.response_other_ms},
          {"seen", m.seen},
          {"energy_ratio_min", m.energy_ratio_min},
          {"energy_ratio_max", m.energy_ratio_max},
          {"hottest_ratio", m.hottest_ratio},
          {"error_rms_m", given(any, m.error_rms_m)},
          {"error_p95_m", given(any, m.error_p95_m)},
          {"error_max_m", given(any, m.error_max_m)},
          {"error_rms_rad", given(any, m.error_rms_rad)},
          {"stutter_mps2", given(any, m.stutter_mps2)},
          {"backsteps", given(any, static_cast<double>(m.backsteps))},
          {"seam_rms_m", m.seam_rms_m},
          {"seam_stutter_mps2", m.seam_stutter_mps2},
          {"rebound", m.rebound},
          {"rest_ticks", m.rest_ticks},
          {"jitter_rest_mps", m.jitter_rest_mps},
          {"penetration_m", m.penetration_m},
          {"oracle_penetration_m", m.oracle_penetration_m},
          {"joint_drift_m", m.joint_drift_m},
          {"oracle_joint_drift_m", m.oracle_joint_drift_m},
          {"energy_gain_j", m.energy_gain_j},
          {"handovers", static_cast<double>(m.handovers)},
          {"handover_jump_m", given(m.handovers > 0, m.handover_jump_m)},
          {"handover_gap_m", m.handover_gap_m},
          {"handover_dv_mps", m.handover_dv_mps},
          {"handover_gap_p95_m", m.handover_gap_p95_m},
          {"handover_dv_p95_mps", m.handover_dv_p95_mps},
          {"topology_lag_s", m.topology_lag_s},
          {"lost", m.lost ? std::optional<double>(static_cast<double>(*m.lost)) : std::nullopt},
          {"left_bounds", given(m.lost.has_value(), static_cast<double>(m.left_bounds))},
          {"floor_m", floors.floor_m},
          {"floor_wire_m", floors.wire_m},
          {"floor_barrier_m", floors.barrier_m},
          {"info_limit_m", floors.limit_m},
          {"bytes_per_s", given(m.bytes_per_s > 0, m.bytes_per_s)},
          {"sent_bytes_per_s", given(m.sent_bytes_per_s > 0, m.sent_bytes_per_s)},
          {"ticks_stepped_again", static_cast<double>(work.stepped_again)},
          {"replays_deferred", static_cast<double>(work.deferred)},
          {"compared", static_cast<double>(m.compared)}};
}

/// `valid` empty: with their figures.
std::string Values(const Measures& measures, const Floors& floors, const StepWork& work,
                   const std::string& valid) {
  std::string line;
  for (const SweepColumn& column : Columns(measures, floors, work)) {
    line += column.value && valid.empty() ? Digits6(*column.value) : ",";
  }
  return line;
}

/// The measures of a run, whether they mean anything, and by which oracle.
std::string Judged(const GridPoint& point, const SweepOptions& options, Cluster* cluster) {
  const Recording& recording = cluster->recording();
  const bool barriers = JudgedByBarriers(recording.room);
  const Oracle plain = ComputeOracle(recording);
  std::optional<Oracle> with_barriers;
  if (barriers || options.floor) {
    with_barriers = ComputeOracle(recording, WithBarriers(recording.room));
  }
  const Oracle& oracle = barriers ? *with_barriers : plain;
  Measures measures = Measure(recording, oracle);
  MeasureResponse(recording, oracle, recording.room.input_delay_ticks, &measures);
  std::string reason = WhyNotValid(recording, oracle, measures);
  const ImpairProfile network = FindProfile(point.settings.impair);
  if (reason.empty() && LossTooSmall(network, cluster->server_net().traffic())) {
    reason = "the network lost less than its profile says";
  }
  Floors floors;
  if (options.floor && reason.empty()) {
    floors.floor_m = ErrorFloor(recording, plain, kNudge);
    floors.wire_m = ErrorFloor(recording, plain, kWireNudge);
    floors.barrier_m = OracleDistance(recording, plain, *with_barriers);
  }
  if (options.limit && reason.empty()) floors.limit_m = InformationLimit(recording);
  const StepWork work{cluster->ticks_stepped_again(), cluster->replays_deferred()};
  return Values(measures, floors, work, reason) + (barriers ? ",barrier," : ",plain,") +
         CsvField(reason);
}

}  // namespace

std::string SweepHeader() {
  std::string header = GridHeader() + "," + PointHeader();
  for (const SweepColumn& column : Columns({}, {}, {})) header += std::string(",") + column.name;
  return header + ",oracle,valid,digest,cpu_s,server_cpu_s,server_us_per_body";
}

std::string SweepRow(const GridPoint& point, const SweepOptions& options) {
  ClusterConfig config = Configure(point.settings, *point.scene);
  Digest digest;
  config.recorder = &digest;
  const std::int64_t begin_us = CpuUs();
  Cluster cluster(config);
  cluster.Run();
  const double cpu_s = static_cast<double>(CpuUs() - begin_us) * 1e-6;
  const int bodies = std::max(1, cluster.server().replica().world().body_count());
  const std::int64_t ticks = std::max<std::int64_t>(1, cluster.server().tick());
  return point.key + PointValues(point) + Judged(point, options, &cluster) +
         fmt::format(",{:016x},{:.4f},{:.4f},{:.4f}", digest.value(), cpu_s,
                     cluster.server_cpu_us() * 1e-6,
                     cluster.server_cpu_us() / (bodies * static_cast<double>(ticks)));
}

}  // namespace seam
