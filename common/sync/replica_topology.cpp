/// Replica: edits, and bodies that they split and merge. Records of a body (its past, states
/// received, its displayed pose) are carried over to its successors.

#include <algorithm>
#include <cstdlib>
#include <set>

#include "common/physics/part_places.h"
#include "common/sync/replica.h"

namespace seam {
namespace {

/// Forgets bonds between the parts of a broken joint: they may hold again at once, like a hand that
/// reaches on along a wall.
void ForgetBonds(const Scene& scene, std::int32_t broken, ProposalQueue* proposals) {
  if (broken < 0 || static_cast<std::size_t>(broken) >= scene.joints.size()) return;
  const Joint& joint = scene.joints[static_cast<std::size_t>(broken)];
  for (const BondCause cause : {BondCause::kConnectors, BondCause::kGroup, BondCause::kGrip}) {
    proposals->Forget(KeyOf(Edit(BondEdit{joint.a, joint.b, {0, 0}, 0, 0, cause})));
  }
}

}  // namespace

bool Replica::Queue(const EditOrder& order) { return queue_->Take(order, revision()); }

bool Replica::has_queued() const {
  if (queue_->empty()) return false;
  // Where inputs alone make peers agree, an edit that cuts off their past waits for them.
  if (config_.policy->InputsOnly()) {
    return queue_->front().tick <= std::min(replay_.now(), complete_.Tick());
  }
  // An order of a tick far ahead is not believed.
  const std::int64_t ahead = queue_->front().tick - replay_.now();
  return ahead <= 0 || ahead > config_.tick_hz;
}

void Replica::ApplyEdits() {
  while (has_queued()) ApplyNextEdit();
}

void Replica::ApplyNextEdit() {
  const QueuedEdit next = queue_->Pop();
  if (activities_.NeedAll()) {  // the edit may reach any of them
    corrector_.FollowRoles();
    world_.Settle();
  }
  replay_.GoBackTo(next.tick);
  const std::optional<BodyRemap> change = world_.Apply({next.edit});
  ForgetProposals(next.edit);
  rest_->MarkEdited();
  if (change) table_.Renumber(*change);
  FollowRoles();  // also if only the player in a seat, and so the predicted mechanisms, changed
  if (change && config_.policy->SendsCompleteTicks())
    reach_.Look();  // indexes mechanisms by number
  replay_.Edited(next.edit, change.has_value());
  if (has_queued()) return;
  replay_.GoOn();
  memory_.NoteAllUnsettled();
}

void Replica::FindEdits() {
  const std::int64_t now = tick();
  found_.erase(now);  // results of an earlier step of this tick
  for (Edit& edit : world_.ProposeEdits()) {
    if (const BreakEdit* broken = edit.As<BreakEdit>()) felt_breaks_[broken->joint] = now;
    if (queue_->TakeFound(edit, now) || !roles_.Proposes(edit)) continue;
    found_[now].push_back(std::move(edit));
  }
}

bool Replica::FeltBreak(int joint, std::int64_t tick) const {
  const auto felt = felt_breaks_.find(joint);
  return felt != felt_breaks_.end() && std::llabs(felt->second - tick) <= config_.tick_hz / 4;
}

void Replica::ProposeFound() {
  if (found_.empty()) return;
  const bool waits = config_.policy->SendsCompleteTicks();
  if (waits) reach_.Look();
  // In the order of ticks: an edit cannot be ordered for a tick before the previous order's.
  while (!found_.empty()) {
    const auto first = found_.begin();
    const std::int64_t found = first->first;
    const bool due = !waits || found < tick() - config_.tick_hz / 2;
    if (!due && !std::all_of(first->second.begin(), first->second.end(),
                             [&](const Edit& e) { return IsComplete(e, found); })) {
      return;
    }
    bool proposed = false;
    for (Edit& edit : first->second) proposed = Propose(std::move(edit), found) || proposed;
    found_.erase(first);
    if (proposed && waits) found_.clear();  // the rest is found again in the edited world
  }
}

bool Replica::IsComplete(const Edit& edit, std::int64_t found) const {
  if (replay_.settled() < found) return false;
  bool anchored = true;
  for (const PartId part : world_.topology().PartsOf(edit)) {
    const int m = MechanismOf(world_, part);
    if (m < 0) continue;
    anchored = false;
    if (reach_.CompleteTick(m) < found) return false;
  }
  // Any body may have loaded an anchored part.
  return !anchored || reach_.CompleteTickOfAll() >= found;
}

bool Replica::Propose(Edit edit, std::int64_t found) {
  if (!world_.topology().Validate(edit).ok() || AwaitsOtherEdit(edit, found)) return false;
  Awaited awaited{KeyOf(edit), world_.topology().PartsOf(edit), found};
  if (!proposals_.Add(std::move(edit), found)) return false;
  awaited_.push_back(std::move(awaited));
  return true;
}

bool Replica::AwaitsOtherEdit(const Edit& edit, std::int64_t found) {
  if (!config_.policy->GoesBack(roles_.self())) return false;
  const std::int64_t old = replay_.now() - config_.tick_hz / 2;
  awaited_.erase(std::remove_if(awaited_.begin(), awaited_.end(),
                                [&](const Awaited& a) { return a.tick < old; }),
                 awaited_.end());
  std::set<int> mechanisms;
  for (const PartId part : world_.topology().PartsOf(edit)) {
    mechanisms.insert(MechanismOf(world_, part));
  }
  mechanisms.erase(-1);
  return std::any_of(awaited_.begin(), awaited_.end(), [&](const Awaited& a) {
    if (a.tick == found) return false;
    return std::any_of(a.parts.begin(), a.parts.end(), [&](PartId part) {
      return mechanisms.count(MechanismOf(world_, part)) > 0;
    });
  });
}

void Replica::ForgetProposals(const Edit& edit) {
  const EditKey key = KeyOf(edit);
  if (const BreakEdit* broken = edit.As<BreakEdit>()) {
    proposals_.Forget(key);
    ForgetBonds(world_.scene(), broken->joint, &proposals_);
  }
  awaited_.erase(std::remove_if(awaited_.begin(), awaited_.end(),
                                [&](const Awaited& a) { return a.key == key; }),
                 awaited_.end());
  for (auto& [found, edits] : found_) {
    if (found > tick()) break;
    edits.erase(
        std::remove_if(edits.begin(), edits.end(), [&](const Edit& e) { return KeyOf(e) == key; }),
        edits.end());
  }
  const RemoveEdit* removed = edit.As<RemoveEdit>();
  const std::vector<Joint>& joints = world_.scene().joints;
  for (std::size_t j = 0; removed != nullptr && j < joints.size(); ++j) {
    if (joints[j].a != removed->part && joints[j].b != removed->part) continue;
    proposals_.Forget(KeyOf(Edit(BreakEdit{static_cast<std::int32_t>(j)})));
  }
}

void Replica::GoOnFrom(const World& before) {
  const std::size_t known = before.scene().parts.size();
  for (int body = 0; body < world_.body_count(); ++body) {
    const PartId root = world_.id(body);
    BodyState state;
    if (static_cast<std::size_t>(root) >= known || !ReadPart(before, root, &state)) continue;
    const int assembly = before.composition().assembly_of_part[static_cast<std::size_t>(root)];
    const PartId id = before.composition().assemblies[static_cast<std::size_t>(assembly)].id;
    const int then = before.BodyOfId(id);
    world_.Write(body, state);
    if (then >= 0 && !before.awake(then)) world_.SetAwake(body, false);
    memory_.snapshots().Add(body, tick(), state);
    if (BodyState* past = memory_.history().At(tick(), body)) *past = state;
  }
}

}  // namespace seam
