/// The floors of each scene and the error of held inputs; where chaos leaves nothing to tell.

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "tests/lab/report/sweep_section.h"

namespace seam {
namespace {

/// Errors below so many times the wire's floor are the scene's, not the method's.
constexpr double kChaosShare = 2;

/// Values of a scene's runs, over all sweeps.
struct SceneFloors {
  std::map<std::string, std::vector<double>> by_column;
  std::map<std::string, std::vector<double>> errors;  // by method, of the methods that are measured
};

bool IsOracle(const CsvTable& table, std::size_t row) {
  return table.Text(row, "mode") == "oracle";
}

/// Of others' bodies, where the table has it.
std::optional<double> ErrorOf(const CsvTable& table, std::size_t row) {
  const char* column = table.Has("error_others_m") ? "error_others_m" : "error_rms_m";
  return table.Number(row, column);
}

void Add(const CsvTable& table, std::size_t row, const std::string& method, SceneFloors* floors) {
  const auto note = [&](const std::string& name, const std::optional<double>& value) {
    if (value) floors->by_column[name].push_back(*value);
  };
  const bool oracle = IsOracle(table, row);
  const bool perfect = table.Text(row, "impair") == "perfect";
  if (oracle && perfect) note("oracle_row_m", table.Number(row, "error_max_m"));
  for (const char* column : {"floor_m", "floor_wire_m", "floor_barrier_m", "info_limit_m"}) {
    note(column, table.Number(row, column));
  }
  const std::optional<double> error = ErrorOf(table, row);
  if (!oracle && error) floors->errors[method].push_back(*error);
}

/// Methods whose median error is no more than chaos makes of the wire's rounding, in words.
std::string NotToldApart(const SceneFloors& floors) {
  const auto wire = floors.by_column.find("floor_wire_m");
  if (wire == floors.by_column.end()) return "–";
  const double chaos = kChaosShare * FindQuartiles(wire->second)->median;
  std::string names;
  int count = 0;
  for (const auto& [method, errors] : floors.errors) {
    if (FindQuartiles(errors)->median > chaos) continue;
    names += (names.empty() ? "" : ", ") + method;
    ++count;
  }
  return count < 2 ? "–" : names;
}

}  // namespace

TextTable FloorTable(const std::vector<Sweep>& sweeps) {
  TextTable table;
  table.name = "floors";
  table.title = "Floors of chaos, of the wire, of barriers, and of held inputs";
  table.header = {"scene",
                  "oracle_row_m",
                  "floor_m",
                  "floor_wire_m",
                  "floor_barrier_m",
                  "info_limit_m",
                  "chaos leaves nothing to tell apart"};
  std::vector<std::string> order;
  std::map<std::string, SceneFloors> scenes;
  for (const Sweep& sweep : sweeps) {
    bool any = false;
    for (const SweepGroup& group : sweep.view.groups) {
      const std::string name = group.scene + (group.drive == "script" ? "" : ", " + group.drive);
      if (scenes.count(name) == 0) order.push_back(name);
      for (const auto& [method, points] : group.runs) {
        for (const auto& point : points) {
          for (const std::size_t row : point.second) {
            Add(sweep.table, row, method, &scenes[name]);
            any = true;
          }
        }
      }
    }
    if (!any) continue;
    table.command += (table.command.empty() ? "make report  # sweeps: " : ", ") + sweep.name;
  }
  for (const std::string& name : order) {
    const SceneFloors& floors = scenes.at(name);
    if (floors.by_column.empty()) continue;
    std::vector<std::string> row = {name};
    for (std::size_t i = 1; i + 1 < table.header.size(); ++i) {
      const auto found = floors.by_column.find(table.header[i]);
      const bool known = found != floors.by_column.end();
      row.push_back(known ? Digits(FindQuartiles(found->second)->median) : "–");
    }
    row.push_back(NotToldApart(floors));
    table.rows.push_back(std::move(row));
  }
  table.note =
      "Medians over all runs of a scene, m. oracle_row_m: the largest error of any body at any "
      "tick "
      "in mode oracle over a perfect network, 0 where the measure is right. Last column: methods "
      "whose median error is at most twice floor_wire_m; what differs between them is chaos.";
  return table;
}

}  // namespace seam
