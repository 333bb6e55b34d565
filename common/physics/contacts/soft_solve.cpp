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

Four All(float x) { return Four{x, x, x, x}; }
/// Exchanges rows and columns of four times four numbers.
struct Table {
  Four row[4];
  Table Turned() const {
    const Four a = __builtin_shufflevector(row[0], row[1], 0, 4, 1, 5);
    const Four b = __builtin_shufflevector(row[2], row[3], 0, 4, 1, 5);
    const Four c = __builtin_shufflevector(row[0], row[1], 2, 6, 3, 7);
    const Four d = __builtin_shufflevector(row[2], row[3], 2, 6, 3, 7);
    return {{__builtin_shufflevector(a, b, 0, 1, 4, 5), __builtin_shufflevector(a, b, 2, 3, 6, 7),
             __builtin_shufflevector(c, d, 0, 1, 4, 5), __builtin_shufflevector(c, d, 2, 3, 6, 7)}};
  }
};

Four Less(Four a, Four b) { return a < b ? a : b; }
Four More(Four a, Four b) { return a > b ? a : b; }

}  // namespace

/// The bodies of a block's contacts.
struct SoftContacts::Ends {
  Four avx, avy, aw, adx, bvx, bvy, bw, bdx;

  Four SpeedAlong(const Points& p, Four x, Four y) const {
    return (bvx - bw * p.by - avx + aw * p.ay) * x + (bvy + bw * p.bx - avy - aw * p.ax) * y;
  }
  void Apply(const Block& block, const Points& p, Four x, Four y) {
    avx -= block.im_a * x;
    avy -= block.im_a * y;
    aw -= block.ii_a * (p.ax * y - p.ay * x);
    bvx += block.im_b * x;
    bvy += block.im_b * y;
    bw += block.ii_b * (p.bx * y - p.by * x);
  }
};

inline SoftContacts::Ends SoftContacts::Gather(const Block& block) const {
  Table a, b;
  for (int i = 0; i < kBlockLanes; ++i) {
    std::memcpy(&a.row[i], &bodies[static_cast<std::size_t>(block.a[i])].vx, sizeof(Four));
    std::memcpy(&b.row[i], &bodies[static_cast<std::size_t>(block.b[i])].vx, sizeof(Four));
  }
  a = a.Turned();
  b = b.Turned();
  return {a.row[0], a.row[1], a.row[2], a.row[3], b.row[0], b.row[1], b.row[2], b.row[3]};
}

inline void SoftContacts::Scatter(const Block& block, const Ends& e) {
  const Table a = Table{{e.avx, e.avy, e.aw, e.adx}}.Turned();
  const Table b = Table{{e.bvx, e.bvy, e.bw, e.bdx}}.Turned();
  for (int i = 0; i < kBlockLanes; ++i) {
    std::memcpy(&bodies[static_cast<std::size_t>(block.a[i])].vx, &a.row[i], sizeof(Four));
    std::memcpy(&bodies[static_cast<std::size_t>(block.b[i])].vx, &b.row[i], sizeof(Four));
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
void SoftContacts::WarmStart(float share) {
  const Four scale = All(share);
  for (Block& block : blocks_) {
    Ends e = Gather(block);
    for (int i = 0; i < block.count; ++i) {
      Points& p = block.point[i];
      p.pushed *= scale;
      p.rubbed *= scale;
      e.Apply(block, p, p.pushed * block.nx + p.rubbed * block.ny,
              p.pushed * block.ny - p.rubbed * block.nx);
    }
    Scatter(block, e);
  }
}

/// Notes how fast points come that have not been pushed yet, for restitution.
void SoftContacts::Watch() {
  const Four none = All(0);
  for (Block& block : blocks_) {
    if (!block.returns) continue;
    const Ends e = Gather(block);
    for (int i = 0; i < block.count; ++i) {
      Points& p = block.point[i];
      p.closing = p.sum_n <= none ? e.SpeedAlong(p, block.nx, block.ny) : p.closing;
    }
  }
}

void SoftContacts::Push(float h, bool biased, Block* block) {
  const Four none = All(0), rate = All(1 / h), most_out = All(-kOutMost);
  Table a, b;
  for (int i = 0; i < kBlockLanes; ++i) {
    std::memcpy(&a.row[i], &bodies[static_cast<std::size_t>(block->a[i])].dy, sizeof(Four));
    std::memcpy(&b.row[i], &bodies[static_cast<std::size_t>(block->b[i])].dy, sizeof(Four));
  }
  a = a.Turned();
  b = b.Turned();
  Ends e = Gather(*block);
  const Four dx = e.bdx - e.adx, dy = b.row[0] - a.row[0];
  const Four ac = a.row[1], as = a.row[2], bc = b.row[1], bs = b.row[2];
  const Four nx = block->nx, ny = block->ny;
  for (int i = 0; i < block->count; ++i) {
    Points& p = block->point[i];
    const Four x = dx + (bc * p.turn_bx - bs * p.turn_by) - (ac * p.turn_ax - as * p.turn_ay);
    const Four y = dy + (bs * p.turn_bx + bc * p.turn_by) - (as * p.turn_ax + ac * p.turn_ay);
    const Four apart = p.apart + x * nx + y * ny;
    const Four speed = e.SpeedAlong(p, nx, ny);
    Four to;
    if (biased) {
      const Four ahead = p.pushed - p.mass_n * (speed + apart * rate);
      const Four out = More(block->bias_rate * apart, most_out);
      const Four soft =
          p.pushed - p.mass_n * block->mass_scale * (speed + out) - block->impulse_scale * p.pushed;
      to = apart > none ? ahead : soft;
    } else {
      to = p.pushed - p.mass_n * (speed + More(apart, none) * rate);
    }
    to = More(to, none);
    const Four more = to - p.pushed;
    p.pushed = to;
    e.Apply(*block, p, more * nx, more * ny);
  }
  // After the normal impulse, which bounds it: else friction lags behind a growing load.
  for (int i = 0; i < block->count; ++i) {
    Points& p = block->point[i];
    const Four most = block->friction * p.pushed;
    const Four speed = e.SpeedAlong(p, ny, -nx) - block->belt;
    const Four to = More(-most, Less(p.rubbed - p.mass_t * speed, most));
    const Four more = to - p.rubbed;
    p.rubbed = to;
    e.Apply(*block, p, more * ny, -more * nx);
  }
  Scatter(*block, e);
}

/// Solves each contact once. With bias from the last to the first, so that both ends of a pile are
/// heard in a substep.
void SoftContacts::PushAll(float h, bool biased, std::size_t from) {
  if (biased) {
    for (std::size_t i = blocks_.size(); i-- > from;) Push(h, true, &blocks_[i]);
  } else {
    for (std::size_t i = from; i < blocks_.size(); ++i) Push(h, false, &blocks_[i]);
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
  const Four none = All(0);
  for (Block& block : blocks_) {
    if (!block.returns) continue;
    Ends e = Gather(block);
    for (int i = 0; i < block.count; ++i) {
      Points& p = block.point[i];
      const Four speed = e.SpeedAlong(p, block.nx, block.ny);
      Four to = More(p.pushed - p.mass_n * (speed + block.restitution * p.closing), none);
      to = p.closing > -block.threshold ? p.pushed : to;
      to = p.sum_n <= none || block.restitution <= none ? p.pushed : to;
      const Four more = to - p.pushed;
      p.pushed = to;
      p.sum_n += more;
      e.Apply(block, p, more * block.nx, more * block.ny);
    }
    Scatter(block, e);
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
  for (int i = 0; i < substeps; ++i) {
    Kick(h / 2);
    Watch();
    Kick(h / 2);
    WarmStart(i > 0 ? 1 : warm ? 1 / parts : 0);
    for (int sweep = 0; sweep < sweeps; ++sweep) PushAll(h, true, 0);
    for (int sweep = 0; sweep < kMoreInSmall * sweeps; ++sweep) PushAll(h, true, small_from_);
    Drift(h);
    PushAll(h, false, 0);
    for (int sweep = 0; sweep < kMoreInSmall; ++sweep) PushAll(h, false, small_from_);
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
  Take();
}

}  // namespace seam
