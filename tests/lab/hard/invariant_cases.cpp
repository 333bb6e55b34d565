#include <algorithm>
#include <cmath>

#include "tests/lab/hard/hard_case.h"
#include "tests/lab/hard/invariant_far.h"
#include "tests/lab/hard/invariant_judges.h"

namespace seam {
namespace {

using Make = std::function<std::unique_ptr<Judge>(const Scene&)>;

HardCase Case(const std::string& name, const char* unit, const char* about, Make judge) {
  HardCase hard;
  hard.name = hard.scene = name;
  hard.truth = Truth::kInvariant;
  hard.unit = unit;
  hard.about = about;
  hard.judge = std::move(judge);
  return hard;
}

const char* const kDrift = "the farthest any body came from where it stood, across its weight";
const char* const kSag = "the farthest any body came from where it hung";
const char* const kShake = "the farthest any body came from where it was after 2 s";
const char* const kFar = "the farthest any body came from where it is in the same scene at 0 km";
const char* const kReach = "by how much a body was farther from its hook than its joints allow";

/// Piles. 25 m/s is more than any of them reaches by falling.
Make Stands(double away_m) {
  return [=](const Scene&) { return MakeDriftJudge({25, {}}, {away_m, Vec2(1, 0), 0}); };
}

/// Where the skin shows in all directions: two seconds are given to it.
Make Rests(double away_m) {
  return [=](const Scene&) { return MakeDriftJudge({25, {}}, {away_m, Vec2(0, 0), 2}); };
}

/// Hung up. `speed_mps`: above what the fall of all its weight can give its lightest member.
Make Hangs(double speed_mps) {
  return [speed_mps](const Scene& scene) { return MakeReachJudge({speed_mps, {}}, 5, scene); };
}

/// The same scene at four distances from the origin; in both directions, because what stands at a
/// far x alone has its heights near 0, where they are exact.
void AddFar(const std::string& scene, const char* about,
            const std::function<Make(const Vec2& by)>& judge, std::vector<HardCase>* cases) {
  for (const int km : {0, 1, 10, 100}) {
    const Vec2 by = static_cast<float>(km) * Vec2(800, 600);
    HardCase hard = Case(scene, "m", about, judge(by));
    hard.name = scene + "-" + std::to_string(km) + "km";
    hard.adjust = [by](Scene* s) { ShiftScene(by, s); };
    cases->push_back(hard);
  }
}

/// Piles far away.
Make StandsAsNear(const Vec2& by) {
  return [by](const Scene&) { return MakeFarJudge({25, {}}, 1, by); };
}

void AddPiles(std::vector<HardCase>* cases) {
  cases->push_back(Case("arch", "m", kShake, Rests(0.5)));
  cases->push_back(Case("card-house", "m", kDrift, Stands(0.3)));
  cases->push_back(Case("card-house-apart", "m", kDrift, Stands(0.3)));
  AddFar("far-pyramid", kFar, StandsAsNear, cases);
  AddFar("far-tilted", kFar, StandsAsNear, cases);
  cases->push_back(Case("mass-ratio", "m", kDrift, Stands(0.5)));
  cases->push_back(Case("pyramid-20", "m", kDrift, Stands(1)));
  cases->push_back(Case("tower-10", "m", kDrift, Stands(0.5)));
  cases->push_back(Case("tower-30", "m", kDrift, Stands(0.8)));
}

/// 0.5 m and four storeys of arms of 5 m between their joints, at 0.15 + 1.2/2 rad.
const double kLiftHeight = 0.5 + 4 * 5 * std::sin(0.75);

void AddMechanisms(std::vector<HardCase>* cases) {
  cases->push_back(Case("ball-and-chain", "m", kReach, Hangs(300)));
  cases->push_back(Case("bridge", "m", kReach, Hangs(100)));
  AddFar(
      "far-chain", kReach, [](const Vec2&) { return Hangs(100); }, cases);
  cases->push_back(Case("joint-grid", "m", kSag, [](const Scene&) {
    return MakeDriftJudge({200, {}}, {5, Vec2(0, 0), 0});
  }));
  cases->push_back(Case("scissor-lift", "m", "height of the platform", [](const Scene& scene) {
    return MakeArrivalJudge({50, {}}, {"platform", kLiftHeight, 10, 1}, scene);
  }));
}

void AddCrowds(std::vector<HardCase>* cases) {
  cases->push_back(Case("confined", "m/s", "RMS speed after 30 s", [](const Scene&) {
    return MakeRestlessJudge({50, {-8, -8, 8, 8}}, 30);
  }));
  cases->push_back(Case("double-domino", "m", "drift after 10 s", [](const Scene&) {
    return MakeToppleJudge({15, {}}, {kNoLimit, Vec2(0, 0), 10});
  }));
  cases->push_back(Case("overlap", "m/s", "greatest speed", [](const Scene& scene) {
    return MakeReleaseJudge({5, {-20, -20, 20, 20}}, 0.01, scene);
  }));
  cases->push_back(Case("rush", "m/s", "RMS speed after 15 s", [](const Scene&) {
    return MakeRestlessJudge({60, {-40, 0, 40, 80}}, 15);
  }));
  cases->push_back(Case("thousand", "m", "drift after 20 s", [](const Scene&) {
    return MakeDriftJudge({50, {-40, 0, 40, 60}}, {kNoLimit, Vec2(0, 0), 20});
  }));
}

}  // namespace

std::vector<HardCase> InvariantCases() {
  std::vector<HardCase> cases;
  AddPiles(&cases);
  AddMechanisms(&cases);
  AddCrowds(&cases);
  std::sort(cases.begin(), cases.end(),
            [](const HardCase& a, const HardCase& b) { return a.name < b.name; });
  return cases;
}

}  // namespace seam
