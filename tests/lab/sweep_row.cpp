#include "tests/lab/sweep_row.h"

#include <fmt/format.h>

#include "common/base/bytes.h"
#include "common/base/process.h"
#include "common/measure/measure.h"

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

/// ",value", or "," where it does not apply.
std::string Number(double value, bool applies) {
  return applies ? fmt::format(",{:.6g}", value) : ",";
}

std::string Values(const Recording& recording, bool floor) {
  const Oracle oracle = ComputeOracle(recording);
  const Measures m = Measure(recording, oracle);
  const bool any = m.compared > 0;
  std::string line;
  for (const double error : {m.error_rms_m, m.error_p95_m, m.error_max_m, m.error_rms_rad,
                             m.stutter_mps2}) {
    line += Number(error, any);
  }
  line += any ? fmt::format(",{}", m.backsteps) : ",";
  line += Number(m.seam_rms_m.value_or(0), m.seam_rms_m.has_value());
  line += Number(m.seam_stutter_mps2.value_or(0), m.seam_stutter_mps2.has_value());
  line += Number(m.rebound.value_or(0), m.rebound.has_value());
  line += Number(m.rest_ticks.value_or(0), m.rest_ticks.has_value());
  line += fmt::format(",{}", m.handovers) + Number(m.handover_jump_m, any);
  line += Number(floor ? ErrorFloor(recording, oracle, kNudge) : 0, floor);
  line += Number(floor ? ErrorFloor(recording, oracle, kWireNudge) : 0, floor);
  return line + Number(m.bytes_per_s, m.bytes_per_s > 0) + fmt::format(",{}", m.compared);
}

}  // namespace

std::string SweepHeader() {
  return GridHeader() +
         ",error_rms_m,error_p95_m,error_max_m,error_rms_rad,stutter_mps2,backsteps,"
         "seam_rms_m,seam_stutter_mps2,rebound,rest_ticks,handovers,handover_jump_m,floor_m,"
         "floor_wire_m,bytes_per_s,compared,digest,cpu_s";
}

std::string SweepRow(const GridPoint& point, bool floor) {
  ClusterConfig config = Configure(point.settings, *point.scene);
  Digest digest;
  config.recorder = &digest;
  const std::int64_t begin_us = CpuUs();
  Cluster cluster(config);
  cluster.Run();
  const double cpu_s = static_cast<double>(CpuUs() - begin_us) * 1e-6;
  return point.key + Values(cluster.recording(), floor) +
         fmt::format(",{:016x},{:.3f}", digest.value(), cpu_s);
}

}  // namespace seam
