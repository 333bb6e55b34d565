#include "tests/lab/report/sessions/fairness_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "tests/lab/report/validity.h"

namespace seam {
namespace {

/// The figures of one method's valid rows.
struct Advantages {
  std::string why;  // of an invalid row
  std::vector<double> near_own, far_own, oracle;
  std::vector<double> own, server;  // signed: far less near
};

double Mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// The nearest-rank percentile of the sizes: number ceil(0.95 n).
double Percentile95(const std::vector<double>& values) {
  std::vector<double> sizes;
  for (const double value : values) sizes.push_back(std::abs(value));
  std::sort(sizes.begin(), sizes.end());
  return sizes[(sizes.size() * 95 + 99) / 100 - 1];
}

std::vector<std::string> Fields(const std::string& method, const Advantages& a) {
  if (a.own.empty()) return {method, "0", "not valid: " + a.why, "–", "–", "–", "–", "–"};
  const std::string sign = Mean(a.own) < 0 ? "−" : "+";
  const std::string server_sign = Mean(a.server) < 0 ? "−" : "+";
  return {method,
          std::to_string(a.own.size()),
          Digits(Mean(a.oracle)),
          Digits(Mean(a.near_own)) + " / " + Digits(Mean(a.far_own)),
          sign + Digits(std::abs(Mean(a.own))),
          Digits(Percentile95(a.own)),
          server_sign + Digits(std::abs(Mean(a.server))),
          Digits(Percentile95(a.server))};
}

}  // namespace

TextTable FairnessTable(const CsvTable& csv, const std::string& drive, const std::string& command) {
  csv.Require({"method", "drive", "near_path", "far_path", "valid", "momentum_oracle_ns",
               "momentum_near_own_ns", "momentum_far_own_ns", "advantage_own_ns",
               "advantage_server_ns"});
  std::vector<std::string> methods;
  std::map<std::string, Advantages> by_method;
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    if (csv.Text(row, "drive") != drive) continue;
    const std::string& method = csv.Text(row, "method");
    if (by_method.count(method) == 0) methods.push_back(method);
    Advantages& a = by_method[method];
    if (!csv.Text(row, "valid").empty()) {
      a.why = csv.Text(row, "valid");
      continue;
    }
    const auto take = [&](const char* column, std::vector<double>* values) {
      if (const std::optional<double> value = csv.Number(row, column)) values->push_back(*value);
    };
    take("momentum_oracle_ns", &a.oracle);
    take("momentum_near_own_ns", &a.near_own);
    take("momentum_far_own_ns", &a.far_own);
    take("advantage_own_ns", &a.own);
    take("advantage_server_ns", &a.server);
  }
  TextTable table;
  table.name = "fairness-" + drive;
  table.title = drive == "script" ? "A mirrored crash at full throttle"
                                  : "A mirrored crash, both throttle and brake alike at random";
  table.header = {"method",
                  "runs",
                  "without a network (N s)",
                  "near / far, own screens (N s)",
                  "far − near, own screens: mean (N s)",
                  "p95 of its size (N s)",
                  "far − near, server: mean (N s)",
                  "p95 of its size (N s)"};
  for (const std::string& method : methods) {
    table.rows.push_back(Fields(method, by_method[method]));
  }
  if (csv.rows() > 0) {
    table.note = fmt::format(
        "The near player's path: {}, the far one's: {}, either way; each seed with both "
        "assignments. Above 0: the far player is hit harder. Of all {} rows {} are not valid.",
        csv.Text(0, "near_path"), csv.Text(0, "far_path"), csv.rows(), FindValidity(csv).invalid);
  }
  table.command = command;
  table.open = true;
  return table;
}

Section FairnessSection(const CsvTable& csv, const std::string& command) {
  Section section;
  section.id = "fairness";
  section.title = "Fairness: who pays for whose latency";
  section.intro =
      "Two equal cars meet head on; one player is near the server, the other far from it, and then "
      "the other way round. Without a network both receive the same momentum.";
  for (const char* drive : {"script", "random"}) {
    section.items.emplace_back(FairnessTable(csv, drive, command));
  }
  return section;
}

}  // namespace seam
