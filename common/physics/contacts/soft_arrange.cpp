/// SoftContacts: gives contacts their lanes.

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

/// Puts contacts into layers: each into the first after all earlier ones that share a moving body
/// with it. So a round over the layers gives what a round over the list gives, and the contacts of
/// a layer do not touch each other's bodies.
void SoftContacts::Arrange(float h) {
  const float hz = std::min(kContactHz, kRateShare / h);
  soft_ = SoftnessOf(hz, h);
  stiff_ = SoftnessOf(kFixedStiffer * hz, h);
  layer_.assign(moving, 0);
  int lanes = 0;
  for (const bool small : {false, true}) {
    if (small) small_from_ = static_cast<std::size_t>(lanes / kBlockLanes);
    first_.clear();
    for (SoftContact& contact : contacts) {
      if (contact.small != small) continue;
      const auto a = static_cast<std::size_t>(contact.a), b = static_cast<std::size_t>(contact.b);
      const int layer = std::max(a < moving ? layer_[a] : 0, b < moving ? layer_[b] : 0);
      if (a < moving) layer_[a] = layer + 1;
      if (b < moving) layer_[b] = layer + 1;
      contact.lane = layer;
      if (first_.size() <= static_cast<std::size_t>(layer)) first_.push_back(0);
      ++first_[static_cast<std::size_t>(layer)];
    }
    for (int& first : first_) {
      const int blocks = (first + kBlockLanes - 1) / kBlockLanes;
      first = lanes;
      lanes += blocks * kBlockLanes;
    }
    for (SoftContact& contact : contacts) {
      if (contact.small == small) contact.lane = first_[static_cast<std::size_t>(contact.lane)]++;
    }
  }
  Block empty{};
  for (int i = 0; i < kBlockLanes; ++i) empty.a[i] = empty.b[i] = static_cast<int>(moving);
  blocks_.assign(static_cast<std::size_t>(lanes / kBlockLanes), empty);
  returns_ = false;
  for (const SoftContact& contact : contacts) Put(contact);
}

}  // namespace seam
