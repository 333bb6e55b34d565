#include "tests/lab/relief/bar_rows.h"

#include <cmath>

namespace seam {
namespace {

std::string WithUnit(double value, const std::string& unit) {
  return Digits(value) + (unit.empty() ? "" : " " + unit);
}

std::string Verdict(const BarRow& row) {
  if (!row.valid) return "not valid";
  if (row.must.empty()) return "–";
  return row.met ? "met" : "missed";
}

}  // namespace

BarRow AtMost(const std::string& figure, double value, double most, const std::string& unit,
              const std::string& detail) {
  BarRow row;
  row.figure = figure;
  row.measured = WithUnit(value, unit) + (detail.empty() ? "" : " (" + detail + ")");
  row.must = "≤ " + WithUnit(most, unit);
  row.met = std::isfinite(value) && value <= most;
  return row;
}

BarRow Printed(const std::string& figure, const std::string& measured) {
  BarRow row;
  row.figure = figure;
  row.measured = measured;
  return row;
}

TextTable TableOf(const std::string& name, const std::string& title,
                  const std::vector<BarRow>& rows, const std::string& note) {
  TextTable table;
  table.name = "relief-" + name;
  table.title = title;
  table.header = {"figure", "measured", "must", "precondition", "verdict"};
  for (const BarRow& row : rows) {
    table.rows.push_back({row.figure, row.measured, row.must.empty() ? "printed" : row.must,
                          row.given.empty() ? "–" : row.given, Verdict(row)});
  }
  table.note = note;
  table.command = "seam-lab relief " + name;
  return table;
}

}  // namespace seam
