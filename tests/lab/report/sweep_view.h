#pragma once
/// A view of a sweep's table for curves: the column that was varied, and the runs of each scene,
/// drive and method along it.

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tests/lab/experiment/csv_table.h"
#include "tests/lab/report/statistics.h"

namespace seam {

/// The quantity on the x axis.
struct SweepAxis {
  std::string key;    ///< one_way_ms, loss_percent, send_hz, ...
  std::string name;   ///< "one-way latency"
  std::string unit;   ///< "ms"
  bool ours = false;  ///< a setting we choose, not one the network imposes
};

/// The runs of one scene and drive.
struct SweepGroup {
  std::string scene, drive;          ///< "wall", "bot"
  std::vector<std::string> methods;  ///< in the order of MethodOrder
  std::vector<double> xs;            ///< ascending
  std::map<std::string, std::map<double, std::vector<std::size_t>>> runs;  ///< rows of the table
};

struct SweepView {
  SweepAxis axis;
  std::string fixed;               ///< settings common to all runs: "loss=1%, 30 Hz"
  std::vector<SweepGroup> groups;  ///< in the order of the table
};

/// One figure of merit of a run.
struct SweepMeasure {
  std::string id;    ///< "error"
  std::string name;  ///< "error, RMS"
  std::string unit;  ///< "m"
  bool log = true;
  std::function<std::optional<double>(const CsvTable&, std::size_t row)> value;
  std::string Label() const { return name + (unit.empty() ? "" : " (" + unit + ")"); }
};

/// error, seam, stutter, rebound, penetration, handover, gap, bytes.
const std::vector<SweepMeasure>& SweepMeasures();
/// CPU time of server and clients, ms per second of the session.
const SweepMeasure& CpuMeasure();
/// Limits that no method is expected to beat: the scene's own sensitivity, to a micrometre, to the
/// wire's resolution and to barriers, and the error of held inputs.
const std::vector<SweepMeasure>& FloorMeasures();
/// Error of others' bodies on clients' screens as a multiple of that of held inputs.
const SweepMeasure& LimitMeasure();
/// Overlap in the oracle itself.
const SweepMeasure& OraclesPenetration();
/// One of the above by its id, or "cpu".
const SweepMeasure& MeasureNamed(const std::string& id);

/// "strict", "fade" for mode buffer with that rule, "central/all".
std::string MethodName(const CsvTable& table, std::size_t row);

/// Groups by scene and drive. The axis is the key column with the most different values (impair is
/// split into one_way_ms, loss_percent and jitter_ms); other columns that were varied become part
/// of the method's name. Throws OperatorError when the table is no sweep's.
SweepView ViewSweep(const CsvTable& table);

/// Returns quartiles of one measure over the runs of one method at one x; nothing where no run has
/// it.
std::optional<Quartiles> QuartilesOf(const CsvTable& table, const SweepMeasure& measure,
                                     const std::vector<std::size_t>& rows);
/// The same over all runs of a group.
std::optional<Quartiles> QuartilesOf(const CsvTable& table, const SweepMeasure& measure,
                                     const SweepGroup& group);

}  // namespace seam
