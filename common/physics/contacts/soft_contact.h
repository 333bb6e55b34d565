#pragma once
/// Bodies and contacts of islands that are solved by soft contacts in substeps.

#include <box2d/box2d.h>

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

struct SoftContact {
  b2Contact* made = nullptr;
  int a = 0, b = 0;    // indices into the list of bodies
  int lane = 0;        // its place among the lanes of all blocks
  bool small = false;  // its island has few points
};

}  // namespace seam
