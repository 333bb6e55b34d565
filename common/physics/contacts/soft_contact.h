#pragma once
/// Bodies and contacts of islands that are solved by soft contacts in substeps, as plain numbers in
/// single precision, and how a contact is read from the engine.

#include <box2d/box2d.h>

#include <vector>

namespace seam {

struct alignas(16) SoftBody {
  // The first four are read and written together, and so are the next four read.
  float vx = 0, vy = 0, w = 0;     // m/s, rad/s
  float dx = 0, dy = 0;            // m: moved in this step
  float c = 1, s = 0;              // cosine and sine of da
  float da = 0;                    // rad: turned in this step
  float im = 0, ii = 0;            // 1/kg, 1/(kg m2); 0: does not move or turn by impulses
  float ax = 0, ay = 0, turn = 0;  // m/s2, rad/s2: gravity and forces
  float slow = 0, slow_spin = 0;   // 1/s, damping
  float from_vx = 0, from_vy = 0, from_w = 0;  // m/s, rad/s, at the beginning of the step
};

/// A contact with one or two points; its normal and its arms stay as they are during a step.
struct SoftContact {
  struct Point {
    float ax = 0, ay = 0, bx = 0, by = 0;  // m, arms
    /// m: the parts of the arms that turn with the bodies. The surface of a circle does not.
    float turn_ax = 0, turn_ay = 0, turn_bx = 0, turn_by = 0;
    float apart = 0;               // m, at the beginning, without the turning arms' share
    float mass_n = 0, mass_t = 0;  // kg, along the normal and the surface
    float pushed = 0, rubbed = 0;  // N s, of a whole step
    float sum_n = 0, sum_t = 0;    // N s, of all substeps
  };
  b2Contact* made = nullptr;
  int a = 0, b = 0;    // indices into the list of bodies
  int count = 0;       // of points
  bool small = false;  // its island has few points
  float nx = 0, ny = 0;
  float friction = 0, restitution = 0, threshold = 0, belt = 0;
  Point point[b2_maxManifoldPoints];
};

/// Reads arms, separation and masses of a contact from the engine. `a` and `b`, its indices, must
/// be set.
void ReadSoftContact(const std::vector<SoftBody>& bodies, SoftContact* contact);

}  // namespace seam
