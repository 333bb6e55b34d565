#pragma once
/// Results of a tick's contacts: impacts, touches and blocked directions.

#include <cstdint>
#include <unordered_set>
#include <vector>

#include "common/physics/world.h"
#include "common/physics/world_build.h"

namespace seam {

class OutlineContacts;

/// Notes the pairs of parts that begin to touch in a tick. The engine reports each contact that
/// begins, in every substep and in continuous collision, so a touch may end within its tick. Two
/// parts touch while any of their shapes do.
class TouchLog {
 public:
  /// Both must outlive this.
  TouchLog(const Scene& scene, const BuiltScene& built) : scene_(scene), built_(built) {}

  void BeginTick();
  void BeginSubstep(int substep);
  void EndTick(const b2World& world);
  /// To be called after the world was made anew. `before`: parts in touch when its tick was last
  /// stepped. Further touches of its poses begin in the next tick, where they would without that.
  void Rebuilt(const b2World& world, std::vector<PartTouch> before);

  void Begin(b2Contact* contact);
  void End(b2Contact* contact);

  const std::vector<PartTouch>& touching() const { return touching_; }  ///< after the last tick
  const std::vector<PartTouch>& begun() const { return begun_; }        ///< in the last tick

 private:
  const Scene& scene_;
  const BuiltScene& built_;
  std::vector<PartTouch> touching_, begun_, next_;  // ascending; next_: begin in the next tick
  std::unordered_set<std::uint64_t> ended_;         // pairs of shapes, in this substep
  int substep_ = -1;                                // -1: between ticks
};

/// Contact listener that corrects contacts by their outlines, and sums the normal impulses of a
/// tick's substeps by pair of bodies.
class ImpulseMeter : public b2ContactListener {
 public:
  /// `substeps`: per tick, the number of parts into which an impact may be divided. `lightest`:
  /// least mass of a moving body, kg.
  void Set(int substeps, float lightest) {
    counts_from_ = kImpactRecordMin / (kShares * static_cast<float>(substeps));
    least_ = counts_from_ * lightest;
  }
  /// `outlines` must outlive this.
  void SetOutlines(const OutlineContacts* outlines) { outlines_ = outlines; }
  void Clear() { felt_.clear(); }
  /// Tells the log, if any, of contacts that begin and end. It must outlive this.
  void Watch(TouchLog* log) { log_ = log; }
  /// Returns the impacts above kImpactRecordMin, ascending by pair.
  std::vector<Impact> Impacts(const std::vector<MovingBody>& moving);

  void PreSolve(b2Contact* contact, const b2Manifold* old) override;
  void BeginContact(b2Contact* contact) override {
    if (log_ != nullptr) log_->Begin(contact);
  }
  void EndContact(b2Contact* contact) override {
    if (log_ != nullptr) log_->End(contact);
  }
  void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override;

 private:
  /// Inverse of the share of the least impact that a contact's impulse needs in a substep to be
  /// counted. With it resting bodies cost almost nothing, and an impact is missed only if it is
  /// divided among three shapes of one body.
  static constexpr float kShares = 2;
  struct Felt {
    int body_a = -1, body_b = -1;  // a < b
    float impulse = 0;             // N s, of all contact points
    Vec2 point{0, 0};              // m
  };
  TouchLog* log_ = nullptr;
  std::vector<Felt> felt_;  // in the order of solving
  float counts_from_ = 0;   // m/s: impulse over the lighter body's mass
  float least_ = 0;         // N s: counts_from_ for the lightest body of all
  const OutlineContacts* outlines_ = nullptr;
};

/// Returns the touching pairs of moving bodies, ascending, each once.
std::vector<Touch> FindTouches(const b2World& world);

/// Returns the touching pairs of parts, ascending, each once, without fixtures of stages. If
/// anchored parts are merged into one shape, the part at the contact point counts.
std::vector<PartTouch> FindPartTouches(const b2World& world, const Scene& scene,
                                       const BuiltScene& built);

/// Returns at most two directions for each body, ascending by body.
std::vector<BlockedDirection> FindBlockedDirections(const b2World& world,
                                                    const std::vector<b2DistanceJoint*>& tethers);

}  // namespace seam
