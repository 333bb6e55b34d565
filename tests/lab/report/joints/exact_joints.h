#pragma once
/// Exact joints beside stock: error, overlap and cost of each case that has a bar, and the bars.

#include <optional>
#include <string>
#include <vector>

#include "tests/lab/report/page.h"
#include "tests/lab/report/physics_view.h"

namespace seam {

/// What a case's exact joints must hold.
struct JointBar {
  std::string name;             ///< of the hard case
  bool drift = false;           ///< judged by its joints' drift, m, not by the case's own error
  std::optional<double> error;  ///< at most this; empty: no more than stock's
  std::optional<double> overlap_m, cost;  ///< at most; cost: of stock's. Empty: no bar
};
const std::vector<JointBar>& JointBars();

/// What of the bar a run misses, in words: "error", "overlap", "cost", or how it failed. Empty: it
/// holds it.
std::vector<std::string> Missed(const JointBar& bar, const PhysicsRun& run,
                                const std::optional<PhysicsRun>& stock);

/// A row for each bar whose case is among `cases`: stock, the scene's setting with iterative
/// joints, exact joints, the bar, and whether one of the exact runs holds all of it (where a case
/// has no joints: whether the scene's setting does).
TextTable ExactJointsTable(const std::vector<PhysicsCase>& cases, const std::string& command);

/// Over all cases: what error no worse than stock's costs, median; which cases the scenes' setting
/// makes worse than iterative joints do; and the core's step beside raw Box2D. `overhead` may be
/// null.
TextTable ExactJointsSummary(const std::vector<PhysicsCase>& cases, const CsvTable* overhead,
                             const std::string& command);

Section ExactJointsSection(const CsvTable& physics, const CsvTable* overhead,
                           const std::string& command);

}  // namespace seam
