#include "common/physics/contacts/soft_solve.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace seam {
namespace {

/// m/s: at most so fast is an overlap undone.
constexpr float kOutMost = 3;
/// Further rounds in small islands, for each round in all: there they cost little.
constexpr int kMoreInSmall = 2;
/// Square of the change of speed, as a multiple of that by gravity and forces alone, up to which a
/// body's motion in a step is smooth.
constexpr float kSmoothMost = 4;

}  // namespace

/// Velocities of the bodies of a block's contacts, and of B's relative to A's along the normal and
/// the surface.
struct SoftContacts::Ends {
  WideRows a, b;  // vx, vy, w, dx
  Wide along_n, along_t;
  Wide push = All(0), rub = All(0);  // N s, given so far

  SEAM_WIDE Ends(const std::vector<SoftBody>& bodies, const Block& block)
      : a(bodies, block.a, &SoftBody::vx), b(bodies, block.b, &SoftBody::vx) {
    const Wide x = b.row[0] - a.row[0], y = b.row[1] - a.row[1];
    along_n = x * block.nx + y * block.ny;
    along_t = x * block.ny - y * block.nx;
  }
  SEAM_WIDE Wide SpeedN(const Points& p) const {
    return along_n + (b.row[2] * p.lever_bn - a.row[2] * p.lever_an);
  }
  SEAM_WIDE Wide SpeedT(const Points& p) const {
    return along_t + (b.row[2] * p.lever_bt - a.row[2] * p.lever_at);
  }
  SEAM_WIDE void Push(const Block& block, const Points& p, const Wide& more) {
    push += more;
    along_n += (block.im_a + block.im_b) * more;
    a.row[2] -= block.ii_a * more * p.lever_an;
    b.row[2] += block.ii_b * more * p.lever_bn;
  }
  SEAM_WIDE void Rub(const Block& block, const Points& p, const Wide& more) {
    rub += more;
    along_t += (block.im_a + block.im_b) * more;
    a.row[2] -= block.ii_a * more * p.lever_at;
    b.row[2] += block.ii_b * more * p.lever_bt;
  }
  SEAM_WIDE void Write(const Block& block, std::vector<SoftBody>* bodies) {
    const Wide x = push * block.nx + rub * block.ny, y = push * block.ny - rub * block.nx;
    a.row[0] -= block.im_a * x;
    a.row[1] -= block.im_a * y;
    b.row[0] += block.im_b * x;
    b.row[1] += block.im_b * y;
    a.Write(block.a, &SoftBody::vx, bodies);
    b.Write(block.b, &SoftBody::vx, bodies);
  }
};

/// Computes the points' masses, and their first bias.
SEAM_WIDE_CLONES void SoftContacts::Prepare(float rate) {
  const Wide none = All(0);
  for (Block& block : blocks_) {
    for (int i = 0; i < block.count; ++i) {
      Points& p = block.point[i];
      const Wide mass = block.im_a + block.im_b;
      const Wide n =
          mass + block.ii_a * p.lever_an * p.lever_an + block.ii_b * p.lever_bn * p.lever_bn;
      const Wide t =
          mass + block.ii_a * p.lever_at * p.lever_at + block.ii_b * p.lever_bt * p.lever_bt;
      p.mass_n = n > none ? p.used / n : none;
      p.mass_t = t > none ? p.used / t : none;
      Bias(p.apart + (p.turn_bn - p.turn_an), rate, block, &p);
    }
  }
}

void SoftContacts::Kick(float h) {
  for (std::size_t i = 0; i < moving; ++i) {
    SoftBody& q = bodies[i];
    q.vx = (q.vx + h * q.ax) / (1 + h * q.slow);
    q.vy = (q.vy + h * q.ay) / (1 + h * q.slow);
    q.w = (q.w + h * q.turn) / (1 + h * q.slow_spin);
  }
}

/// Begins a substep with `share` of the last one's impulses.
SEAM_WIDE_CLONES void SoftContacts::WarmStart(float share) {
  const Wide scale = All(share);
  for (Block& block : blocks_) {
    Ends e(bodies, block);
    for (int i = 0; i < block.count; ++i) {
      Points& p = block.point[i];
      p.pushed *= scale;
      p.rubbed *= scale;
      e.Push(block, p, p.pushed);
      e.Rub(block, p, p.rubbed);
    }
    e.Write(block, &bodies);
  }
}

/// Notes how fast points come that have not been pushed yet, for restitution.
void SoftContacts::Watch() {
  const Wide none = All(0);
  for (Block& block : blocks_) {
    if (!block.returns) continue;
    const Ends e(bodies, block);
    for (int i = 0; i < block.count; ++i) {
      Points& p = block.point[i];
      p.closing = p.sum_n <= none ? e.SpeedN(p) : p.closing;
    }
  }
}

/// Sets the response of points at these separations: a free one may come by its separation.
SEAM_WIDE void SoftContacts::Bias(const Wide& apart, float rate, const Block& block, Points* p) {
  const Wide none = All(0), one = All(1);
  p->bias = apart > none ? apart * All(rate) : More(block.bias_rate * apart, All(-kOutMost));
  p->soft_mass = apart > none ? p->mass_n : p->mass_n * block.mass_scale;
  p->lasting = apart > none ? one : one - block.impulse_scale;
}

SEAM_WIDE void SoftContacts::Rub(Block* block, Ends* e) {
  for (int i = 0; i < block->count; ++i) {
    Points& p = block->point[i];
    const Wide most = block->friction * p.pushed;
    const Wide to = More(-most, Less(p.rubbed - p.mass_t * (e->SpeedT(p) - block->belt), most));
    const Wide more = to - p.rubbed;
    p.rubbed = to;
    e->Rub(*block, p, more);
  }
}

/// Solves a block's contacts once, and pushes out what overlaps. Friction comes after the normal
/// impulse, which bounds it: else it lags behind a growing load.
SEAM_WIDE void SoftContacts::Push(Block* block) {
  Ends e(bodies, *block);
  for (int i = 0; i < block->count; ++i) {
    Points& p = block->point[i];
    const Wide to = More(p.lasting * p.pushed - p.soft_mass * (e.SpeedN(p) + p.bias), All(0));
    const Wide more = to - p.pushed;
    p.pushed = to;
    e.Push(*block, p, more);
  }
  Rub(block, &e);
  e.Write(*block, &bodies);
}

/// Solves a block's contacts once, without pushing out, and sets the next substep's bias.
SEAM_WIDE void SoftContacts::Relax(float rate, Block* block) {
  const Wide none = All(0);
  const WideRows a(bodies, block->a, &SoftBody::dy), b(bodies, block->b, &SoftBody::dy);
  Ends e(bodies, *block);
  const Wide &ac = a.row[1], &as = a.row[2], &bc = b.row[1], &bs = b.row[2];
  const Wide nearer = (e.b.row[3] - e.a.row[3]) * block->nx + (b.row[0] - a.row[0]) * block->ny;
  for (int i = 0; i < block->count; ++i) {
    Points& p = block->point[i];
    const Wide apart =
        p.apart + nearer + ((bc * p.turn_bn + bs * p.turn_bc) - (ac * p.turn_an + as * p.turn_ac));
    Bias(apart, rate, *block, &p);
    const Wide to = More(p.pushed - p.mass_n * (e.SpeedN(p) + More(apart, none) * All(rate)), none);
    const Wide more = to - p.pushed;
    p.pushed = to;
    e.Push(*block, p, more);
  }
  Rub(block, &e);
  e.Write(*block, &bodies);
}

/// Solves each contact once. With bias from the last to the first, so that both ends of a pile are
/// heard in a substep.
SEAM_WIDE_CLONES void SoftContacts::PushAll(std::size_t from) {
  for (std::size_t i = blocks_.size(); i-- > from;) Push(&blocks_[i]);
}

SEAM_WIDE_CLONES void SoftContacts::RelaxAll(float rate, std::size_t from) {
  for (std::size_t i = from; i < blocks_.size(); ++i) Relax(rate, &blocks_[i]);
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
  for (std::size_t i = 0; i < moving; ++i) {
    SoftBody& q = bodies[i];
    const float x = q.vx - q.from_vx, y = q.vy - q.from_vy;
    const float most = kSmoothMost * step_s * step_s * (q.ax * q.ax + q.ay * q.ay);
    if (x * x + y * y > most) continue;
    q.dx -= h / 2 * x;
    q.dy -= h / 2 * y;
    q.da -= h / 2 * (q.w - q.from_w);
  }
}

void SoftContacts::Sum() {
  for (Block& block : blocks_) {
    for (int i = 0; i < block.count; ++i) {
      block.point[i].sum_n += block.point[i].pushed;
      block.point[i].sum_t += block.point[i].rubbed;
    }
  }
}

/// Gives points that were pushed their restitution, once.
void SoftContacts::Restore() {
  const Wide none = All(0);
  for (Block& block : blocks_) {
    if (!block.returns) continue;
    Ends e(bodies, block);
    for (int i = 0; i < block.count; ++i) {
      Points& p = block.point[i];
      Wide to = More(p.pushed - p.mass_n * (e.SpeedN(p) + block.restitution * p.closing), none);
      to = p.closing > -block.threshold ? p.pushed : to;
      to = p.sum_n <= none || block.restitution <= none ? p.pushed : to;
      const Wide more = to - p.pushed;
      p.pushed = to;
      p.sum_n += more;
      e.Push(block, p, more);
    }
    e.Write(block, &bodies);
  }
}

void SoftContacts::Step(float h, int substeps, int sweeps, bool warm) {
  Arrange(h);
  const auto parts = static_cast<float>(substeps);
  for (SoftBody& q : bodies) {
    q.from_vx = q.vx;
    q.from_vy = q.vy;
    q.from_w = q.w;
  }
  Prepare(1 / h);
  for (int i = 0; i < substeps; ++i) {
    Kick(h / 2);
    Watch();
    Kick(h / 2);
    WarmStart(i > 0 ? 1 : warm ? 1 / parts : 0);
    for (int sweep = 0; sweep < sweeps; ++sweep) PushAll(0);
    for (int sweep = 0; sweep < kMoreInSmall * sweeps; ++sweep) PushAll(small_from_);
    Drift(h);
    RelaxAll(1 / h, 0);
    for (int sweep = 0; sweep < kMoreInSmall; ++sweep) RelaxAll(1 / h, small_from_);
    Sum();
  }
  Centre(h, parts * h);
  Restore();
  for (Block& block : blocks_) {
    for (int i = 0; i < block.count; ++i) {
      block.point[i].pushed *= All(parts);
      block.point[i].rubbed *= All(parts);
    }
  }
}

}  // namespace seam
