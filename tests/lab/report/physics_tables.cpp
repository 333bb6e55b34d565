#include <fmt/format.h>

#include <cmath>
#include <map>

#include "tests/lab/report/physics_section.h"

namespace seam {
namespace {

std::string Error(const std::optional<PhysicsRun>& run) {
  if (!run) return "–";
  if (run->held()) return Digits(run->error);
  return std::isfinite(run->error) ? Digits(run->error) + ", " + run->failure : run->failure;
}

std::string Ratio(const std::optional<PhysicsRun>& a, const std::optional<PhysicsRun>& b) {
  if (!a || !b) return "–";
  if (!a->held() && !b->held()) return "–";
  const double ratio = ErrorRatio(*a, *b);
  return std::isinf(ratio) ? "∞" : Digits(ratio);
}

std::vector<std::string> Found(const PhysicsCase& c, const PhysicsRun* run) {
  if (run == nullptr || !c.stock) return {"none", "–", "–"};
  return {run->setting, Digits(run->cost_ratio), Ratio(*run, c.stock)};
}

}  // namespace

TextTable PhysicsTable(const std::vector<PhysicsCase>& cases, const std::string& command) {
  TextTable table;
  table.name = "hard-cases";
  table.title = "Stock against each scene's own setting";
  table.header = {"case",        "judged by",  "unit",    "error, stock", "error, own",
                  "error ratio", "cost ratio", "verdict", "own setting"};
  std::map<std::string, int> verdicts;
  for (const PhysicsCase& c : cases) {
    table.rows.push_back({c.name, c.truth, c.unit, Error(c.stock), Error(c.scene),
                          Ratio(c.scene, c.stock), c.scene ? Digits(c.scene->cost_ratio) : "–",
                          Verdict(c), c.scene ? c.scene->setting : "–"});
    ++verdicts[Verdict(c)];
  }
  for (const auto& v : verdicts) {
    table.note += fmt::format("{}{}: {}", table.note.empty() ? "" : "; ", v.first, v.second);
  }
  table.note = fmt::format(
      "{} cases. {}. Much better: at most half the error; same cost: at most 1.1 times stock's; "
      "neither: less than that at more cost. Settings: ticks per second, velocity/position "
      "iterations × substeps.",
      cases.size(), table.note);
  table.command = command;
  return table;
}

TextTable PhysicsSearchTable(const std::vector<PhysicsCase>& cases, const std::string& command) {
  TextTable table;
  table.name = "hard-cases-search";
  table.title = "The cheapest setting that is no worse than stock, and the best at its cost";
  table.header = {"case",
                  "cheapest no worse than stock",
                  "cost ratio",
                  "error ratio",
                  "best at ≤ 1.1 × stock's cost",
                  "cost ratio",
                  "error ratio",
                  "failed"};
  for (const PhysicsCase& c : cases) {
    std::vector<std::string> row = {c.name};
    for (const PhysicsRun* run : {CheapestNoWorse(c), BestAtStocksCost(c)}) {
      for (std::string& field : Found(c, run)) row.push_back(std::move(field));
    }
    std::size_t failed = 0;
    for (const PhysicsRun& run : c.all) failed += run.held() ? 0 : 1;
    row.push_back(fmt::format("{} of {}", failed, c.all.size()));
    table.rows.push_back(std::move(row));
  }
  table.note = "Of all settings tried that do not fail; an error ratio of 0 where stock fails.";
  table.command = command;
  return table;
}

TextTable PhysicsSideTable(const CsvTable& table, const std::vector<PhysicsCase>& cases,
                           const std::string& command) {
  const std::vector<std::pair<const char*, const char*>> columns = {
      {"penetration_m", "penetration (m)"}, {"joint_drift_m", "joint drift (m)"},
      {"energy_gain", "energy gain"},       {"jitter_mps", "jitter at rest (m/s)"},
      {"asleep_s", "asleep after (s)"},     {"cpu_us_per_s", "CPU (µs per s)"}};
  TextTable out;
  out.name = "hard-cases-side";
  out.title = "What else was measured: stock → the scene's own";
  out.header = {"case"};
  for (const auto& column : columns) out.header.push_back(column.second);
  for (const PhysicsCase& c : cases) {
    std::vector<std::string> row = {c.name};
    for (const auto& column : columns) {
      const auto value = [&](const std::optional<PhysicsRun>& run) {
        const auto number = run ? table.Number(run->row, column.first) : std::nullopt;
        return number ? Digits(*number) : std::string("–");
      };
      const std::string stock = value(c.stock), scene = value(c.scene);
      row.push_back(stock == "–" && scene == "–" ? "–" : stock + " → " + scene);
    }
    out.rows.push_back(std::move(row));
  }
  out.note = "–: does not apply, or never.";
  out.command = command;
  return out;
}

}  // namespace seam
