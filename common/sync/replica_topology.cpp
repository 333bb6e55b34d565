/// Replica: bodies that split and merge. What is known of a body (its past, what was heard of it,
/// its place in the view) is carried over to what it becomes.

#include <algorithm>

#include "common/physics/part_places.h"
#include "common/sync/edit_order.h"
#include "common/sync/replica.h"

namespace seam {
namespace {

/// A proposal that nothing came of is made again after this, s.
constexpr double kProposeAgain = 0.5;
/// Proposals that are remembered.
constexpr std::size_t kProposedMax = 4096;

/// values[i] of the body that body i comes from, or `fresh`.
template <typename T>
void Carry(const std::vector<BodyOrigin>& origins, const T& fresh, std::vector<T>* values) {
  std::vector<T> out;
  for (const BodyOrigin& origin : origins) {
    out.push_back(origin.body < 0 ? fresh : (*values)[static_cast<std::size_t>(origin.body)]);
  }
  *values = std::move(out);
}

}  // namespace

bool Replica::Queue(const EditOrder& order) {
  if (order.number != revision() + static_cast<int>(queued_.size())) return false;
  queued_.push_back(ToEdit(order));
  return true;
}

void Replica::ApplyEdits() {
  while (has_queued()) ApplyNextEdit();
}

std::optional<BodyRemap> Replica::ApplyNextEdit() {
  const Edit edit = queued_.front();
  queued_.erase(queued_.begin());
  std::optional<BodyRemap> change = world_.Apply({edit});
  if (change) Remap(*change);
  return change;
}

void Replica::Remap(const BodyRemap& change) {
  const std::vector<BodyOrigin>& bodies = change.bodies;
  std::vector<BodyState> now;
  std::vector<int> from;
  for (int body = 0; body < world_.body_count(); ++body) {
    now.push_back(world_.Read(body));
    from.push_back(bodies[static_cast<std::size_t>(body)].body);
  }
  history_.Remap(bodies, now);
  snapshots_.Remap(bodies);
  smoother_.Remap(from);
  Carry<std::int64_t>(bodies, -1000000, &last_impact_tick_);
  Carry<std::int64_t>(bodies, -1, &heard_tick_);
  Carry<std::int64_t>(bodies, tick(), &dynamic_since_);
  Carry<float>(bodies, 0, &priority_);
  Carry<std::int64_t>(bodies, -1, &asleep_since_);
  Carry<int>(bodies, revision(), &changed_at_);
  if (config_.pull != nullptr) Carry(bodies, Pull{}, &pulls_);
  std::vector<bool> placed;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    placed.push_back(bodies[i].body < 0 || placed_[static_cast<std::size_t>(bodies[i].body)]);
    if (bodies[i].same) continue;
    changed_at_[i] = revision();
    // Ours now and theirs then were other bodies: nothing to compare until both are the same.
    dynamic_since_[i] = tick();
    if (config_.pull != nullptr) pulls_[i] = Pull{};
    asleep_since_[i] = -1;
    if (!snapshots_.has(static_cast<int>(i))) snapshots_.Add(static_cast<int>(i), tick(), now[i]);
    if (BodyState* past = history_.At(tick(), static_cast<int>(i))) *past = now[i];
  }
  placed_ = placed;
  std::vector<std::int64_t> coupled;
  for (const std::vector<int>& mechanism : change.mechanisms) {
    std::int64_t last = -1000000;
    for (const int then : mechanism) {
      last = std::max(last, last_coupled_tick_[static_cast<std::size_t>(then)]);
    }
    coupled.push_back(last);
  }
  last_coupled_tick_ = coupled;
  AuthorityRecord fresh;
  if (config_.mode == Mode::kBuffer) fresh.secondaries.Add(0);
  table_.Remap(world_.composition(), change.mechanisms, fresh);
  barriers_.clear();  // of other bodies
  replay_from_ = -1;
  pressed_.clear();
  RolesChanged();
}

void Replica::NoteProposals() {
  for (Edit& edit : world_.ProposeEdits()) {
    const std::vector<PartId> parts = world_.topology().PartsOf(edit);
    if (config_.mode != Mode::kOracle) {
      bool mine = false;
      for (const PartId part : parts) {
        const int m = MechanismOf(world_, part);
        if (m < 0) continue;
        mine = table_.at(m).authority == self_;
        break;  // of two, the first one's authority proposes
      }
      if (!mine) continue;
    }
    const EditKey key = KeyOf(edit);
    const auto again = static_cast<std::int64_t>(kProposeAgain * config_.tick_hz);
    const auto said = proposed_.find(key);
    if (said != proposed_.end() && tick() - said->second < again) continue;
    if (proposed_.size() > kProposedMax) proposed_.clear();
    proposed_[key] = tick();
    proposals_.push_back(std::move(edit));
  }
}

std::vector<Edit> Replica::TakeProposals() {
  std::vector<Edit> out;
  out.swap(proposals_);
  return out;
}

}  // namespace seam
