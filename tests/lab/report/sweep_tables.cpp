#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "tests/lab/report/method_look.h"
#include "tests/lab/report/sweep_section.h"

namespace seam {
namespace {

/// Text by row and method; rows in the order in which they were named.
struct Cells {
  std::vector<std::string> rows;
  std::map<std::string, std::map<std::string, std::string>> text;

  std::map<std::string, std::string>& Row(const std::string& row) {
    if (text.count(row) == 0) rows.push_back(row);
    return text[row];
  }
};

std::string GroupName(const SweepGroup& group) {
  return group.scene + (group.drive == "script" ? "" : ", " + group.drive);
}

void Fill(const Cells& cells, const std::string& corner, TextTable* table) {
  std::vector<std::string> methods;
  for (const auto& row : cells.text) {
    for (const auto& cell : row.second) {
      if (std::count(methods.begin(), methods.end(), cell.first) == 0) {
        methods.push_back(cell.first);
      }
    }
  }
  std::stable_sort(methods.begin(), methods.end(), [](const auto& a, const auto& b) {
    return std::make_pair(MethodOrder(a), a) < std::make_pair(MethodOrder(b), b);
  });
  table->header = {corner};
  table->header.insert(table->header.end(), methods.begin(), methods.end());
  for (const std::string& row : cells.rows) {
    std::vector<std::string> fields = {row};
    for (const std::string& method : methods) {
      const auto found = cells.text.at(row).find(method);
      fields.push_back(found == cells.text.at(row).end() ? "–" : found->second);
    }
    table->rows.push_back(std::move(fields));
  }
}

/// Tables over several sweeps are made by all of them.
void AddCommand(const Sweep& sweep, TextTable* table) {
  table->command += (table->command.empty() ? "make report  # sweeps: " : ", ") + sweep.name;
}

/// For every method: at which x it is on the front, "✓ 10, 30"; else how many times the front's
/// error it has at best for what it costs: "1.8 x".
std::map<std::string, std::string> Places(const Sweep& sweep, const SweepGroup& group,
                                          const SweepMeasure& cost, const SweepMeasure& error) {
  const std::vector<MethodTrial> trials = Trials(sweep, group, cost, error);
  std::vector<CostError> all;
  for (const MethodTrial& t : trials) all.push_back(t.trial);
  const std::vector<std::size_t> front = ParetoFront(all);
  std::map<std::string, std::set<double>> on_it;
  for (const std::size_t i : front) on_it[trials[i].method].insert(trials[i].x);
  std::map<std::string, std::string> places;
  for (const auto& method : on_it) {
    std::string& place = places[method.first];
    for (const double x : method.second) {
      place += fmt::format("{} {:g}", place.empty() ? "✓" : ",", x);
    }
  }
  std::map<std::string, double> ratios;
  for (const MethodTrial& t : trials) {
    if (places.count(t.method) > 0) continue;
    double best = 0;  // error of the front at this cost: its last point that is not dearer
    for (const std::size_t i : front) {
      if (all[i].cost <= t.trial.cost) best = all[i].error;
    }
    if (best <= 0) continue;
    const double ratio = t.trial.error / best;
    const auto known = ratios.find(t.method);
    if (known == ratios.end() || ratio < known->second) ratios[t.method] = ratio;
  }
  for (const auto& ratio : ratios) places[ratio.first] = Digits(ratio.second) + " ×";
  return places;
}

}  // namespace

TextTable FrontTable(const std::vector<Sweep>& sweeps) {
  TextTable table;
  table.name = "fronts";
  table.title = "Who is on a front";
  Cells cells;
  for (const Sweep& sweep : sweeps) {
    if (!sweep.view.axis.ours || DelaysInputs(sweep)) continue;
    for (const SweepGroup& group : sweep.view.groups) {
      for (const std::string& error : {HeadlineOf(sweep).id, std::string("seam")}) {
        for (const char* cost : {"cpu", "bytes"}) {
          const auto places = Places(sweep, group, MeasureNamed(cost), MeasureNamed(error));
          if (places.empty()) continue;
          cells.Row(fmt::format("{} by {}: {} against {}", GroupName(group), sweep.view.axis.name,
                                std::string(cost) == "cpu" ? "CPU" : "bytes/s",
                                error == "others" ? "error of others" : error)) = places;
        }
      }
    }
    AddCommand(sweep, &table);
  }
  Fill(cells, "front", &table);
  table.note =
      "✓: on the front of that cost against that error, at these values of what was varied; else "
      "how many times the front's error at equal cost, where it comes closest.";
  return table;
}

TextTable SpeedTable(const std::vector<Sweep>& sweeps) {
  TextTable table;
  table.name = "speed";
  table.title = "Virtual time: how many times faster than real time, on one core";
  std::map<std::string, std::map<std::string, std::vector<double>>> factors;  // group, method
  Cells cells;
  for (const Sweep& sweep : sweeps) {
    for (const SweepGroup& group : sweep.view.groups) {
      cells.Row(GroupName(group));
      for (const auto& method : group.runs) {
        if (method.first.find(", ") != std::string::npos) continue;
        auto& all = factors[GroupName(group)][method.first];
        for (const auto& point : method.second) {
          for (const std::size_t row : point.second) {
            const auto ms_per_s = CpuMeasure().value(sweep.table, row);
            if (ms_per_s && *ms_per_s > 0) all.push_back(1000 / *ms_per_s);
          }
        }
      }
    }
    AddCommand(sweep, &table);
  }
  for (const auto& group : factors) {
    for (const auto& method : group.second) {
      const auto q = FindQuartiles(method.second);
      if (q) cells.Row(group.first)[method.first] = Digits(q->median) + " ×";
    }
  }
  Fill(cells, "scene", &table);
  table.note =
      "Seconds of the session (from tick 0) for each CPU second of simulating the server and its "
      "clients, joining included, measuring excluded; medians over all runs.";
  return table;
}

}  // namespace seam
