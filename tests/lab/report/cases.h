#pragma once
/// Sweeps taken apart into cases: one scene, drive, network and smoothing, every method beside the
/// others.

#include <optional>
#include <string>
#include <vector>

#include "tests/lab/report/sweep_view.h"

namespace seam {

/// A sweep's table, and how it was made.
struct CaseTable {
  std::string name;  ///< of its file, without .csv
  std::string command;
  CsvTable table;
};

struct CaseRun {
  const CsvTable* table = nullptr;
  std::size_t row = 0;
};

/// All runs of one method in one case.
struct CaseMethod {
  std::string name;  ///< "rollback", "central/all"
  std::vector<CaseRun> runs;
};

struct ReportCase {
  std::string scene, drive, impair;  ///< "wall", "bot", "demo"
  bool smooth = true;
  std::string set;  ///< what was set in the scene; empty: nothing
  std::string sweep, command;
  std::vector<CaseMethod> methods;  ///< in the order of MethodOrder

  /// "wall, bots" and, unless it is demo, the network.
  std::string Name() const;
  /// Null where it was not run.
  const CaseMethod* Find(const std::string& method) const;
};

/// "wall", "bot", "4g": "wall, bots, 4g".
std::string CaseName(const std::string& scene, const std::string& drive, const std::string& impair);

/// In the order of the tables, which must outlive what is returned. Throws OperatorError when one
/// is no sweep's.
std::vector<ReportCase> FindCases(const std::vector<CaseTable>& tables);

/// Median over the runs that are valid; nothing without such a method, run or column.
std::optional<double> MedianOf(const CaseMethod* method, const SweepMeasure& measure);
/// The same of a column by its name.
std::optional<double> MedianOf(const CaseMethod* method, const std::string& column);
/// `value` with what is said of runs that are not valid, or "–" for no such method.
std::string CellOf(const CaseMethod* method, const std::optional<double>& value);

}  // namespace seam
