/// ExactStep: finds the mechanisms, and decides which are always left to the engine and which may
/// be at any moment.

#include <algorithm>

#include "common/physics/engine_members.h"
#include "common/physics/exact/exact_step.h"

namespace seam {
namespace {

/// The engine solves a mechanism well at once with so few joints, or with a mass ratio this small
/// in its island. It tears apart light links with a heavy load, joined to them or pressing on them,
/// when it gets them in the middle of a swing.
constexpr std::size_t kJointsOfEasy = 4;
constexpr float kMassRatioOfEasy = 10;
/// A mechanism that alone costs more multiplications than this is too large with any contacts, even
/// if its bodies come in another order then.
constexpr long kNeverDirect = 120000;
/// A mechanism of fewer rows cannot cost that much.
constexpr int kRowsOfLarge = 85;

}  // namespace

void ExactStep::FindMechanisms() {
  std::vector<std::vector<int>> joined(slots_.size());  // joints, by slot
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    for (const int slot : {joints_[j].slot_a, joints_[j].slot_b}) {
      if (slot >= 0) joined[static_cast<std::size_t>(slot)].push_back(static_cast<int>(j));
    }
  }
  std::vector<char> taken(joints_.size(), 0);
  for (std::size_t first = 0; first < slots_.size(); ++first) {
    if (slots_[first].mechanism >= 0 || joined[first].empty()) continue;
    const int index = static_cast<int>(mechanisms_.size());
    mechanisms_.emplace_back();
    Mechanism& mechanism = mechanisms_.back();
    mechanism.slots.push_back(static_cast<int>(first));
    slots_[first].mechanism = index;
    for (std::size_t i = 0; i < mechanism.slots.size(); ++i) {
      for (const int j : joined[static_cast<std::size_t>(mechanism.slots[i])]) {
        const ExactJoint& joint = joints_[static_cast<std::size_t>(j)];
        if (!taken[static_cast<std::size_t>(j)]) mechanism.joints.push_back(j);
        taken[static_cast<std::size_t>(j)] = 1;
        for (const int slot : {joint.slot_a, joint.slot_b}) {
          if (slot < 0 || slots_[static_cast<std::size_t>(slot)].mechanism >= 0) continue;
          slots_[static_cast<std::size_t>(slot)].mechanism = index;
          mechanism.slots.push_back(slot);
        }
      }
    }
    std::sort(mechanism.joints.begin(), mechanism.joints.end());
    mechanism.lightest = LightestLink(mechanism);
  }
  found_.resize(mechanisms_.size());
}

float ExactStep::LightestLink(const Mechanism& mechanism) const {
  float least = b2_maxFloat;
  if (mechanism.joints.size() <= kJointsOfEasy) return least;
  for (const int slot : mechanism.slots) {
    b2Body* const body = slots_[static_cast<std::size_t>(slot)].body;
    if (Moves(body)) least = std::min(least, body->GetMass());
  }
  return least;
}

bool ExactStep::Easy(const Found& found) const {
  float least = b2_maxFloat, most = 0;
  for (const int m : found.mechanisms) {
    least = std::min(least, mechanisms_[static_cast<std::size_t>(m)].lightest);
  }
  for (const int slot : found.slots) {
    most = std::max(most, slots_[static_cast<std::size_t>(slot)].body->GetMass());
  }
  return most <= kMassRatioOfEasy * least;
}

/// Excludes mechanisms that are always too large, once and for all.
void ExactStep::LeaveLarge() {
  for (std::size_t m = 0; m < mechanisms_.size(); ++m) {
    Mechanism& mechanism = mechanisms_[m];
    int rows = 0;  // without limits: none is near yet
    for (const int j : mechanism.joints) rows += RowCount(joints_[static_cast<std::size_t>(j)]);
    if (!mechanism.exact || rows < kRowsOfLarge) continue;
    Found alone;
    alone.mechanisms.push_back(static_cast<int>(m));
    for (const int slot : mechanism.slots) {
      if (Moves(slots_[static_cast<std::size_t>(slot)].body)) alone.slots.push_back(slot);
    }
    mechanism.exact = alone.slots.empty() || Build(&alone, false) <= kNeverDirect;
  }
}

bool ExactStep::needed() const {
  return soft_ || blows_ ||
         std::any_of(mechanisms_.begin(), mechanisms_.end(),
                     [](const Mechanism& m) { return m.exact; });
}

}  // namespace seam
