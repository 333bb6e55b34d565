#pragma once
/// Solves islands without joints by soft contacts in substeps (docs/solver.md, Soft contacts).
/// Contacts are found once, by the engine; poses, velocities and impulses are the engine's own
/// between steps, so snapshots carry them.

#include <cstddef>
#include <vector>

#include "common/base/spatial/disjoint_sets.h"
#include "common/physics/contacts/soft_solve.h"
#include "common/physics/world_build.h"

namespace seam {

class SoftStep {
 public:
  /// `made`: the moving bodies that are in the world, by index in `built`. Both must outlive this.
  SoftStep(const Solver& solver, b2World* world, const BuiltScene& built,
           const std::vector<int>& made);

  /// Advances each awake island without joints by h s, between the engine's narrow phase and its
  /// continuous collision. Reports the impulses (PostSolve). Ignores disabled bodies and contacts.
  /// Returns true if an awake island is left to the engine. The others are hidden from it until
  /// Show.
  bool Solve(float h);
  void Show();

  /// Called before continuous collision, between Show and Widen: leaves only those contacts in the
  /// engine's list that need it. `driven`: a kinematic body moves. Returns false if there are none.
  bool Narrow(bool driven);
  /// Restores the list; new contacts come first.
  void Widen();
  /// Called before continuous collision solves an impact of the body: takes back the fall of the
  /// rest of the step, so that a body in flight strikes as fast as it is there.
  void AtImpact(b2Body* body);
  /// Called after continuous collision: gives back the fall that AtImpact has taken.
  void Fall();

 private:
  struct Island {  // in `islands_` at the index of its lowest body
    bool awake = false, jointed = false, driven = false;
    int points = 0;   // of its contacts
    float quiet = 0;  // s for which all its bodies have been slow
  };
  struct Pair {  // a contact that pushes; indices into bodies_, -1: does not move
    b2Contact* made = nullptr;
    int a = -1, b = -1;
  };

  struct Link {  // a contact that stays in the engine's list, and its neighbours there before
    b2Contact *made, *before, *after;
  };

  Island& IslandOf(int body) { return islands_[static_cast<std::size_t>(sets_.Find(body))]; }
  int PlaceOf(b2Body* body) const;
  void FindIslands();
  bool FindOurs();
  void Load();
  int Fixed(b2Body* body);
  void LoadContacts();
  void Save(float h);
  void Report();
  void FindReaches();
  bool IsSlow(std::size_t i) const;
  bool MayPass(std::size_t i, const b2ContactEdge& edge) const;

  const int substeps_, sweeps_;
  b2World* world_;
  std::vector<int> place_;     // by moving body: index into all_; -1: aside
  std::vector<b2Body*> all_;   // the moving bodies in the world
  std::vector<int> joints_;    // pairs of indices into all_ that a joint connects
  std::vector<char> jointed_;  // by index into all_
  DisjointSets sets_{0};       // of indices into all_: the islands
  std::vector<Island> islands_;
  std::vector<Pair> pairs_;
  std::vector<int> ours_;       // indices into all_, in the order of soft_.bodies
  std::vector<int> index_;      // by index into all_: in soft_.bodies, -1: not ours
  std::vector<b2Body*> fixed_;  // kinematic bodies of contacts
  SoftContacts soft_;
  float step_s_ = 0;            // of the last Solve
  std::vector<char> touched_;   // by index in soft_.bodies: pushed by a contact
  std::vector<float> untaken_;  // likewise: s of fall that AtImpact has taken back
  std::vector<float> reach_;    // by index into all_: m, from the centre to the farthest point
  std::vector<Link> narrowed_;
  b2Contact* first_contact_ = nullptr;  // in the engine's list, before Narrow
};

}  // namespace seam
