#include "tests/lab/hard/settings.h"

#include <fmt/format.h>

#include <cmath>

#include "common/scene/scene_limits.h"

namespace seam {
namespace {

constexpr float kSmallSkin = 0.0025f;  // m; things rest where they touch

/// The levers of one try; skin 0 is the engine's own.
struct Levers {
  int tick_hz, substeps, velocity, position;
  float skin;
  bool warm;
};

/// One lever at a time from the stock setting, then with it the skin; after that what costs as much
/// as stock or little more in other ways; dear ones last.
const std::vector<Levers> kReportLevers = {
    {60, 1, 8, 3, kSmallSkin, true},  {60, 2, 4, 1, kSmallSkin, true},
    {60, 4, 2, 1, kSmallSkin, true},  {60, 2, 8, 3, kSmallSkin, true},
    {60, 1, 8, 3, 0, false},          {60, 1, 4, 1, 0, true},
    {60, 1, 2, 1, 0, true},           {60, 1, 1, 1, 0, true},
    {60, 1, 16, 3, 0, true},          {60, 1, 32, 3, 0, true},
    {60, 1, 8, 1, 0, true},           {60, 1, 8, 8, 0, true},
    {60, 2, 8, 3, 0, true},           {60, 4, 8, 3, 0, true},
    {30, 2, 8, 3, 0, true},           {30, 2, 4, 1, 0, true},
    {30, 2, 2, 1, 0, true},           {30, 2, 1, 1, 0, true},
    {30, 2, 8, 3, kSmallSkin, true},  {30, 2, 4, 1, kSmallSkin, true},
    {30, 2, 1, 1, kSmallSkin, true},  {20, 3, 8, 3, 0, true},
    {20, 3, 4, 1, 0, true},           {20, 3, 8, 3, kSmallSkin, true},
    {20, 3, 1, 1, kSmallSkin, true},  {120, 1, 8, 3, 0, true},
    {240, 1, 8, 3, 0, true},          {60, 2, 4, 1, 0, true},
    {60, 4, 2, 1, 0, true},           {60, 1, 4, 1, kSmallSkin, true},
    {60, 1, 2, 1, kSmallSkin, true},  {60, 4, 4, 1, kSmallSkin, true},
    {60, 4, 8, 3, kSmallSkin, true},  {60, 1, 8, 3, kSmallSkin, false},
    {60, 8, 2, 1, kSmallSkin, true},  {60, 8, 4, 1, kSmallSkin, true},
    {60, 1, 16, 3, kSmallSkin, true}, {60, 1, 32, 8, kSmallSkin, true},
    {30, 4, 4, 1, kSmallSkin, true},  {120, 1, 4, 1, kSmallSkin, true},
    {120, 2, 4, 1, kSmallSkin, true}, {240, 1, 4, 1, kSmallSkin, true},
    {60, 1, 1, 1, 0, false},          {60, 1, 32, 8, 0, true},
    {60, 3, 2, 1, kSmallSkin, true},  {60, 2, 2, 1, kSmallSkin, true},
    {60, 2, 16, 4, kSmallSkin, true}, {60, 8, 8, 3, kSmallSkin, true},
    {60, 8, 1, 1, kSmallSkin, true},  {240, 4, 8, 3, kSmallSkin, true},
    {240, 8, 8, 3, kSmallSkin, true}};
constexpr std::size_t kQuickLevers = 4;

std::vector<Levers> AllLevers() {
  std::vector<Levers> all;
  for (const float skin : {0.0f, kSmallSkin}) {
    for (const bool warm : {true, false}) {
      for (const int hz : {20, 30, 60, 120, 240}) {
        for (const int substeps : {1, 2, 3, 4, 6, 8}) {
          if (substeps < SubstepsMin(hz)) continue;
          for (const int velocity : {1, 2, 4, 8, 16, 32}) {
            for (const int position : {1, 2, 3, 5, 8}) {
              all.push_back({hz, substeps, velocity, position, skin, warm});
            }
          }
        }
      }
    }
  }
  return all;
}

/// Relative to 8/3: a pyramid of 40 rows takes 1.73 ms at 8/3 and 1.15 ms at 4/1.
double StepShare(const Solver& s) {
  return (6.9 + s.velocity_iterations + s.position_iterations) / (6.9 + 8 + 3);
}

}  // namespace

const char* JointsWord(JointSolving joints) {
  switch (joints) {
    case JointSolving::kAuto: return "auto";
    case JointSolving::kExact: return "exact";
    case JointSolving::kIterative: break;
  }
  return "iterative";
}

bool SameSolver(const Solver& a, const Solver& b) { return SolverLines(a) == SolverLines(b); }

std::string SolverWords(const Solver& s) {
  std::string words = fmt::format("{} Hz x{} {}/{}", s.tick_hz, s.substeps, s.velocity_iterations,
                                  s.position_iterations);
  if (s.contacts == ContactSolving::kSoft) words += fmt::format(" soft x{}", s.contact_substeps);
  if (s.skin > 0) words += fmt::format(" skin {:.3g} mm", static_cast<double>(s.skin) * 1e3);
  if (!s.warm_starting) words += " cold";
  if (!s.continuous) words += " not continuous";
  if (!s.sleep) words += " sleepless";
  if (s.joints != JointSolving::kIterative) {
    words += fmt::format(" joints {} x{}", JointsWord(s.joints), s.joint_substeps);
  }
  return words + (s.weld_joints ? " welds jointed" : "");
}

std::string SolverLines(const Solver& s) {
  const Solver none;
  std::string lines = "[solver]\n";
  const auto number = [&lines](const char* key, int value, int usual) {
    if (value != usual) lines += fmt::format("{} = {}\n", key, value);
  };
  const auto flag = [&lines](const char* key, bool value, bool usual) {
    if (value != usual) lines += fmt::format("{} = {}\n", key, value);
  };
  number("tick_hz", s.tick_hz, none.tick_hz);
  number("substeps", s.substeps, none.substeps);
  number("velocity_iterations", s.velocity_iterations, none.velocity_iterations);
  number("position_iterations", s.position_iterations, none.position_iterations);
  flag("sleep", s.sleep, none.sleep);
  flag("continuous", s.continuous, none.continuous);
  flag("warm_starting", s.warm_starting, none.warm_starting);
  if (s.skin > 0) lines += fmt::format("skin = {}\n", s.skin);
  if (s.contacts == ContactSolving::kSoft) lines += "contacts = \"soft\"\n";
  number("contact_substeps", s.contact_substeps, none.contact_substeps);
  if (s.joints != none.joints) lines += fmt::format("joints = \"{}\"\n", JointsWord(s.joints));
  number("joint_substeps", s.joint_substeps, none.joint_substeps);
  if (s.weld_joints) lines += "welds = \"joint\"\n";
  return lines;
}

Scene WithSolver(const Scene& scene, const Solver& solver) {
  Scene changed = scene;
  changed.solver = solver;
  const auto retimed = [&](std::int64_t tick) {
    return std::llround(static_cast<double>(tick) * solver.tick_hz / scene.solver.tick_hz);
  };
  for (Player& player : changed.players) {
    for (InputSpan& span : player.script) span.from_tick = retimed(span.from_tick);
  }
  for (WatchCollision& watch : changed.watch) watch.around_tick = retimed(watch.around_tick);
  return changed;
}

double PredictedCpu(const Scene& scene, const Solver& solver, double seconds) {
  double bodies = 0;
  for (const Part& part : scene.parts) bodies += part.anchored || part.gone ? 0 : 1;
  const double step_us = 1 + 2 * bodies + 0.3 * static_cast<double>(scene.joints.size());
  return seconds * solver.tick_hz * solver.substeps * StepShare(solver) * step_us * 1e-6;
}

std::vector<Solver> GridSettings(GridSize size, const Solver& own) {
  std::vector<Levers> levers = size == GridSize::kFull ? AllLevers() : kReportLevers;
  if (size == GridSize::kQuick) levers.resize(kQuickLevers);
  std::vector<Solver> settings;
  for (const Levers& l : levers) {
    Solver s = own;
    s.tick_hz = l.tick_hz;
    s.substeps = l.substeps;
    s.velocity_iterations = l.velocity;
    s.position_iterations = l.position;
    s.skin = l.skin;
    s.warm_starting = l.warm;
    s.joints = JointSolving::kIterative;
    settings.push_back(s);
  }
  return settings;
}

}  // namespace seam
