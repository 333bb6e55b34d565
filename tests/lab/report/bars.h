#pragma once
/// What the default and `central` must hold, case by case, and whether they do.

#include "tests/lab/report/cases.h"
#include "tests/lab/report/text_table.h"

namespace seam {

/// The method that a room has unless it says otherwise.
inline constexpr const char* kDefaultMethod = "rollback";
inline constexpr const char* kCentralMethod = "central/all";

/// Figures from before, a line for each scene, drive, impair and reconcile, with medians in the
/// columns of a sweep.
struct Before {
  CsvTable table;
  /// Nothing where it was not measured.
  std::optional<double> Find(const ReportCase& at, const std::string& reconcile,
                             const std::string& column) const;
};

/// A row for each bar whose scene is among the cases: before, the default, `central`, the bars, and
/// who missed one. `before` may be null.
TextTable BarTable(const std::vector<ReportCase>& cases, const Before* before);
/// A row for each case with a figure from before: stutter beside the lowest of three methods', and
/// what the default costs beside `retrospect`.
TextTable StutterTable(const std::vector<ReportCase>& cases, const Before* before);
/// A row for each case: what was, and what each part of the change does that can be had apart.
TextTable ChangeTable(const std::vector<ReportCase>& cases, const Before* before);

}  // namespace seam
