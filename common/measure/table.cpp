#include "common/measure/table.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/sync/method.h"

namespace seam {
namespace {

const char* const kColumns[] = {"scene",
                                "run",
                                "mode",
                                "reconcile",
                                "impair",
                                "seed",
                                "error_others_m",
                                "error_own_m",
                                "path_error_rms_m",
                                "view_age_ms",
                                "response_own_ms",
                                "response_other_ms",
                                "seen",
                                "error_rms_m",
                                "error_p95_m",
                                "error_max_m",
                                "stutter_mps2",
                                "backsteps",
                                "rebound",
                                "bytes_per_s",
                                "cpu_us_per_s",
                                "inputs_late",
                                "error_served_m",
                                "overlap_p99_m",
                                "stutter_shown_mps2",
                                "valid"};
/// Number of leading columns with text, aligned to the left.
constexpr std::size_t kTextColumns = 5;
/// Number of leading columns that identify the session.
constexpr std::size_t kIdentityColumns = 6;

std::string Number(double value, bool applies = true) {
  return applies ? fmt::format("{:.6g}", value) : "";
}

std::string Number(const std::optional<double>& value) {
  return Number(value.value_or(0), value.has_value());
}

std::vector<std::string> Values(const MeasuredRun& run) {
  const Measures& m = run.measures;
  const bool any = m.compared > 0;
  std::vector<std::string> values = {run.room.scene_name,
                                     run.run,
                                     run.room.mode,
                                     VariantOf(run.room),
                                     run.room.impair,
                                     std::to_string(run.room.seed),
                                     Number(m.error_others_m),
                                     Number(m.error_own_m),
                                     Number(m.path_error_rms_m),
                                     Number(m.view_age_ms),
                                     Number(m.response_own_ms),
                                     Number(m.response_other_ms),
                                     Number(m.seen),
                                     Number(m.error_rms_m, any),
                                     Number(m.error_p95_m, any),
                                     Number(m.error_max_m, any),
                                     Number(m.stutter_mps2, any),
                                     any ? std::to_string(m.backsteps) : "",
                                     Number(m.rebound.value_or(0), m.rebound.has_value()),
                                     Number(m.bytes_per_s, m.bytes_per_s > 0),
                                     Number(m.cpu_us_per_s, m.cpu_us_per_s > 0),
                                     m.inputs_late ? std::to_string(*m.inputs_late) : "",
                                     Number(m.error_served_m),
                                     Number(m.overlap_p99_m),
                                     Number(m.stutter_shown_mps2, any),
                                     run.valid.empty() ? run.lacks : run.valid};
  // A session that is not valid has only its identity and the reason.
  for (std::size_t i = kIdentityColumns; !run.valid.empty() && i + 1 < values.size(); ++i) {
    values[i].clear();
  }
  return values;
}

/// Formats "0.01 m at most (the oracle's own: 0.002)", or "does not apply".
std::string Beside(const std::optional<double>& value, const std::optional<double>& oracle,
                   const char* unit) {
  if (!value) return "does not apply";
  std::string text = fmt::format("{:.6g} {}", *value, unit);
  if (oracle) text += fmt::format(" (the oracle's own: {:.6g})", *oracle);
  return text;
}

}  // namespace

std::string FormatMore(const MeasuredRun& run) {
  const Measures& m = run.measures;
  std::string out = fmt::format("\n{}\n", run.run);
  const bool compared = m.compared > 0;
  out += "  angle error      ";
  out += compared ? fmt::format("{:.6g} rad RMS over {} poses\n", m.error_rms_rad, m.compared)
                  : "does not apply\n";
  for (const auto& [peer, rms] : m.error_rms_by_peer_m) {
    out += fmt::format("  peer {:<2}          {:.6g} m RMS\n", peer, rms);
  }
  out += "  error shown      ";
  out += compared ? fmt::format("{:.6g} m RMS, {:.6g} m p95, {:.6g} m at most, at the tick shown\n",
                                m.shown_error_rms_m, m.shown_error_p95_m, m.shown_error_max_m)
                  : "does not apply\n";
  out += fmt::format("  error            {}\n",
                     Beside(m.error_server_m, std::nullopt, "m in the server's view"));
  out += fmt::format("  response         {}\n",
                     Beside(m.response_server_ms, std::nullopt, "ms in the server's view"));
  if (m.energy_ratio_min && m.energy_ratio_max) {
    out +=
        fmt::format("  kinetic energy   {:.6g} to {:.6g} times the oracle's, hottest body {:.6g}\n",
                    *m.energy_ratio_min, *m.energy_ratio_max, m.hottest_ratio.value_or(0));
  }
  if (m.seam_rms_m) {
    out += fmt::format(
        "  seam             {:.6g} m RMS from the authority's view, stutter {:.6g} "
        "m/s2 against it\n",
        *m.seam_rms_m, m.seam_stutter_mps2.value_or(0));
  }
  out += fmt::format("  penetration      {}\n",
                     Beside(m.penetration_m, m.oracle_penetration_m, "m at most"));
  out += fmt::format("  joint drift      {}\n",
                     Beside(m.joint_drift_m, m.oracle_joint_drift_m, "m at most"));
  out += fmt::format("  energy gain      {}\n",
                     Beside(m.energy_gain_j, std::nullopt, "J above the oracle's, within 0.5 s"));
  out += fmt::format("  hand-over        {} changes of authority", m.handovers);
  if (m.handovers > 0) out += fmt::format(", largest jump {:.6g} m", m.handover_jump_m);
  if (m.handover_gap_m && m.handover_dv_mps) {
    out += fmt::format("; old and new authority at most {:.6g} m and {:.6g} m/s apart",
                       *m.handover_gap_m, *m.handover_dv_mps);
  }
  if (m.handover_gap_p95_m && m.handover_dv_p95_mps) {
    out +=
        fmt::format(" (p95 {:.6g} m, {:.6g} m/s)", *m.handover_gap_p95_m, *m.handover_dv_p95_mps);
  }
  out += '\n';
  out += m.rest_ticks ? fmt::format(
                            "  rest             all peers bit-equal {:g} ticks after the "
                            "oracle's rest\n",
                            *m.rest_ticks)
                      : std::string("  rest             not reached\n");
  out += fmt::format("  jitter at rest   {}\n", Beside(m.jitter_rest_mps, std::nullopt, "m/s RMS"));
  if (m.topology_lag_s && m.lost) {
    out += fmt::format(
        "  bodies change    a peer lacked an edit for at most {:.6g} s; {} bodies "
        "lost or too many\n",
        *m.topology_lag_s, *m.lost);
    out += fmt::format("  out of bounds    {} parts removed\n", m.left_bounds);
  }
  if (m.sent_bytes_per_s > 0) {
    out += fmt::format("  sent             {:.6g} bytes/s by a client\n", m.sent_bytes_per_s);
  }
  out += fmt::format("  log              {} messages missing, {} damaged bytes skipped\n", run.gaps,
                     run.skipped_bytes);
  return out;
}

std::string CsvField(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

std::string CsvHeader() {
  std::string line;
  for (const char* column : kColumns) line += (line.empty() ? "" : ",") + std::string(column);
  return line;
}

std::string CsvLine(const MeasuredRun& run) {
  std::string line;
  bool first = true;
  for (const std::string& value : Values(run)) {
    line += (first ? "" : ",") + CsvField(value);
    first = false;
  }
  return line;
}

std::string FormatTable(const std::vector<MeasuredRun>& runs, bool more) {
  std::vector<std::vector<std::string>> rows = {{std::begin(kColumns), std::end(kColumns)}};
  for (const MeasuredRun& run : runs) rows.push_back(Values(run));
  std::string out;
  std::vector<std::size_t> widths(rows.front().size(), 1);
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const bool reason = i + 1 == row.size() && &row != &rows.front() && !row[i].empty();
      const std::string value = row[i].empty() ? "-" : (reason ? "not valid: " : "") + row[i];
      line += i < kTextColumns ? fmt::format("{:<{}}  ", value, widths[i])
                               : fmt::format("{:>{}}  ", value, widths[i]);
    }
    out += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
  }
  if (more) {
    for (const MeasuredRun& run : runs) out += FormatMore(run);
  }
  return out;
}

}  // namespace seam
