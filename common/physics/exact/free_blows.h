#pragma once
/// Blows that give everything back (restitution 1), between bodies that no joint holds: one pair
/// after the other, the fastest first, before the engine solves its step. The engine solves all
/// blows of a step at once in a few rounds, which loses energy where three bodies meet, or gains
/// some, and lets what comes slower than 1 m/s stick.

#include <cstddef>
#include <vector>

#include "common/physics/world_build.h"

namespace seam {

/// Whether a part of the scene gives everything back: where none does, nothing here is needed.
bool GivesAll(const Scene& scene);

class FreeBlows {
 public:
  /// Looks for a shape of restitution 1. `jointed`: by moving body, whether a joint holds it.
  FreeBlows(const BuiltScene& built, std::vector<char> jointed);

  /// Whether anything gives everything back; else Act has nothing to do.
  bool needed() const { return needed_; }

  /// Between the narrow phase and the engine's solver, for a step of h s. Changes velocities, wakes
  /// what was hit, and tells the world's listener the impulses (PostSolve). Contacts that are
  /// disabled are let alone.
  void Act(b2World* world, float h);
  /// After the step: contacts that Act has left out of it are there again.
  void Done();

 private:
  struct Body {
    b2Body* body = nullptr;
    double im = 0, ii = 0;          // 1/kg, 1/(kg m2); 0: does not give way
    double vx = 0, vy = 0, w = 0;   // m/s, rad/s, in the middle of the step's kick
    double kick_x = 0, kick_y = 0;  // m/s: half of what gravity and forces give it
    bool struck = false;
  };
  struct Point {
    double ax = 0, ay = 0, bx = 0, by = 0;  // m, arms
    double pushed = 0, rubbed = 0;          // N s, in all blows of the step
  };
  struct Touch {
    b2Contact* made = nullptr;
    int a = 0, b = 0;  // of bodies_
    int points = 0;
    Point point[b2_maxManifoldPoints];
    double nx = 0, ny = 0;
    double threshold = 0;  // m/s
    double closing = 0;    // m/s, of the point that comes fastest
    bool parts = false;    // left out of the engine's step
  };

  bool Free(b2Body* body) const;
  int Place(const b2World& world, float h, b2Body* body);
  void Find(b2World* world, float h);
  Body& At(int body) { return bodies_[static_cast<std::size_t>(body)]; }
  void Speeds(const Touch& touch, const Point& point, double* normal, double* tangent);
  void Look(Touch* touch);
  void Push(const Touch& touch, const Point& point, double normal, double tangent);
  void Blow(Touch* touch);
  double Solve(const Touch& touch, double share, double* pushed, double* rubbed);
  void Tell(b2World* world);

  bool needed_ = false;
  std::vector<char> jointed_;
  std::vector<int> place_;  // by moving body: in bodies_, -1: not yet
  std::vector<Body> bodies_;
  std::vector<Touch> touches_;
};

}  // namespace seam
