/// SoftContacts: the rounds over all blocks.

#include "common/physics/contacts/soft_solve.h"

namespace seam {
namespace {

/// m/s: at most so fast is an overlap undone.
constexpr float kOutMost = 3;
/// Points of a pair that are so nearly one count as one: their determinant, as a share.
constexpr float kSingular = 1e-3f;

/// Returns `yes` where a > b, else `no`.
SEAM_WIDE Wide Pick(Wide a, Wide b, Wide yes, Wide no) { return a > b ? yes : no; }

}  // namespace

/// A block in work: velocities of its contacts' bodies, and of B's relative to A's along the normal
/// and the surface.
struct SoftContacts::Rounds {
  Block& block;
  std::vector<SoftBody>& bodies;
  WideRows a, b;  // vx, vy, w, dx
  Wide along_n, along_t;
  Wide push = All(0), rub = All(0);  // N s, given so far

  SEAM_WIDE Rounds(Block* of, std::vector<SoftBody>* list)
      : block(*of),
        bodies(*list),
        a(bodies, block.a, &SoftBody::vx),
        b(bodies, block.b, &SoftBody::vx) {
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
  SEAM_WIDE void Push(const Points& p, Wide more) {
    push += more;
    along_n += (block.im_a + block.im_b) * more;
    a.row[2] -= block.ii_a * more * p.lever_an;
    b.row[2] += block.ii_b * more * p.lever_bn;
  }
  SEAM_WIDE void PushTo(Wide to, Points* p) {
    const Wide whole = More(to, All(0)), more = whole - p->pushed;
    p->pushed = whole;
    Push(*p, more);
  }
  SEAM_WIDE void Rub(const Points& p, Wide more) {
    rub += more;
    along_t += (block.im_a + block.im_b) * more;
    a.row[2] -= block.ii_a * more * p.lever_at;
    b.row[2] += block.ii_b * more * p.lever_bt;
  }
  /// Friction comes after the normal impulse, which bounds it: else it lags behind a growing load.
  SEAM_WIDE void RubAll() {
    for (int i = 0; i < block.count; ++i) {
      Points& p = block.point[i];
      const Wide most = block.friction * p.pushed;
      const Wide free = p.rubbed - p.mass_t * (SpeedT(p) - block.belt);
      const Wide to = More(-most, Less(free, most)), more = to - p.rubbed;
      p.rubbed = to;
      Rub(p, more);
    }
  }
  SEAM_WIDE void Write() {
    const Wide x = push * block.nx + rub * block.ny, y = push * block.ny - rub * block.nx;
    a.row[0] -= block.im_a * x;
    a.row[1] -= block.im_a * y;
    b.row[0] += block.im_b * x;
    b.row[1] += block.im_b * y;
    a.Write(block.a, &SoftBody::vx, &bodies);
    b.Write(block.b, &SoftBody::vx, &bodies);
  }

  /// Sets the response of points at these separations: a free one may come by its separation.
  SEAM_WIDE static void Bias(Wide apart, float rate, const Block& block, Points* p) {
    const Wide none = All(0);
    const Wide out = More(block.bias_rate * apart, All(-kOutMost));
    p->bias = Pick(apart, none, apart * All(rate), out);
    p->soft_mass = Pick(apart, none, p->mass_n, p->mass_n * block.mass_scale);
    p->lasting = Pick(apart, none, All(1), All(1) - block.impulse_scale);
  }
  /// Computes the points' masses, and their first bias.
  SEAM_WIDE static void Prepare(float rate, Block* of) {
    const Block& block = *of;
    const Wide none = All(0), mass = block.im_a + block.im_b;
    for (int i = 0; i < block.count; ++i) {
      Points& p = of->point[i];
      const Wide n =
          mass + block.ii_a * p.lever_an * p.lever_an + block.ii_b * p.lever_bn * p.lever_bn;
      const Wide t =
          mass + block.ii_a * p.lever_at * p.lever_at + block.ii_b * p.lever_bt * p.lever_bt;
      p.mass_n = Pick(n, none, p.used / n, none);
      p.mass_t = Pick(t, none, p.used / t, none);
      Bias(p.apart + (p.turn_bn - p.turn_an), rate, block, &p);
    }
  }
  /// Begins a substep with `share` of the last one's impulses.
  SEAM_WIDE void WarmStart(float share) {
    for (int i = 0; i < block.count; ++i) {
      Points& p = block.point[i];
      p.pushed *= All(share);
      p.rubbed *= All(share);
      Push(p, p.pushed);
      Rub(p, p.rubbed);
    }
    Write();
  }
  /// Notes how fast points come that have not been pushed yet, for restitution.
  SEAM_WIDE void Watch() {
    for (int i = 0; i < block.count; ++i) {
      Points& p = block.point[i];
      p.closing = Pick(p.sum_n, All(0), p.closing, SpeedN(p));
    }
  }
  /// Solves the contacts once, and pushes out what overlaps.
  SEAM_WIDE void Solve() {
    for (int i = 0; i < block.count; ++i) {
      Points& p = block.point[i];
      PushTo(p.lasting * p.pushed - p.soft_mass * (SpeedN(p) + p.bias), &p);
    }
    RubAll();
    Write();
  }
  /// Solves the contacts once, without pushing out, and sets the next substep's bias.
  SEAM_WIDE void Relax(float rate) {
    const WideRows at_a(bodies, block.a, &SoftBody::dy);
    const WideRows at_b(bodies, block.b, &SoftBody::dy);
    const Wide way = (b.row[3] - a.row[3]) * block.nx + (at_b.row[0] - at_a.row[0]) * block.ny;
    for (int i = 0; i < block.count; ++i) {
      Points& p = block.point[i];
      const Wide turned_a = at_a.row[1] * p.turn_an + at_a.row[2] * p.turn_ac;
      const Wide turned_b = at_b.row[1] * p.turn_bn + at_b.row[2] * p.turn_bc;
      const Wide apart = p.apart + way + (turned_b - turned_a);
      Bias(apart, rate, block, &p);
      PushTo(p.pushed - p.mass_n * (SpeedN(p) + More(apart, All(0)) * All(rate)), &p);
    }
    RubAll();
    Write();
  }
  /// Gives points that were pushed their restitution. Both points of a pair get the speeds that
  /// they shall have: one after the other, the second would change the first one's.
  SEAM_WIDE void Restore() {
    const Wide none = All(0);
    Wide wanted[b2_maxManifoldPoints], returns[b2_maxManifoldPoints];
    for (int i = 0; i < block.count; ++i) {
      const Points& p = block.point[i];
      returns[i] = Pick(block.restitution, none, All(1), none);
      returns[i] = Pick(p.sum_n, none, returns[i], none);
      returns[i] = Pick(-block.threshold, p.closing, returns[i], none);
      wanted[i] = -returns[i] * (SpeedN(p) + block.restitution * p.closing);
    }
    const auto alone = [&](int i) {
      const Points& p = block.point[i];
      const Wide lacks = -returns[i] * (SpeedN(p) + block.restitution * p.closing);
      return More(p.mass_n * lacks, -p.pushed);
    };
    if (block.count == 2) {
      const Points &p = block.point[0], &q = block.point[1];
      const Wide both = block.im_a + block.im_b + block.ii_a * p.lever_an * q.lever_an +
                        block.ii_b * p.lever_bn * q.lever_bn;
      const Wide rest = All(1) - both * both * p.mass_n * q.mass_n;
      const Wide safe = More(rest, All(kSingular));
      const Wide x = p.mass_n * (wanted[0] - both * q.mass_n * wanted[1]) / safe;
      const Wide y = q.mass_n * (wanted[1] - both * p.mass_n * wanted[0]) / safe;
      Wide pair = returns[0] * returns[1] * q.used;
      pair = Pick(rest, All(kSingular), pair, none);
      pair = Pick(-p.pushed, x, none, pair);
      pair = Pick(-q.pushed, y, none, pair);
      Return(Pick(pair, none, x, alone(0)), &block.point[0]);
      Return(Pick(pair, none, y, alone(1)), &block.point[1]);
    } else if (block.count == 1) {
      Return(alone(0), &block.point[0]);
    }
    Write();
  }
  SEAM_WIDE void Return(Wide more, Points* p) {
    p->pushed += more;
    p->sum_n += more;
    Push(*p, more);
  }
};

void SoftContacts::Do(Work work, float number, std::size_t from) {
  using Now = Rounds;
  const std::size_t end = blocks_.size();
  switch (work) {
    case Work::kPrepare:
      for (std::size_t i = from; i < end; ++i) Now::Prepare(number, &blocks_[i]);
      break;
    case Work::kWarmStart:
      for (std::size_t i = from; i < end; ++i) Now(&blocks_[i], &bodies).WarmStart(number);
      break;
    case Work::kWatch:
      for (std::size_t i = from; i < end; ++i) {
        if (blocks_[i].returns) Now(&blocks_[i], &bodies).Watch();
      }
      break;
    case Work::kPush:  // from the last to the first, so that both ends of a pile are heard
      for (std::size_t i = end; i-- > from;) Now(&blocks_[i], &bodies).Solve();
      break;
    case Work::kRelax:
      for (std::size_t i = from; i < end; ++i) Now(&blocks_[i], &bodies).Relax(number);
      break;
    case Work::kRestore:
      for (std::size_t i = from; i < end; ++i) {
        if (blocks_[i].returns) Now(&blocks_[i], &bodies).Restore();
      }
      break;
  }
}

/// Adds the substep's impulses to those of the step.
void SoftContacts::Sum() {
  for (Block& block : blocks_) {
    for (int i = 0; i < block.count; ++i) {
      block.point[i].sum_n += block.point[i].pushed;
      block.point[i].sum_t += block.point[i].rubbed;
    }
  }
}

}  // namespace seam
