#pragma once
/// Solver settings to try on a scene: their choice, their order, and their approximate cost.

#include <string>
#include <vector>

#include "common/scene/scene.h"

namespace seam {

enum class GridSize {
  kQuick,   ///< a handful of settings, 60 s steps of 10 s
  kReport,  ///< each lever alone, and the combinations that matter
  kFull,    ///< all combinations: hours
};

bool SameSolver(const Solver& a, const Solver& b);

/// "60 Hz x2 4/1 skin 2.5 mm": ticks, substeps, velocity/position iterations, then all settings
/// that differ from the stock setting.
std::string SolverWords(const Solver& solver);

/// "auto", "exact" or "iterative", as in scenes.
const char* JointsWord(JointSolving joints);

/// `[solver]` with the lines that differ from what a scene has without them.
std::string SolverLines(const Solver& solver);

/// The scene with another solver. Scripted inputs keep their times (to the tick).
Scene WithSolver(const Scene& scene, const Solver& solver);

/// CPU seconds, predicted alike on every machine, if nothing ever sleeps: 2 us a body and step at
/// 8/3 iterations, as a pyramid takes on a machine of 2020. Single bodies take less.
double PredictedCpu(const Scene& scene, const Solver& solver, double seconds);

/// Settings to try besides the stock and the scene's own one, most telling first, none twice. All
/// else (continuous collision, sleep, welds) is as in `own`; joints are iterative.
std::vector<Solver> GridSettings(GridSize size, const Solver& own);

}  // namespace seam
