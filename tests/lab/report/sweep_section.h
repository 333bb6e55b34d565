#pragma once
/// What the report shows of one sweep: curves of every measure, fronts where the axis is a setting
/// of ours, tables of medians with quartiles.

#include <string>
#include <vector>

#include "tests/lab/report/page.h"
#include "tests/lab/report/sweep_view.h"

namespace seam {

/// A sweep's table, and how it was made.
struct Sweep {
  std::string name;  ///< of its file, without .csv
  std::string command;
  CsvTable table;
  SweepView view;
};

/// "others", the headline; "error" in tables that do not have it.
const SweepMeasure& HeadlineOf(const Sweep& sweep);

/// Whether the axis is the delay of inputs: paid for with the own response, not with CPU or bytes.
bool DelaysInputs(const Sweep& sweep);

Section SweepSection(const Sweep& sweep);

/// The front of one group: what each method costs and errs at each x.
struct MethodTrial {
  std::string method;
  double x = 0;
  CostError trial;  ///< medians
};
/// Medians of `cost` and of `error`; those that have both.
std::vector<MethodTrial> Trials(const Sweep& sweep, const SweepGroup& group,
                                const SweepMeasure& cost, const SweepMeasure& error);

/// Which methods are on which front, over all sweeps along a setting of ours: a row for each front,
/// a column for each method. Without such sweeps it has no rows.
TextTable FrontTable(const std::vector<Sweep>& sweeps);
/// A row for each scene and drive: its floors and held inputs, medians over all sweeps,
/// and which methods chaos leaves nothing to tell apart. Without floors it has no rows.
TextTable FloorTable(const std::vector<Sweep>& sweeps);
/// Seconds simulated per second of CPU, by method and scene, over all sweeps.
TextTable SpeedTable(const std::vector<Sweep>& sweeps);

}  // namespace seam
