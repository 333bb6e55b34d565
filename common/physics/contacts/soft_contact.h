#pragma once
/// Bodies and contacts of islands that are solved by soft contacts in substeps, as plain numbers in
/// single precision.

#include <box2d/box2d.h>

#include <cstddef>
#include <vector>

namespace seam {

struct SoftBody {
  float vx = 0, vy = 0, w = 0;    // m/s, rad/s
  float dx = 0, dy = 0, da = 0;   // m, rad: moved in this step
  float c = 1, s = 0;             // cosine and sine of da
  float im = 0, ii = 0;           // 1/kg, 1/(kg m2); 0: does not move or turn by impulses
  float ax = 0, ay = 0, turn = 0; // m/s2, rad/s2: gravity and forces
  float slow = 0, slow_spin = 0;  // 1/s, damping
};

/// A contact with one or two points; its normal and its arms stay as they are during a step.
struct SoftContact {
  struct Point {
    float ax = 0, ay = 0, bx = 0, by = 0;  // m, arms
    /// m: the parts of the arms that turn with the bodies. The surface of a circle does not.
    float turn_ax = 0, turn_ay = 0, turn_bx = 0, turn_by = 0;
    float apart = 0;                  // m, at the beginning, without the turning arms' share
    float mass_n = 0, mass_t = 0;     // kg, along the normal and the surface
    float pushed = 0, rubbed = 0;     // N s, in this substep
    float sum_n = 0, sum_t = 0;       // N s, of all substeps
    float closing = 0;                // m/s, before it was first pushed
  };
  b2Contact* made = nullptr;
  int a = 0, b = 0;  // indices into the list of bodies
  int count = 0;     // of points
  float nx = 0, ny = 0;
  float friction = 0, restitution = 0, threshold = 0, belt = 0;
  bool fixed = false;  // one of the bodies does not move
  Point point[b2_maxManifoldPoints];
};

/// Response of a soft constraint: a spring and damper, solved implicitly.
struct Softness {
  float bias_rate = 0, mass_scale = 1, impulse_scale = 0;
};

class SoftContacts {
 public:
  std::vector<SoftBody> bodies;  ///< moving bodies, then others
  std::size_t moving = 0;        ///< number of moving bodies
  std::vector<SoftContact> contacts;

  /// Advances the bodies by `substeps` substeps of h s, each with `sweeps` rounds over the contacts
  /// and one without bias. `warm`: begin with the contacts' impulses. These are those of a whole
  /// step, before and after.
  void Step(float h, int substeps, int sweeps, bool warm);

 private:
  void Kick(float h);
  void WarmStart(float share);
  void Watch();
  void Push(float h, bool biased);
  void Drift(float h);
  void Restore();

  Softness soft_, stiff_;
};

/// Reads arms, separation and masses of a contact from the engine. `a` and `b`, its indices, must
/// be set.
void ReadSoftContact(const std::vector<SoftBody>& bodies, SoftContact* contact);

}  // namespace seam
