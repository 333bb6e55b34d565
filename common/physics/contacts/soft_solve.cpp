#include "common/physics/contacts/soft_solve.h"

#include <cmath>

namespace seam {
namespace {

/// Further rounds in small islands, for each round in all: there they cost little.
constexpr int kMoreInSmall = 2;
/// Square of the change of speed, as a multiple of that by gravity and forces alone, up to which a
/// body's motion in a step is smooth.
constexpr float kSmoothMost = 4;

}  // namespace

/// `times`: half a substep's kick, or two of them.
void SoftContacts::Kick(float h, int times) {
  for (SoftBody& q : bodies) {
    const float keep = 1 / (1 + h * q.slow), keep_spin = 1 / (1 + h * q.slow_spin);
    for (int k = 0; k < times; ++k) {
      q.vx = (q.vx + h * q.ax) * keep;
      q.vy = (q.vy + h * q.ay) * keep;
      q.w = (q.w + h * q.turn) * keep_spin;
    }
  }
}

void SoftContacts::Drift(float h) {
  for (SoftBody& q : bodies) {
    q.dx += h * q.vx;
    q.dy += h * q.vy;
    const float turn = h * q.w;
    q.da += turn;
    const float c = q.c - turn * q.s, s = q.s + turn * q.c;
    const float length = std::sqrt(c * c + s * s);
    q.c = c / length;
    q.s = s / length;
  }
}

/// Moves bodies back by half a substep's way of what they have gained in speed in the step of
/// `step_s`: their substeps' ways were those of the speeds at the ends of substeps, not of the mean
/// ones. A body that has gained more than forces explain had an impact, and stays.
void SoftContacts::Centre(float h, float step_s) {
  for (SoftBody& q : bodies) {
    const float x = q.vx - q.from_vx, y = q.vy - q.from_vy;
    const float most = kSmoothMost * step_s * step_s * (q.ax * q.ax + q.ay * q.ay);
    if (x * x + y * y > most) continue;
    q.dx -= h / 2 * x;
    q.dy -= h / 2 * y;
    q.da -= h / 2 * (q.w - q.from_w);
  }
}

void SoftContacts::Step(float h, int substeps, int sweeps, bool warm) {
  Arrange(h);
  const auto parts = parts_ = static_cast<float>(substeps);
  for (SoftBody& q : bodies) {
    q.from_vx = q.vx;
    q.from_vy = q.vy;
    q.from_w = q.w;
  }
  Do(Work::kPrepare, 1 / h, 0);
  for (int i = 0; i < substeps; ++i) {
    if (returns_) {
      Kick(h / 2, 1);
      Do(Work::kWatch, 0, 0);
    }
    Kick(h / 2, returns_ ? 1 : 2);
    Do(Work::kWarmStart, i > 0 ? 1 : warm ? 1 / parts : 0, 0);
    for (int sweep = 0; sweep < sweeps; ++sweep) Do(Work::kPush, 0, 0);
    for (int sweep = 0; sweep < kMoreInSmall * sweeps; ++sweep) Do(Work::kPush, 0, small_from_);
    Drift(h);
    Do(Work::kRelax, 1 / h, 0);
    for (int sweep = 0; sweep < kMoreInSmall; ++sweep) Do(Work::kRelax, 1 / h, small_from_);
    Sum();
  }
  Centre(h, parts * h);
  Do(Work::kRestore, 0, 0);
}

}  // namespace seam
