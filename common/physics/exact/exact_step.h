#pragma once
/// One of the engine's steps, in which islands that contain a joint are solved as one system
/// (ExactIsland), and others by soft contacts where the scene says so (SoftStep). All other islands
/// are solved by the engine, bit for bit as without this class.
/// The engine finds contacts, keeps the tree of boxes and does continuous collision for all.

#include <memory>
#include <vector>

#include "common/physics/contacts/soft_step.h"
#include "common/physics/exact/elastic_impacts.h"
#include "common/physics/exact/island.h"
#include "common/physics/world.h"
#include "common/physics/world_build.h"
#include "common/scene/scene.h"

namespace seam {

class ExactStep {
 public:
  /// `memory`: lists the bodies and joints that are made. `has_elastic`: the result of HasElastic
  /// for the scene. Bodies that are aside cost nothing, neither here nor in a step.
  ExactStep(const Scene& scene, b2World* world, const BuiltScene& built, const BuildMemory& memory,
            bool has_elastic);
  ~ExactStep();

  /// True if contacts are soft, or there is a joint to solve or an elastic contact (restitution 1);
  /// else the engine's own Step does.
  bool needed() const;

  /// Returns the islands that are left to the engine, or relaxed, because they were too expensive:
  /// the lowest moving body of the first mechanism, and the number of steps left while awake.
  /// Ascending.
  std::vector<WorldSnapshot::Left> Left() const;
  /// Restores the result of Left. Ignores bodies that are not the lowest of a mechanism.
  void Leave(const std::vector<WorldSnapshot::Left>& left);

  /// Steps like b2World::Step.
  void Step(float h, int velocity_iterations, int position_iterations);

 private:
  struct Slot {  // a moving body that is in the world
    b2Body* body = nullptr;
    int mechanism = -1;
    int island = -1;  // in this step
    int place = -1;   // index in that island's list of bodies
    // The state after the last solve, in double precision and as rounded in the engine.
    bool known = false;
    bool solved = false;  // in this step, not left to the engine
    bool struck = false;  // by another moving body, in continuous collision
    double x = 0, y = 0, a = 0, vx = 0, vy = 0, w = 0;
    double c = 1, s = 0;  // cosine and sine of a, turned with it for `turns` steps
    int turns = 0;
    double lasting = 0;  // ExactBody::lasting
    float engine_x = 0, engine_y = 0, engine_a = 0, engine_vx = 0, engine_vy = 0, engine_w = 0;
  };
  struct Mechanism {          // without joints: a load
    std::vector<int> slots;   // in the order of the system
    std::vector<int> joints;  // indices into joints_
    bool exact = true;        // false: too expensive to factor
    float lightest = 0;       // LightestLink
  };
  struct Found {  // an island, stored at the index of its first mechanism
    std::vector<int> slots, mechanisms;
    std::vector<b2Contact*> contacts;
    std::vector<const void*> sign;  // key of the contents that `island` was built for
    std::unique_ptr<ExactIsland> island;
    int fallback_steps = 0;  // steps for which it is not solved as a whole: it was too expensive
    bool relaxed = false;  // in this step
  };

  /// Returns -1 for a body that does not move.
  int SlotOf(b2Body* body) const {
    const int moving = IndexOf(body);
    return moving < 0 ? -1 : slot_of_[static_cast<std::size_t>(moving)];
  }
  void FindMechanisms();
  void FindLoads();
  bool Counts(const Mechanism& mechanism) const;
  /// Returns the least mass that tears between heavy ends, kg; b2_maxFloat: none does.
  float LightestLink(const Mechanism& mechanism) const;
  /// True if the engine solves the island's mechanisms well at any moment.
  bool Easy(const Found& found) const;
  static bool IsHeap(const Found& found);
  void LeaveCharacters(const Scene& scene);
  void LeaveLarge();
  bool Gather(int first, Found* found);
  void Sign(const Found& found, std::vector<const void*>* sign) const;
  void Order(Found* found);
  long LeastCost(const Found& found);
  long Build(Found* found, bool relaxed);
  void LoadMoving(ExactBody* q);
  void LoadPoses(Found* found);
  void Load(Found* found);
  void Save(Found* found, float h);
  void SavePoses(const Found& found);
  void Prepare(float h, Found* found);
  void MoveKinematics(float h);
  bool Driven() const;
  bool Solve(const Pace& pace, bool warm, Found* found);
  void LeaveToEngine(float h, const Found& found);
  class Quiet;
  void Continuous(const b2TimeStep& step, const Pace& pace);
  void RejoinMoved(float h, const Pace& pace);
  double EnergyOf(const Found& found, bool left) const;
  void RemoveLiftEnergy(double before, const std::vector<ExactBody>& from, Found* found) const;
  static void WakeMoved(const Found& found);
  static bool Told(const Slot& slot);
  void Report(const Found& found) const;
  static void Hide(const Found& found);
  static void Show(const Found& found);

  const Solver solver_;
  b2World* world_;
  std::vector<int> slot_of_;  // by moving body; -1: aside
  std::vector<Slot> slots_;   // in the order of the bodies
  std::vector<ExactJoint> joints_;
  std::vector<Mechanism> mechanisms_;
  std::vector<Found> found_;
  std::vector<const void*> sign_;
  std::vector<int> solved_;
  std::unique_ptr<ElasticImpacts> blows_;  // nullptr: nothing is elastic
  std::unique_ptr<SoftStep> soft_;         // nullptr: contacts are the engine's
  // Scratch space of Order: by index in a list of bodies, its neighbours, and if it was visited.
  std::vector<std::vector<int>> near_;
  std::vector<char> seen_;
  std::vector<int> order_;
  std::vector<b2Body*> paths_;  // anchored bodies that move along a path
};

}  // namespace seam
