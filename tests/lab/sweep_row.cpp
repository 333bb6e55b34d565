#include "tests/lab/sweep_row.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <vector>

#include "common/base/bytes.h"
#include "common/base/process.h"
#include "common/measure/measure.h"
#include "common/measure/screen/response.h"

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
std::string Number(double value) {
  const bool whole = value == std::floor(value) && std::fabs(value) < 1e15;
  return whole ? fmt::format(",{:.0f}", value) : fmt::format(",{:.6g}", value);
}

/// A column's name, and its value if it applies.
struct Column {
  const char* name;
  std::optional<double> value;
};

/// All columns of the measures, in order.
std::vector<Column> Columns(const Measures& m, std::optional<double> floor_m,
                            std::optional<double> floor_wire_m) {
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
          {"floor_m", floor_m},
          {"floor_wire_m", floor_wire_m},
          {"bytes_per_s", given(m.bytes_per_s > 0, m.bytes_per_s)},
          {"sent_bytes_per_s", given(m.sent_bytes_per_s > 0, m.sent_bytes_per_s)},
          {"compared", static_cast<double>(m.compared)}};
}

std::string Values(const Recording& recording, bool floor) {
  const Oracle oracle = ComputeOracle(recording);
  std::optional<double> floor_m, floor_wire_m;
  if (floor) {
    floor_m = ErrorFloor(recording, oracle, kNudge);
    floor_wire_m = ErrorFloor(recording, oracle, kWireNudge);
  }
  Measures measures = Measure(recording, oracle);
  MeasureResponse(recording, oracle, 0, &measures);
  std::string line;
  for (const Column& column : Columns(measures, floor_m, floor_wire_m)) {
    line += column.value ? Number(*column.value) : ",";
  }
  return line;
}

}  // namespace

std::string SweepHeader() {
  std::string header = GridHeader() + "," + PointHeader();
  for (const Column& column : Columns({}, {}, {})) header += std::string(",") + column.name;
  return header + ",digest,cpu_s";
}

std::string SweepRow(const GridPoint& point, bool floor) {
  ClusterConfig config = Configure(point.settings, *point.scene);
  Digest digest;
  config.recorder = &digest;
  const std::int64_t begin_us = CpuUs();
  Cluster cluster(config);
  cluster.Run();
  const double cpu_s = static_cast<double>(CpuUs() - begin_us) * 1e-6;
  return point.key + PointValues(point) + Values(cluster.recording(), floor) +
         fmt::format(",{:016x},{:.4f}", digest.value(), cpu_s);
}

}  // namespace seam
