#pragma once
/// What a tick's contacts did: impacts, touches, and which directions are blocked.

#include <vector>

#include "common/physics/world.h"
#include "common/physics/world_build.h"

namespace seam {

/// Listens to Box2D and sums the normal impulses of a tick's substeps by pair of bodies.
class ImpulseMeter : public b2ContactListener {
 public:
  /// `substeps` per tick: into how many parts a blow may be divided. `lightest`: least mass that
  /// moves, kg.
  void Set(int substeps, float lightest) {
    counts_from_ = kImpactRecordMin / (kShares * static_cast<float>(substeps));
    least_ = counts_from_ * lightest;
  }
  void Clear() { felt_.clear(); }
  /// Ascending by pair; only those above kImpactRecordMin.
  std::vector<Impact> Impacts(const std::vector<MovingBody>& moving);

  void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override;

 private:
  /// A contact's impulse counts from this share of the least impact in each substep: resting bodies
  /// cost almost nothing, and a blow is overlooked only if three shapes of one body share it.
  static constexpr float kShares = 2;
  struct Felt {
    int body_a = -1, body_b = -1;  // a < b
    float impulse = 0;             // N s, of all contact points
    Vec2 point{0, 0};              // m
  };
  std::vector<Felt> felt_;  // in the order of solving
  float counts_from_ = 0;   // m/s: impulse over the lighter body's mass
  float least_ = 0;         // N s: counts_from_ for the lightest body of all
};

/// Touching pairs of moving bodies, ascending, each once.
std::vector<Touch> FindTouches(const b2World& world);

/// Touching pairs of parts, ascending, each once; not what stages have added. Of anchored ones that
/// are one shape that which is touched.
std::vector<PartTouch> FindPartTouches(const b2World& world, const Scene& scene,
                                       const BuiltScene& built);

/// At most two directions for each body, ascending by body.
std::vector<BlockedDirection> FindBlockedDirections(const b2World& world,
                                                    const std::vector<b2DistanceJoint*>& tethers);

}  // namespace seam
