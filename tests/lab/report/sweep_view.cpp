#include "tests/lab/report/sweep_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>

#include "common/net/impair.h"
#include "tests/lab/report/method_look.h"

namespace seam {
namespace {

using Keys = std::map<std::string, std::string>;

/// Names of the axes we know; others are called as their column.
const std::array<SweepAxis, 13>& Axes() {
  static const std::array<SweepAxis, 13> axes = {{
      {"one_way_ms", "one-way latency", "ms", false},
      {"loss_percent", "loss", "%", false},
      {"jitter_ms", "jitter, mean of the exponential", "ms", false},
      {"send_hz", "updates", "Hz", true},
      {"buffer_m", "buffer width", "m", true},
      {"input_delay_ticks", "input delay", "ticks", true},
      {"smooth", "smooth", "1/s", true},
      {"substeps", "substeps", "", true},
      {"tick_hz", "ticks", "Hz", true},
      {"velocity_iterations", "velocity iterations", "", true},
      {"position_iterations", "position iterations", "", true},
      {"skin_m", "skin", "m", true},
      {"duration_s", "duration", "s", false},
  }};
  return axes;
}

/// Columns between seed and the first measure belong to the run as well.
bool IsMeasureOrIdentity(const std::string& column) {
  static const std::set<std::string> not_keys = {"version",    "commit", "numerics", "scene",
                                                 "scene_hash", "mode",   "impair",   "reconcile",
                                                 "drive",      "seed"};
  return not_keys.count(column) > 0;
}

std::string Number(double value) { return fmt::format("{:g}", std::round(value * 1e6) / 1e6); }

/// "a=1; solver.substeps=2" without what has a column of its own.
std::string OtherSettings(const CsvTable& table, const std::string& set) {
  std::string rest;
  std::istringstream items(set);
  for (std::string item; std::getline(items, item, ';');) {
    const std::size_t begin = item.find_first_not_of(' ');
    if (begin == std::string::npos) continue;
    item = item.substr(begin);
    std::string name = item.substr(0, item.find('='));
    name = name.substr(name.rfind('.') + 1);
    name = name.substr(0, name.find(' '));
    if (table.Has(name) || table.Has(name + "_m") || table.Has(name + "_ticks")) continue;
    rest += (rest.empty() ? "" : "; ") + item;
  }
  return rest;
}

/// What distinguishes a run besides scene, drive, method and seed.
Keys KeysOf(const CsvTable& table, std::size_t row, const std::vector<std::string>& columns) {
  Keys keys;
  for (const std::string& column : columns) keys[column] = table.Text(row, column);
  if (table.Has("set")) keys["set"] = OtherSettings(table, table.Text(row, "set"));
  if (table.Has("one_way_ms")) return keys;
  const ImpairProfile profile = FindProfile(table.Text(row, "impair"));
  keys["one_way_ms"] = Number(static_cast<double>(profile.delay_us) * 1e-3);
  keys["jitter_ms"] = Number(static_cast<double>(profile.jitter_mean_us) * 1e-3);
  keys["loss_percent"] = Number(MeanLoss(profile) * 100);
  return keys;
}

/// Those columns that are settings of a run: all before the first measure.
std::vector<std::string> KeyColumns(const CsvTable& table) {
  std::vector<std::string> columns;
  for (const std::string& column : table.header()) {
    if (column.rfind("error_", 0) == 0) break;
    if (!IsMeasureOrIdentity(column)) columns.push_back(column);
  }
  return columns;
}

SweepAxis AxisOf(const std::string& key) {
  for (const SweepAxis& axis : Axes()) {
    if (axis.key == key) return axis;
  }
  return {key, key, "", true};
}

bool IsNumber(const std::string& text) {
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0';
}

/// Of each key the values that the runs of one scene have, of the scene with the most.
using Values = std::map<std::string, std::set<std::string>>;

Values ValuesOf(const CsvTable& table, const std::vector<Keys>& keys) {
  std::map<std::string, Values> by_scene;
  for (std::size_t row = 0; row < keys.size(); ++row) {
    for (const auto& item : keys[row]) {
      // A scene's own value, written as none, is no choice of the sweep; but no text is a value.
      if (item.second.empty() && item.first != "set") continue;
      by_scene[table.Text(row, "scene")][item.first].insert(item.second);
    }
  }
  Values most;
  for (const auto& scene : by_scene) {
    for (const auto& item : scene.second) {
      if (item.second.size() > most[item.first].size()) most[item.first] = item.second;
    }
  }
  return most;
}

/// The key with the most values, all of them numbers; of equals the one listed first.
std::string ChooseAxis(const Values& values) {
  std::string best = "one_way_ms";
  std::size_t most = 1;
  const auto consider = [&](const std::string& key) {
    const auto found = values.find(key);
    if (found == values.end() || found->second.size() <= most) return;
    const auto& all = found->second;
    if (!std::all_of(all.begin(), all.end(), [](const auto& v) { return IsNumber(v); })) return;
    best = key;
    most = all.size();
  };
  for (const SweepAxis& axis : Axes()) consider(axis.key);
  for (const auto& item : values) consider(item.first);
  return best;
}

SweepGroup* GroupOf(const CsvTable& table, std::size_t row, SweepView* view) {
  const std::string scene = std::filesystem::path(table.Text(row, "scene")).stem().string();
  const std::string& drive = table.Text(row, "drive");
  for (SweepGroup& group : view->groups) {
    if (group.scene == scene && group.drive == drive) return &group;
  }
  view->groups.push_back({scene, drive, {}, {}, {}});
  return &view->groups.back();
}

std::string Fixed(const Values& values, const std::string& axis) {
  std::string text;
  for (const char* key : {"one_way_ms", "loss_percent", "jitter_ms", "send_hz"}) {
    const auto found = values.find(key);
    if (key == axis || found == values.end() || found->second.size() != 1) continue;
    const SweepAxis a = AxisOf(key);
    text += fmt::format("{}{} {} {}", text.empty() ? "" : ", ", a.name.substr(0, a.name.find(',')),
                        *found->second.begin(), a.unit);
  }
  return text;
}

}  // namespace

std::string MethodName(const CsvTable& table, std::size_t row) {
  const std::string& rule = table.Text(row, "reconcile");
  const std::string& mode = table.Text(row, "mode");
  if (rule.empty()) return mode;
  return mode == "central" ? mode + "/" + rule : rule;
}

SweepView ViewSweep(const CsvTable& table) {
  table.Require({"scene", "mode", "reconcile", "impair", "drive", "seed", "error_rms_m"});
  const std::vector<std::string> columns = KeyColumns(table);
  std::vector<Keys> keys;
  for (std::size_t row = 0; row < table.rows(); ++row) keys.push_back(KeysOf(table, row, columns));
  const Values values = ValuesOf(table, keys);
  SweepView view;
  view.axis = AxisOf(ChooseAxis(values));
  view.fixed = Fixed(values, view.axis.key);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    std::string method = MethodName(table, row);
    for (const auto& item : keys[row]) {
      const auto found = values.find(item.first);
      if (item.first == view.axis.key || found == values.end()) continue;
      if (found->second.size() < 2) continue;
      method += ", " + AxisOf(item.first).name + ' ' + (item.second.empty() ? "–" : item.second);
    }
    const std::string& x = keys[row][view.axis.key];
    if (x.empty()) continue;
    GroupOf(table, row, &view)->runs[method][std::strtod(x.c_str(), nullptr)].push_back(row);
  }
  for (SweepGroup& group : view.groups) {
    std::set<double> xs;
    for (const auto& method : group.runs) {
      group.methods.push_back(method.first);
      for (const auto& point : method.second) xs.insert(point.first);
    }
    group.xs.assign(xs.begin(), xs.end());
    std::stable_sort(group.methods.begin(), group.methods.end(),
                     [](const auto& a, const auto& b) { return MethodOrder(a) < MethodOrder(b); });
  }
  return view;
}

std::optional<Quartiles> QuartilesOf(const CsvTable& table, const SweepMeasure& measure,
                                     const std::vector<std::size_t>& rows) {
  std::vector<double> values;
  for (const std::size_t row : rows) {
    const std::optional<double> value = measure.value(table, row);
    if (value) values.push_back(*value);
  }
  return FindQuartiles(std::move(values));
}

std::optional<Quartiles> QuartilesOf(const CsvTable& table, const SweepMeasure& measure,
                                     const SweepGroup& group) {
  std::vector<std::size_t> rows;
  for (const auto& method : group.runs) {
    for (const auto& point : method.second) {
      rows.insert(rows.end(), point.second.begin(), point.second.end());
    }
  }
  return QuartilesOf(table, measure, rows);
}

}  // namespace seam
