#pragma once
/// Free flight of a body: gravity moves it, and it bounces off anchored shapes as in the engine, in
/// legs of up to a tenth of a second. Other bodies are ignored. Used for bodies that are displayed
/// and not simulated (dead reckoning). A leg costs about a query of the broad phase, and a shape
/// cast (van den Bergen, "Ray Casting against General Convex Objects", 2004) for each anchored
/// shape nearby.

#include <box2d/box2d.h>

#include <vector>

#include "common/scene/types.h"

namespace seam {

class Flight {
 public:
  /// Sets the body, its mass (about its origin) and the world, which is stepped by `step_s`. World
  /// and body must outlive the calls of After.
  void Begin(const b2World& world, const b2Body& body, const b2MassData& mass, float step_s);

  /// Returns the state `seconds` later. Velocities are of the centre of mass. Requires Begin.
  BodyState After(const BodyState& from, float seconds);

 private:
  struct Pose;
  struct Contact;
  struct Near {
    b2Fixture* fixture;
    int child;
  };
  void Leg(Pose* at, float seconds);
  void FindNear(const b2Transform& at, const b2Vec2& shift);
  b2Vec2 HeldBack(Pose* at, const b2Vec2& pull) const;
  bool FirstHit(const b2Transform& at, const b2Vec2& shift, Contact* hit) const;
  void Bounce(const Contact& contact, Pose* at) const;
  template <class Visit>
  void EachPair(const Visit& visit) const;
  b2Transform TransformOf(const Pose& pose) const;
  b2Vec2 ShiftOf(const Pose& pose, const b2Vec2& pull, float seconds) const;

  const b2World* world_ = nullptr;
  const b2Body* body_ = nullptr;
  b2Vec2 centre_{0, 0};  // centre of mass, m, from the body's origin
  float mass_ = 1, inertia_ = 0, step_s_ = 0;
  std::vector<Near> near_;  // anchored shapes near this leg
};

}  // namespace seam
