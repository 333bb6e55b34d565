#pragma once
/// One of the engine's steps, in which islands that contain a joint are solved as one system
/// (ExactIsland) and all others by the engine, bit for bit as ever. The engine finds contacts,
/// keeps the tree of boxes and does continuous collision for all.

#include <memory>
#include <vector>

#include "common/physics/exact/free_blows.h"
#include "common/physics/exact/island.h"
#include "common/physics/world.h"
#include "common/physics/world_build.h"
#include "common/scene/scene.h"

namespace seam {

class ExactStep {
 public:
  /// `memory`: what is made. `gives_all`: GivesAll of the scene. Neither this nor a step does
  /// anything for each body that is aside.
  ExactStep(const Scene& scene, b2World* world, const BuiltScene& built, const BuildMemory& memory,
            bool gives_all);
  ~ExactStep();

  /// Whether there is a joint that it would solve, or a blow that gives everything back; else the
  /// engine's own Step does.
  bool needed() const;

  /// Islands that are left to the engine or relaxed since they took too much: by the lowest moving
  /// body of the first mechanism, for how many more steps while they are awake. Ascending.
  std::vector<WorldSnapshot::Left> Left() const;
  /// Of what is no mechanism's lowest body, nothing.
  void Leave(const std::vector<WorldSnapshot::Left>& left);

  /// As b2World::Step.
  void Step(float h, int velocity_iterations, int position_iterations);

 private:
  struct Slot {  // of a moving body that is in the world
    b2Body* body = nullptr;
    int mechanism = -1;
    int island = -1;  // in this step
    int place = -1;   // in its list of bodies
    // What it was left with, and the same as the engine has it.
    bool known = false;
    bool solved = false;  // in this step, not left to the engine
    bool struck = false;  // by something that moves, in continuous collision
    double x = 0, y = 0, a = 0, vx = 0, vy = 0, w = 0;
    double c = 1, s = 0;  // cosine and sine of a, turned with it for `turns` steps
    int turns = 0;
    double lasting = 0;  // ExactBody::lasting
    float told_x = 0, told_y = 0, told_a = 0, told_vx = 0, told_vy = 0, told_w = 0;
  };
  struct Mechanism {
    std::vector<int> slots;   // in the order of the system
    std::vector<int> joints;  // indices
    bool exact = true;        // false: its envelope is too large
    bool easy = true;         // the engine comes to terms with it at any moment
  };
  struct Found {  // an island, under the number of its first mechanism
    std::vector<int> slots, mechanisms;
    std::vector<b2Contact*> contacts;
    std::vector<const void*> sign;  // of what `island` was built for
    std::unique_ptr<ExactIsland> island;
    int left_for = 0;      // steps for which it is not solved as a whole, since it took too much
    bool relaxed = false;  // in this step
  };

  /// -1: of none that moves.
  int SlotOf(b2Body* body) const {
    const int moving = IndexOf(body);
    return moving < 0 ? -1 : slot_of_[static_cast<std::size_t>(moving)];
  }
  void FindMechanisms();
  bool Easy(const Mechanism& mechanism) const;
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
  bool Solve(const Pace& pace, bool warm, Found* found);
  void LeaveOne(float h, const Found& found);
  class Quiet;
  void Continuous(const b2TimeStep& step, const Pace& pace);
  void RejoinWhatMoved(float h, const Pace& pace);
  double EnergyOf(const Found& found, bool left) const;
  void PayForLift(double before, Found* found) const;
  static void WakeWhatMoves(const Found& found);
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
  std::unique_ptr<FreeBlows> blows_;  // nullptr: nothing gives everything back
  // Room for Order: by place in a list of bodies, who is joined to it, and whether it was seen.
  std::vector<std::vector<int>> near_;
  std::vector<char> seen_;
  std::vector<int> order_;
  bool paths_ = false;  // something anchored is moved along a path
};

}  // namespace seam
