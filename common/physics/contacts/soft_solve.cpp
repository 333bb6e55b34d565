#include "common/physics/contacts/soft_solve.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace seam {
namespace {

/// Hz and 1: stiffness and damping ratio of a contact. A contact with something fixed is twice as
/// stiff (Catto, "Solver2D", 2024).
constexpr float kContactHz = 60, kContactDamping = 10, kFixedStiffer = 2;
/// Share of a substep's rate that the stiffness may have at most.
constexpr float kRateShare = 0.25f;
/// m/s: at most so fast is an overlap undone.
constexpr float kPushOutMost = 3;
/// Further rounds in small islands, for each round in all: there they cost little.
constexpr int kMoreInSmall = 2;
/// Square of the change of speed, as a multiple of that by gravity and forces alone, up to which a
/// body's motion in a step is smooth.
constexpr float kSmoothMost = 4;
constexpr int kLanes = 4;

Softness SoftnessOf(float hz, float h) {
  const float omega = 2 * b2_pi * hz;
  const float a1 = 2 * kContactDamping + h * omega;
  const float a2 = h * omega * a1;
  const float a3 = 1 / (1 + a2);
  return {omega / a1, a2 * a3, a3};
}

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
  for (int i = 0; i < kLanes; ++i) {
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
  for (int i = 0; i < kLanes; ++i) {
    std::memcpy(&bodies[static_cast<std::size_t>(block.a[i])].vx, &a.row[i], sizeof(Four));
    std::memcpy(&bodies[static_cast<std::size_t>(block.b[i])].vx, &b.row[i], sizeof(Four));
  }
}

void SoftContacts::Put(const SoftContact& contact, int lane, Block* block) const {
  const SoftBody& a = bodies[static_cast<std::size_t>(contact.a)];
  const SoftBody& b = bodies[static_cast<std::size_t>(contact.b)];
  const Softness& soft = a.im > 0 && b.im > 0 ? soft_ : stiff_;
  block->a[lane] = contact.a;
  block->b[lane] = contact.b;
  block->count = std::max(block->count, contact.count);
  block->returns = block->returns || contact.restitution > 0;
  block->nx[lane] = contact.nx;
  block->ny[lane] = contact.ny;
  block->friction[lane] = contact.friction;
  block->restitution[lane] = contact.restitution;
  block->threshold[lane] = contact.threshold;
  block->belt[lane] = contact.belt;
  block->im_a[lane] = a.im;
  block->ii_a[lane] = a.ii;
  block->im_b[lane] = b.im;
  block->ii_b[lane] = b.ii;
  block->bias_rate[lane] = soft.bias_rate;
  block->mass_scale[lane] = soft.mass_scale;
  block->impulse_scale[lane] = soft.impulse_scale;
  for (int i = 0; i < contact.count; ++i) {
    const SoftContact::Point& from = contact.point[i];
    Points& to = block->point[i];
    to.ax[lane] = from.ax;
    to.ay[lane] = from.ay;
    to.bx[lane] = from.bx;
    to.by[lane] = from.by;
    to.turn_ax[lane] = from.turn_ax;
    to.turn_ay[lane] = from.turn_ay;
    to.turn_bx[lane] = from.turn_bx;
    to.turn_by[lane] = from.turn_by;
    to.apart[lane] = from.apart;
    to.mass_n[lane] = from.mass_n;
    to.mass_t[lane] = from.mass_t;
    to.pushed[lane] = from.pushed;
    to.rubbed[lane] = from.rubbed;
  }
}

/// Puts contacts into layers: each into the first after all earlier ones that share a moving body
/// with it. So a round over the layers gives what a round over the list gives, and the contacts of
/// a layer do not touch each other's bodies.
void SoftContacts::Arrange(float h) {
  const float hz = std::min(kContactHz, kRateShare / h);
  soft_ = SoftnessOf(hz, h);
  stiff_ = SoftnessOf(kFixedStiffer * hz, h);
  layer_.assign(moving, 0);
  lane_.resize(contacts.size());
  int lanes = 0;
  for (const bool small : {false, true}) {
    if (small) small_from_ = static_cast<std::size_t>(lanes / kLanes);
    first_.clear();
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      if (contacts[i].small != small) continue;
      const auto a = static_cast<std::size_t>(contacts[i].a);
      const auto b = static_cast<std::size_t>(contacts[i].b);
      const int layer = std::max(a < moving ? layer_[a] : 0, b < moving ? layer_[b] : 0);
      if (a < moving) layer_[a] = layer + 1;
      if (b < moving) layer_[b] = layer + 1;
      lane_[i] = layer;
      if (first_.size() <= static_cast<std::size_t>(layer)) first_.push_back(0);
      ++first_[static_cast<std::size_t>(layer)];
    }
    for (int& first : first_) {
      const int blocks = (first + kLanes - 1) / kLanes;
      first = lanes;
      lanes += blocks * kLanes;
    }
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      if (contacts[i].small == small) lane_[i] = first_[static_cast<std::size_t>(lane_[i])]++;
    }
  }
  Block empty{};
  for (int i = 0; i < kLanes; ++i) empty.a[i] = empty.b[i] = static_cast<int>(moving);
  blocks_.assign(static_cast<std::size_t>(lanes / kLanes), empty);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    Put(contacts[i], lane_[i] % kLanes, &blocks_[static_cast<std::size_t>(lane_[i] / kLanes)]);
  }
}

/// Returns the impulses to the list of contacts.
void SoftContacts::Take() {
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const Block& block = blocks_[static_cast<std::size_t>(lane_[k] / kLanes)];
    const int lane = lane_[k] % kLanes;
    for (int i = 0; i < contacts[k].count; ++i) {
      SoftContact::Point& to = contacts[k].point[i];
      const Points& from = block.point[i];
      to.pushed = from.pushed[lane];
      to.rubbed = from.rubbed[lane];
      to.sum_n = from.sum_n[lane];
      to.sum_t = from.sum_t[lane];
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
  const Four none = All(0), rate = All(1 / h), most_out = All(-kPushOutMost);
  Table a, b;
  for (int i = 0; i < kLanes; ++i) {
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
