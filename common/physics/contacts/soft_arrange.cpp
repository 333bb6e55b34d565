/// SoftContacts: puts contacts into blocks of four, and takes their impulses back.

#include <algorithm>

#include "common/physics/contacts/soft_solve.h"

namespace seam {
namespace {

/// Hz and 1: stiffness and damping ratio of a contact. A contact with something fixed is twice as
/// stiff (Catto, "Solver2D", 2024).
constexpr float kContactHz = 60, kContactDamping = 10, kFixedStiffer = 2;
/// Share of a substep's rate that the stiffness may have at most.
constexpr float kRateShare = 0.25f;

Softness SoftnessOf(float hz, float h) {
  const float omega = 2 * b2_pi * hz;
  const float a1 = 2 * kContactDamping + h * omega;
  const float a2 = h * omega * a1;
  const float a3 = 1 / (1 + a2);
  return {omega / a1, a2 * a3, a3};
}

}  // namespace

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
    const float nx = contact.nx, ny = contact.ny;
    to.lever_an[lane] = from.ax * ny - from.ay * nx;
    to.lever_bn[lane] = from.bx * ny - from.by * nx;
    to.lever_at[lane] = -from.ax * nx - from.ay * ny;
    to.lever_bt[lane] = -from.bx * nx - from.by * ny;
    to.turn_an[lane] = from.turn_ax * nx + from.turn_ay * ny;
    to.turn_ac[lane] = from.turn_ax * ny - from.turn_ay * nx;
    to.turn_bn[lane] = from.turn_bx * nx + from.turn_by * ny;
    to.turn_bc[lane] = from.turn_bx * ny - from.turn_by * nx;
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
    if (small) small_from_ = static_cast<std::size_t>(lanes / kBlockLanes);
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
      const int blocks = (first + kBlockLanes - 1) / kBlockLanes;
      first = lanes;
      lanes += blocks * kBlockLanes;
    }
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      if (contacts[i].small == small) lane_[i] = first_[static_cast<std::size_t>(lane_[i])]++;
    }
  }
  Block empty{};
  for (int i = 0; i < kBlockLanes; ++i) empty.a[i] = empty.b[i] = static_cast<int>(moving);
  blocks_.assign(static_cast<std::size_t>(lanes / kBlockLanes), empty);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    Put(contacts[i], lane_[i] % kBlockLanes,
        &blocks_[static_cast<std::size_t>(lane_[i] / kBlockLanes)]);
  }
}

/// Returns the impulses to the list of contacts.
void SoftContacts::Take() {
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const Block& block = blocks_[static_cast<std::size_t>(lane_[k] / kBlockLanes)];
    const int lane = lane_[k] % kBlockLanes;
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

}  // namespace seam
