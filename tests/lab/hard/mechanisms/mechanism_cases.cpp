/// Mechanisms that carry, drive and collide: joints and contacts on the same bodies.

#include <fmt/format.h>

#include <algorithm>

#include "tests/lab/hard/hard_case.h"
#include "tests/lab/hard/invariant_judges.h"
#include "tests/lab/hard/mechanisms/mechanism_judges.h"

namespace seam {
namespace {

using Make = std::function<std::unique_ptr<Judge>(const Scene&)>;

HardCase Case(const std::string& name, const std::string& scene, Truth truth, const char* unit,
              const char* about, double seconds, Make judge) {
  HardCase hard;
  hard.name = name;
  hard.scene = scene;
  hard.truth = truth;
  hard.unit = unit;
  hard.about = about;
  hard.seconds = seconds;
  hard.judge = std::move(judge);
  return hard;
}

/// Piles on mechanisms: 25 m/s is more than any of them reaches by falling.
Make Stands(double away_m) {
  return [=](const Scene&) { return MakeDriftJudge({25, {}}, {away_m, Vec2(1, 0), 0}); };
}

void AddStanding(std::vector<HardCase>* cases) {
  const char* const drift = "the farthest any body came from where it stood, sideways";
  for (const auto& [name, away_m] :
       {std::pair("mass-ratio-hung", 0.5), std::pair("tower-linkage", 0.8)}) {
    cases->push_back(Case(name, name, Truth::kInvariant, "m", drift, 60, Stands(away_m)));
  }
  cases->push_back(Case("crane-grip", "crane-grip", Truth::kInvariant, "m",
                        "slip of a crate of 400 kg in the jaws that lift it", 20,
                        [](const Scene& scene) {
                          return MakeGripJudge({25, {}}, {"crate", "left", 1.4, 2, 0.5}, scene);
                        }));
}

void AddMoving(std::vector<HardCase>* cases) {
  // Three times what the motor's wheels roll at; 40 m is under half of what they do in 12 s.
  cases->push_back(Case("car-terrain", "car-terrain", Truth::kInvariant, "m",
                        "the farthest a wheel came off its axis", 12, [](const Scene& scene) {
                          return MakeJointDriftJudge({25, {}}, 0.5, {"chassis", {40, -5}}, scene);
                        }));
  // 30 m/s is more than a fall of 17 m gives, with a limb that whips.
  const WatchLimits pit{40, {-5.2, -0.2, 5.2, 30}};
  cases->push_back(Case(
      "ragdoll-pile", "ragdoll-pile", Truth::kInvariant, "m", "the worst joint of twenty ragdolls",
      20, [pit](const Scene& scene) { return MakeJointDriftJudge(pit, 0.5, {}, scene); }));
  cases->push_back(Case("ragdoll-pile-impact", "ragdoll-pile", Truth::kInvariant, "m",
                        "the deepest overlap of two limbs", 20,
                        [pit](const Scene& scene) { return MakeOverlapJudge(pit, 0, scene); }));
  cases->push_back(Case("ragdoll-pile-late", "ragdoll-pile", Truth::kInvariant, "m",
                        "the deepest overlap of two limbs in the last 5 s", 20,
                        [pit](const Scene& scene) { return MakeOverlapJudge(pit, 15, scene); }));
}

/// The wagon has no room for all of them beside each other: how far they come apart is not asked.
void AddJammed(std::vector<HardCase>* cases) {
  cases->push_back(Case("wagon-jam", "wagon-jam", Truth::kInvariant, "m/s",
                        "greatest speed of ten crates jammed between the rails of a wagon", 10,
                        [](const Scene& scene) {
                          return MakeReleaseJudge({40, {-40, -1, 40, 30}}, kNoLimit, scene);
                        }));
}

/// A closed box where nothing takes energy away, cut into several substeps.
void AddElastic(std::vector<HardCase>* cases) {
  for (const char* scene : {"disc-box", "rod-box"}) {
    for (const int substeps : {1, 2, 4, 8}) {
      HardCase hard =
          Case(fmt::format("{}-x{}", scene, substeps), scene, Truth::kFormula, "J/J",
               "greatest change of the energy, which stays, 60 s", 60, [](const Scene& s) {
                 return MakeEnergyJudge({500, {-26, -26, 26, 26}}, s);
               });
      hard.adjust = [substeps](Scene* s) { s->solver.substeps = substeps; };
      hard.exact_substeps = {substeps};
      cases->push_back(hard);
    }
  }
}

/// Leaves the parts and joints whose names begin with `kind`.
void Only(const std::string& kind, Scene* scene) {
  const auto other = [&](const std::string& name) { return name.rfind(kind + '-', 0) != 0; };
  for (Part& part : scene->parts) part.gone = other(part.name);
  for (Joint& joint : scene->joints) joint.gone = other(joint.name);
}

void AddLoads(std::vector<HardCase>* cases) {
  for (const char* kind : {"distance", "hinge", "prismatic", "rope", "weld", "wheel"}) {
    HardCase hard = Case(fmt::format("joint-load-{}", kind), "joint-load", Truth::kFormula, "m",
                         "the worst of two joints that bear 100 times a link's weight: 0", 10,
                         [](const Scene& scene) {
                           return MakeJointDriftJudge({60, {}}, 5, {}, scene);
                         });
    hard.adjust = [kind](Scene* scene) { Only(kind, scene); };
    cases->push_back(hard);
  }
}

}  // namespace

std::vector<HardCase> MechanismCases() {
  std::vector<HardCase> cases;
  AddStanding(&cases);
  AddMoving(&cases);
  AddJammed(&cases);
  AddElastic(&cases);
  AddLoads(&cases);
  return cases;
}

}  // namespace seam
