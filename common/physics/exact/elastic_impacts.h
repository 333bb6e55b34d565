#pragma once
/// Perfectly elastic impacts (restitution 1) between bodies without joints. They are solved one
/// pair after the other, the fastest first, before the engine solves its step. The engine solves
/// all impacts of a step at once in a few rounds, which loses or gains energy where three bodies
/// meet, and makes impacts below 1 m/s inelastic.

#include <cstddef>
#include <vector>

#include "common/physics/world_build.h"

namespace seam {

/// True if a part of the scene is perfectly elastic; else this class is not needed.
bool HasElastic(const Scene& scene);

class ElasticImpacts {
 public:
  /// Looks for a shape of restitution 1. `jointed`: by moving body, true if a joint holds it.
  ElasticImpacts(const BuiltScene& built, std::vector<char> jointed);

  /// True if a body without joints, or something anchored, is elastic; else Act has nothing to do.
  bool needed() const { return needed_; }

  /// Solves the impacts between the narrow phase and the engine's solver, for a step of h s.
  /// `behind_s`: the pull of so many seconds is missing in the speeds that belong to the places: h
  /// / 2 where a step moves bodies by their speeds at its end, 0 where it moves them by the mean.
  /// Changes velocities, wakes the bodies that were hit, and reports the impulses to the world's
  /// listener (PostSolve). Ignores disabled contacts.
  void Act(b2World* world, float h, float behind_s);
  /// Called after the step: enables the contacts that Act has disabled for it.
  void Done();

 private:
  struct Body {
    b2Body* body = nullptr;
    double im = 0, ii = 0;          // 1/kg, 1/(kg m2); 0: immovable
    double vx = 0, vy = 0, w = 0;   // m/s, rad/s, at the place
    double kick_x = 0, kick_y = 0;  // m/s: what they lack of it, by gravity and forces
    bool struck = false;
  };
  struct Point {
    double ax = 0, ay = 0, bx = 0, by = 0;  // m, arms
    double pushed = 0, rubbed = 0;          // N s, of all impacts of the step
  };
  struct Touch {
    b2Contact* made = nullptr;
    int a = 0, b = 0;  // indices into bodies_
    int points = 0;
    Point point[b2_maxManifoldPoints];
    double nx = 0, ny = 0;
    double threshold = 0;  // m/s
    double closing = 0;    // m/s, of the fastest approaching point
    bool parts = false;    // disabled during the engine's step, as its bodies separate
  };

  bool Free(b2Body* body) const;
  int Place(const b2World& world, float behind_s, b2Body* body);
  void Find(b2World* world, float h, float behind_s);
  Body& At(int body) { return bodies_[static_cast<std::size_t>(body)]; }
  void Speeds(const Touch& touch, const Point& point, double* normal, double* tangent);
  void Look(Touch* touch);
  void Push(const Touch& touch, const Point& point, double normal, double tangent);
  void Blow(Touch* touch);
  double Solve(const Touch& touch, double share, double* pushed, double* rubbed);
  void Tell(b2World* world);

  bool needed_ = false;
  std::vector<char> jointed_;
  std::vector<int> place_;  // by moving body: index into bodies_, -1: not yet
  std::vector<Body> bodies_;
  std::vector<Touch> touches_;
};

}  // namespace seam
