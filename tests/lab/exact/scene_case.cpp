#include "tests/lab/exact/scene_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "common/base/check.h"
#include "common/base/process.h"
#include "common/physics/part_places.h"
#include "tests/lab/exact/scene_truth.h"
#include "tests/lab/experiment/jobs.h"
#include "tests/lab/hard/exact_judge.h"
#include "tests/lab/hard/script_player.h"

namespace seam {
namespace {

/// A number that is never greater is 0, in any unit.
constexpr double kNothing = 1e-30;

double TimeOf(const World& world) {
  return static_cast<double>(world.tick()) / world.scene().solver.tick_hz;
}

/// Worst over time of what exact(t) says against what the world has.
class ExactJudge : public Judge {
 public:
  /// `scale`: what the error of a number is divided by.
  ExactJudge(const Scene& scene, const std::string& file, double scale)
      : truth_(scene, file), scale_(scale) {}

  void See(const World& world) override {
    const ExactMoment moment = truth_.At(TimeOf(world));
    if (moment.poses.empty()) {
      worst_ = Worse(worst_, std::fabs(truth_.Measured(world) - moment.value) / scale_);
    }
    for (const auto& [part, wanted] : moment.poses) {
      const BodyState state = PartPose(world, part);
      worst_ = Worse(
          worst_, Displacement(world.scene().parts[static_cast<std::size_t>(part)], state, wanted));
    }
  }
  double Error() const override { return worst_; }

 private:
  SceneTruth truth_;
  const double scale_;
  double worst_ = 0;
};

std::string NameOf(const std::string& file) {
  std::string name = std::filesystem::path(file).stem().string();
  for (char& c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (!plain) c = '-';
  }
  return name;
}

/// Runs the scene once with its own setting, for what measured(t) says of it, in a process of its
/// own: what the engine does not survive is for the table to say. Throws what the judge would.
void RehearseMeasured(const Scene& scene, double seconds, SceneTruth* truth) {
  std::string complaint;
  RunJobs(
      1, 1,
      [&](std::size_t) -> std::string {
        World world(scene);
        ScriptPlayer hand(scene);
        const std::int64_t ticks = std::llround(seconds * scene.solver.tick_hz);
        try {
          truth->Measured(world);
          while (world.tick() < ticks) {
            hand.Play(scene, world.tick() + 1, &world);
            world.Step();
            truth->Measured(world);
          }
        } catch (const OperatorError& e) {
          return e.what();
        }
        return "";
      },
      [&](std::size_t, const JobResult& result) {
        if (result.good) complaint = result.text;
      },
      [] { return g_stop != 0; });
  if (!complaint.empty()) throw OperatorError(complaint);
}

/// Calls exact(t) and measured(t) as the judge will; the greatest number that exact(t) says.
double Rehearse(const Scene& scene, double seconds, SceneTruth* truth) {
  double greatest = 0;
  for (const int hz : {30, 60, 120, 240, scene.solver.tick_hz}) {  // what the grid has
    for (std::int64_t tick = 0; tick <= std::llround(seconds * hz); ++tick) {
      greatest = std::max(greatest, std::fabs(truth->At(static_cast<double>(tick) / hz).value));
    }
  }
  truth->AskAgain();
  if (truth->scalar() && truth->measures()) RehearseMeasured(scene, seconds, truth);
  return greatest;
}

}  // namespace

HardCase SceneCase(const std::string& file, double seconds) {
  const Scene scene = LoadScene(file);
  HardCase made;
  made.name = NameOf(file);
  made.scene = file;
  made.seconds = seconds > 0 ? seconds : std::min(scene.duration_s, kSceneSecondsMax);
  SceneTruth truth(scene, file);
  if (!truth.found()) {
    if (World(scene).body_count() == 0) {
      throw OperatorError(file + ": nothing moves, and no script says exact(t)");
    }
    made.truth = Truth::kConverged;
    made.unit = "m";
    made.about = "RMS distance of all parts from the scene's own run at 60 Hz x32 8/3";
    return made;
  }
  made.truth = Truth::kFormula;
  const double greatest = Rehearse(scene, made.seconds, &truth);
  const double scale = truth.scalar() && greatest > kNothing ? greatest : 1;
  const std::string unit = truth.unit().empty() ? "1" : truth.unit();
  if (!truth.scalar()) {
    made.unit = "m";
    made.about = "worst distance of any point of a part from where exact(t) has it";
  } else if (greatest > kNothing) {
    made.unit = unit.find_first_of("1/ ") != std::string::npos ? "1" : unit + "/" + unit;
    made.about = fmt::format(
        "worst error of {} against exact(t), of the greatest that it says, "
        "{:.4g} {}",
        truth.name(), greatest, unit);
  } else {
    made.unit = unit;
    made.about = fmt::format("worst error of {} against exact(t), which is 0", truth.name());
  }
  made.judge = [file, scale](const Scene& judged) {
    return std::make_unique<ExactJudge>(judged, file, scale);
  };
  return made;
}

std::vector<HardCase> SceneCases(const std::vector<std::string>& files, double seconds) {
  std::vector<HardCase> cases;
  std::set<std::string> names;
  const auto add = [&](HardCase made, const std::string& file) {
    if (!names.insert(made.name).second) {
      throw OperatorError(file + ": there is another case '" + made.name + "'");
    }
    cases.push_back(std::move(made));
  };
  for (const std::string& file : files) {
    const std::filesystem::path path(file);
    const bool in_hard = std::filesystem::absolute(path).parent_path().filename() == "hard";
    bool known = false;
    for (const HardCase& hard : HardCases()) {
      if (!in_hard || hard.scene != path.stem().string()) continue;
      HardCase placed = hard;
      placed.scene = file;
      if (seconds > 0) placed.seconds = seconds;
      add(std::move(placed), file);
      known = true;
    }
    if (!known) add(SceneCase(file, seconds), file);
  }
  return cases;
}

}  // namespace seam
