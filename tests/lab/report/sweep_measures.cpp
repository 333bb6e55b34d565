#include "common/base/check.h"
#include "tests/lab/report/sweep_view.h"

namespace seam {
namespace {

SweepMeasure Column(const char* id, const char* name, const char* unit, bool log,
                    const std::string& column, double scale = 1) {
  return {id, name, unit, log, [column, scale](const CsvTable& table, std::size_t row) {
            std::optional<double> value = table.Number(row, column);
            if (value) *value *= scale;
            return value;
          }};
}

}  // namespace

const std::vector<SweepMeasure>& SweepMeasures() {
  static const std::vector<SweepMeasure> measures = {
      Column("others", "error of others' bodies, RMS", "m", true, "error_others_m"),
      Column("own", "error of own bodies, RMS", "m", true, "error_own_m"),
      Column("served", "error against the server's own view, RMS", "m", true, "error_served_m"),
      Column("late", "own inputs that acted late", "inputs", false, "inputs_late"),
      Column("path", "error of the path shown, RMS", "m", true, "path_error_rms_m"),
      Column("age", "age of what is shown", "ms", false, "view_age_ms"),
      Column("response-own", "response, own screen", "ms", false, "response_own_ms"),
      Column("response-other", "response, others' screens", "ms", false, "response_other_ms"),
      Column("seen", "seen, share of body-seconds", "1 is all", false, "seen"),
      Column("overlap", "overlap of own and others' bodies beyond the oracle's, p99", "m", false,
             "overlap_p99_m"),
      Column("error", "error, RMS", "m", true, "error_rms_m"),
      Column("seam", "seam: peer against authority, RMS", "m", true, "seam_rms_m"),
      Column("stutter", "stutter, RMS", "m/s²", true, "stutter_mps2"),
      Column("rebound", "rebound", "1 is right", false, "rebound"),
      Column("penetration", "penetration, deepest", "m", true, "penetration_m"),
      Column("handover", "jump at hand-over, largest", "m", true, "handover_jump_m"),
      Column("gap", "gap at hand-over, largest", "m", true, "handover_gap_m"),
      Column("bytes", "traffic of a client", "kB/s", false, "bytes_per_s", 1e-3)};
  return measures;
}

const SweepMeasure& CpuMeasure() {
  static const SweepMeasure cpu = {
      "cpu", "CPU of server and clients", "ms per s", true,
      [](const CsvTable& table, std::size_t row) -> std::optional<double> {
        const std::optional<double> cpu_s = table.Number(row, "cpu_s");
        const std::optional<double> duration_s = table.Number(row, "duration_s");
        if (!cpu_s || !duration_s || *duration_s <= 0) return std::nullopt;
        return 1000 * *cpu_s / *duration_s;
      }};
  return cpu;
}

const SweepMeasure& ServerCpuMeasure() {
  static const SweepMeasure server = Column("server-cpu", "CPU of the server, of a body in a tick",
                                            "µs", true, "server_us_per_body");
  return server;
}

const std::vector<SweepMeasure>& FloorMeasures() {
  static const std::vector<SweepMeasure> floors = {
      Column("floor", "floor", "m", true, "floor_m"),
      Column("floor-wire", "floor of the wire", "m", true, "floor_wire_m"),
      Column("floor-barrier", "what barriers change", "m", true, "floor_barrier_m"),
      Column("info-limit", "inputs held", "m", true, "info_limit_m")};
  return floors;
}

const SweepMeasure& LimitMeasure() {
  static const SweepMeasure limit = {
      "limit", "error of others' bodies, by that of held inputs", "1: as held inputs", true,
      [](const CsvTable& table, std::size_t row) -> std::optional<double> {
        const std::optional<double> limit_m = table.Number(row, "info_limit_m");
        std::optional<double> error_m = table.Number(row, "error_others_m");
        if (!limit_m || !error_m || *limit_m <= 0) return std::nullopt;
        return *error_m / *limit_m;
      }};
  return limit;
}

const SweepMeasure& OraclesPenetration() {
  static const SweepMeasure oracle =
      Column("oracle-penetration", "penetration of the oracle", "m", true, "oracle_penetration_m");
  return oracle;
}

const SweepMeasure& MeasureNamed(const std::string& id) {
  for (const SweepMeasure& measure : SweepMeasures()) {
    if (measure.id == id) return measure;
  }
  for (const SweepMeasure& measure : FloorMeasures()) {
    if (measure.id == id) return measure;
  }
  if (id == "server-cpu") return ServerCpuMeasure();
  SEAM_ASSERT(id == "cpu");
  return CpuMeasure();
}

}  // namespace seam
