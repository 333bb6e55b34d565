#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

#include "tests/lab/experiment/csv_table.h"
#include "tests/lab/experiment/probes.h"
#include "tests/lab/report/statistics.h"
#include "tests/lab/report/text_table.h"
#include "tests/lab/report/validity.h"
#include "tests/lab/rivals/rivals.h"

namespace seam {
namespace {

/// A column of the table for people.
struct Shown {
  const char* column;  // of the CSV file
  const char* title;
};
constexpr Shown kShown[] = {{"response_own_ms", "own responds, ms"},
                            {"response_other_ms", "others respond, ms"},
                            {"error_own_m", "error own, m"},
                            {"error_others_m", "error others, m"},
                            {"path_error_rms_m", "as shown, m"},
                            {"seen", "seen"},
                            {"stutter_shown_mps2", "stutter, m/s2"},
                            {"frozen_ms_per_s", "stands, ms/s"},
                            {"frozen_longest_ms", "longest, ms"},
                            {"speed", "speed"},
                            {"kb_per_s", "kB/s"},
                            {"server_cpu_ms_per_s", "server CPU, ms/s"},
                            {"client_cpu_ms_per_s", "client CPU, ms/s"}};

Values RivalValues(const RivalFigures& f) {
  const Measures& m = f.measures;
  return Judged(
      f.invalid,
      {Significant("response_own_ms", m.response_own_ms, 4),
       Significant("response_other_ms", m.response_other_ms, 4),
       Significant("response_server_ms", m.response_server_ms, 4),
       Significant("error_own_m", m.error_own_m, 3),
       Significant("error_others_m", m.error_others_m, 3),
       Significant("path_error_rms_m", m.path_error_rms_m, 3), Significant("seen", m.seen, 3),
       Significant("stutter_shown_mps2", m.stutter_shown_mps2, 3),
       Decimals("frozen_ms_per_s", f.frozen_ms_per_s, 1),
       Decimals("frozen_longest_ms", f.frozen_longest_ms, 0), Decimals("speed", f.speed, 3),
       Decimals("kb_per_s", f.kbps, 2), Decimals("server_cpu_ms_per_s", f.server_ms_per_s, 2),
       Decimals("client_cpu_ms_per_s", f.client_ms_per_s, 2),
       Count("ticks_stepped_again", f.stepped_again)});
}

std::string MedianOf(const CsvTable& csv, const std::vector<std::size_t>& rows,
                     const char* column) {
  std::vector<double> values;
  for (const std::size_t row : rows) {
    const std::optional<double> value = csv.Number(row, column);
    if (value) values.push_back(*value);
  }
  const std::optional<Quartiles> quartiles = FindQuartiles(values);
  return quartiles ? Significant("", quartiles->median, 3).text : "-";
}

/// Prints a table for each network: a row for each scene and method, medians over the seeds.
int PrintRivals(const std::string& path) {
  const CsvTable csv = CsvTable::Load(path);
  std::vector<std::string> networks;
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    const std::string network = csv.Text(row, "network");
    if (std::find(networks.begin(), networks.end(), network) == networks.end()) {
      networks.push_back(network);
    }
  }
  for (const std::string& network : networks) {
    std::vector<std::pair<std::string, std::string>> order;  // scenes and methods
    std::map<std::pair<std::string, std::string>, std::vector<std::size_t>> rows;
    for (std::size_t row = 0; row < csv.rows(); ++row) {
      if (csv.Text(row, "network") != network) continue;
      const std::pair<std::string, std::string> key(csv.Text(row, "scene"),
                                                    csv.Text(row, "method"));
      if (rows.count(key) == 0) order.push_back(key);
      rows[key].push_back(row);
    }
    TextTable table;
    table.name = "rivals";
    table.title = network;
    table.header = {"scene", "method"};
    for (const Shown& shown : kShown) table.header.emplace_back(shown.title);
    for (const auto& key : order) {
      const Validity validity = FindValidity(csv, rows[key]);
      std::vector<std::string> cells = {key.first, WithValidity(key.second, validity)};
      for (const Shown& shown : kShown) cells.push_back(MedianOf(csv, rows[key], shown.column));
      table.rows.push_back(std::move(cells));
    }
    std::printf("\n%s\n\n%s", table.title.c_str(), Markdown(table).c_str());
  }
  const Validity validity = FindValidity(csv);
  if (!validity.too_many()) return 0;
  std::fprintf(stderr, "seam-lab: %s: %zu of %zu rows are not valid\n", path.c_str(),
               validity.invalid, validity.rows);
  return 1;
}

void AddRivalsFlags(Command& rivals, ProbeOptions& options) {
  rivals.Option("SCENES", options.scenes, "scene files or names").Required();
  AddTableFlag(rivals, options.output).Required();
  rivals.Option("--methods", options.methods, "lockstep, ggpo, buffer/rollback ... (default: all)")
      .CommaSeparated();
  rivals.Option("--impair", options.networks, "profile's name or list; repeatable (default: demo)");
  rivals.Option("--drive", options.drive, "script | bot").OneOf({"script", "bot"});
  rivals.Option("--seconds", options.seconds, "after tick 0 (default: the scene's own)")
      .Range(0.0, kDurationMax);
  rivals.Option("--seeds", options.seeds, "from 1 (default: 1)").Range(1, 10000);
  AddRunFlags(rivals, options.output, "runs at a time (default: 1; more blur CPU times)");
}

}  // namespace

Probe RivalsProbe() {
  Probe probe;
  probe.command = "rivals";
  probe.about = "response, errors, bytes and CPU of quite different methods, side by side";
  probe.flags = AddRivalsFlags;
  probe.defaults.methods = {"lockstep",    "lockstep-adaptive", "ggpo",
                            "central/own", "central/all",       "strict",
                            "touch",       "buffer/rollback"};
  probe.defaults.output.jobs = 1;  // more disturb each other's CPU times
  probe.defaults.networks = {"demo"};
  probe.key = {"version", "scene", "scene_hash", "method", "network", "drive", "seed"};
  const ProbeAxis drive = {"drive", [](const ProbeOptions& o, const Scene&) {
                             return std::vector<std::string>{o.drive};
                           }};
  probe.axes = {NetworkAxis(), drive, SeedAxis(), MethodAxis()};
  probe.columns = RivalValues({});
  probe.measure = [](const ProbeRun& run) {
    return RivalValues(MeasureRival(run.settings, *run.scene));
  };
  probe.summary = PrintRivals;
  return probe;
}

}  // namespace seam
