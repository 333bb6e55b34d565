#include "server/edits/edit_log.h"

#include <algorithm>
#include <map>
#include <set>

#include "common/base/state_archive.h"
#include "common/codec/codec.h"
#include "common/physics/part_places.h"
#include "common/sync/edits/topology_snapshot.h"
#include "server/edits/proposal.h"

namespace seam {
namespace {

/// A proposal that cannot be ordered (its parts are being handed over) is dropped after this, s.
constexpr double kPendingSeconds = 3;
/// Ticks further in the past than this, s, are out of reach for replays; no clock is further ahead.
constexpr double kReachSeconds = 1;
/// Time after which the inputs known here are known to all, s: relayed with the order itself, or
/// repeated where they were lost. Shorter parts peers on lossy lines; longer delays scripts.
constexpr double kRelayedSeconds = 0.1;

/// Joints that edits of a batch remove, before any of them is applied. A later bond may reuse their
/// indices: a second break of the same index would break the new bond.
class RemovedJoints {
 public:
  explicit RemovedJoints(const Topology& topology) : topology_(topology) {}

  /// True if the edit would break a joint that another edit of the batch puts in that place.
  bool Misses(const Edit& edit) const {
    const BreakEdit* broken = edit.As<BreakEdit>();
    if (broken == nullptr || !bond_) return false;
    const Joint& joint = topology_.scene().joints[static_cast<std::size_t>(broken->joint)];
    return joints_.count(broken->joint) + parts_.count(joint.a) + parts_.count(joint.b) > 0;
  }
  void Add(const Edit& edit) {
    bond_ = bond_ || edit.As<BondEdit>() != nullptr;
    if (const BreakEdit* broken = edit.As<BreakEdit>()) joints_.insert(broken->joint);
    if (const RemoveEdit* removed = edit.As<RemoveEdit>()) parts_.insert(removed->part);
  }

 private:
  const Topology& topology_;
  std::set<std::int32_t> joints_;
  std::set<PartId> parts_;
  bool bond_ = false;
};

/// Parts that edits of a batch use. Edits that one peer's physics found in one tick belong
/// together: sixty crates become one body at once, not a pair at a time.
class TakenParts {
 public:
  struct By {
    int peer = 0;
    std::int64_t found = -1;  ///< tick; -1: from outside
  };
  bool ByAnother(PartId part, const By& by) const {
    const auto taken = by_.find(part);
    if (taken == by_.end()) return false;
    return by.found < 0 || taken->second.found != by.found || taken->second.peer != by.peer;
  }
  void Add(const std::vector<PartId>& parts, const By& by) {
    for (const PartId part : parts) by_[part] = by;
  }

 private:
  std::map<PartId, By> by_;
};

/// True if replays cannot go back beyond the edit: bodies or joints are others after it.
bool CutsOffPast(const Edit& edit) {
  return edit.As<PushEdit>() == nullptr && edit.As<SeatEdit>() == nullptr;
}

/// Returns the order without what is not the edit itself.
EditOrder Unnumbered(EditOrder order) {
  order.utime = order.tick = order.sequence = 0;
  order.session = 1;
  order.number = -1;
  return order;
}

}  // namespace

EditLog::EditLog(const World& world, const AuthorityManager& authority, int tick_hz)
    : world_(world), authority_(authority), tick_hz_(tick_hz), fold_(world.topology()) {
  hash_after_[0] = world_.composition().hash;
}

bool EditLog::Wait(const Edit& edit, int peer, std::int64_t found) {
  int& waiting = waiting_of_peer_[static_cast<std::size_t>(peer)];
  if (waiting == kWaitingMax) return false;
  ++waiting;
  Pending pending{edit, peer, world_.tick(), found, 0};
  const BreakEdit* broken = edit.As<BreakEdit>();
  const Topology& topology = world_.topology();
  if (broken != nullptr && topology.HasJoint(broken->joint)) {
    pending.made_at = topology.JointMadeAt(broken->joint);
  }
  pending_.push_back(std::move(pending));
  return true;
}

/// Returns the tick of an edit. One that physics found gets the tick in which it was found, if
/// possible: every peer goes back to it. An edit from outside gets the first tick in which it could
/// be ordered.
std::int64_t EditLog::TickOf(const Pending& pending) const {
  const std::int64_t now = world_.tick();
  const bool found = pending.found <= now &&
                     pending.found >= now - static_cast<std::int64_t>(kReachSeconds * tick_hz_);
  return std::max(last_tick_, found ? pending.found : now);
}

bool EditLog::HasRight(int peer, const std::vector<PartId>& parts) const {
  bool anchored = true;
  for (const PartId part : parts) {
    const int m = MechanismOf(world_, part);
    if (m < 0) continue;
    anchored = false;
    if (authority_.Has(peer, m)) return true;
  }
  return anchored && authority_.FeelsAnchored(peer);
}

/// True if physics found the edit in a tick that this world has yet to step: the clock of its peer
/// is ahead.
bool EditLog::IsEarly(const Pending& pending) const {
  const std::int64_t ahead = pending.found - world_.tick();
  return pending.edit.cause == EditCause::kPhysics && ahead > 0 &&
         ahead <= static_cast<std::int64_t>(kReachSeconds * tick_hz_);
}

/// True if the edit would cut off inputs that are still to come.
bool EditLog::LacksInputs(const Pending& pending) const {
  if (!CutsOffPast(pending.edit)) return false;
  const auto relayed = static_cast<std::int64_t>(kRelayedSeconds * tick_hz_);
  const auto reach = static_cast<std::int64_t>(kReachSeconds * tick_hz_);
  return complete_ < pending.found + relayed && world_.tick() - pending.found < reach;
}

/// The order of the checks matters: a peer's right is checked before its proposal is read, parsed
/// or copied further.
EditLog::Verdict EditLog::Propose(int peer, const EditOrder& proposal) {
  const Topology& topology = world_.topology();
  const Edit edit = ToEdit(proposal);
  const BreakEdit* broken = edit.As<BreakEdit>();
  const bool physics = edit.cause == EditCause::kPhysics;
  if (!physics || (broken == nullptr && edit.As<BondEdit>() == nullptr)) return Verdict::kNoRight;
  const std::vector<PartId> parts = topology.PartsOf(edit);
  if (parts.empty()) return Verdict::kStale;
  if (!HasRight(peer, parts)) return Verdict::kNoRight;
  if (broken != nullptr && topology.JointMadeAt(broken->joint) > proposal.sequence) {
    return Verdict::kStale;  // it means an earlier joint
  }
  if (!topology.Validate(edit).ok()) return Verdict::kStale;
  if (!MayPropose(topology, edit)) return Verdict::kNoRight;
  if (!PlausibleProposal(world_, edit)) return Verdict::kImplausible;
  return Wait(edit, peer, proposal.tick) ? Verdict::kTaken : Verdict::kTooMany;
}

std::vector<int> EditLog::MechanismsOf(const Edit& edit) const {
  std::vector<int> mechanisms;
  for (const PartId part : world_.topology().PartsOf(edit)) {
    const int m = MechanismOf(world_, part);
    if (m >= 0) mechanisms.push_back(m);
  }
  return mechanisms;
}

std::vector<std::vector<int>> EditLog::WaitingMechanisms() const {
  std::vector<std::vector<int>> all;
  for (const Pending& pending : pending_) all.push_back(MechanismsOf(pending.edit));
  return all;
}

bool EditLog::IsStale(const Pending& pending) const {
  const Topology& topology = world_.topology();
  if (!topology.Validate(pending.edit).ok()) return true;
  const BreakEdit* broken = pending.edit.As<BreakEdit>();
  return broken != nullptr && topology.JointMadeAt(broken->joint) != pending.made_at;
}

EditLog::Batch EditLog::OrderPending(std::int64_t now_us) {
  const Topology& topology = world_.topology();
  const auto patience = static_cast<std::int64_t>(kPendingSeconds * tick_hz_);
  std::vector<Pending> waiting;
  Batch batch;
  TakenParts taken;
  RemovedJoints removed_joints(topology);
  bool lacks_inputs = false;
  for (Pending& pending : pending_) {
    if (IsStale(pending) || removed_joints.Misses(pending.edit)) {
      if (pending.peer > 0) ++batch.stale;
      continue;
    }
    const std::vector<PartId> parts = topology.PartsOf(pending.edit);
    const bool physics = pending.edit.cause == EditCause::kPhysics;
    const TakenParts::By by{pending.peer, physics ? pending.found : -1};
    const bool again = std::any_of(parts.begin(), parts.end(),
                                   [&](PartId part) { return taken.ByAnother(part, by); });
    const bool bond = pending.edit.As<BondEdit>() != nullptr;
    if (IsEarly(pending) || (bond && again) || !authority_.InOneHand(MechanismsOf(pending.edit))) {
      if (!physics) pending.found = world_.tick() + 1;  // the next tick, at the earliest
      if (world_.tick() - pending.since < patience) waiting.push_back(pending);
      continue;
    }
    lacks_inputs = lacks_inputs || (!physics && LacksInputs(pending));
    if (!physics && lacks_inputs) {
      waiting.push_back(pending);
      continue;
    }
    if (physics && !PlausibleProposal(world_, pending.edit)) continue;  // the parts have moved on
    taken.Add(parts, by);
    removed_joints.Add(pending.edit);
    EditOrder order = ToOrder(pending.edit);
    order.utime = now_us;
    order.tick = last_tick_ = TickOf(pending);
    order.number = NextNumber();
    batch.orders.push_back(order);
  }
  pending_ = std::move(waiting);
  waiting_of_peer_.fill(0);
  for (const Pending& pending : pending_) {
    ++waiting_of_peer_[static_cast<std::size_t>(pending.peer)];
  }
  return batch;
}

void EditLog::NoteOrdered(const EditOrder& order) {
  const auto same = [&](const Pending& pending) {
    EditOrder is = ToOrder(pending.edit);
    is.cause = order.cause;  // physics may have found what was proposed from outside
    return Encode(Unnumbered(is)) == Encode(Unnumbered(order));
  };
  const auto found = std::find_if(pending_.begin(), pending_.end(), same);
  if (found != pending_.end()) {
    --waiting_of_peer_[static_cast<std::size_t>(found->peer)];
    pending_.erase(found);
  }
  ordered_ = order.number + 1;
  last_tick_ = std::max(last_tick_, order.tick);
}

std::optional<EditOrder> EditLog::NoteApplied(const Edit& edit, std::int64_t) {
  const Topology& topology = world_.topology();
  fold_.Note(edit, topology);
  hash_after_[topology.revision()] = topology.composition().hash;
  if (hash_after_.size() > kHashesMax) hash_after_.erase(hash_after_.begin());
  return std::nullopt;
}

std::vector<Edit> EditLog::TakePending() {
  std::vector<Edit> edits;
  for (Pending& pending : pending_) {
    if (!IsStale(pending)) edits.push_back(std::move(pending.edit));
  }
  pending_.clear();
  waiting_of_peer_.fill(0);
  return edits;
}

bool EditLog::Differs(int revision, std::int64_t composition) const {
  const auto known = hash_after_.find(revision);
  return known != hash_after_.end() && known->second != static_cast<std::uint64_t>(composition);
}

bool EditLog::NeedsRepair(const Ping& ping, bool more_under_way) const {
  if (ping.revision < 0) return false;  // has no world yet
  const bool never = ping.revision > ordered_;
  const bool lost = !more_under_way && ping.revision < hash_after_.begin()->first;
  return never || lost || Differs(ping.revision, ping.composition);
}

EditOrder EditLog::BeginAnew(std::int64_t now_us) const {
  EditOrder anew;
  anew.utime = now_us;
  anew.tick = std::max<std::int64_t>(0, world_.tick());
  return anew;
}

std::vector<Snapshot> EditLog::History(std::int64_t now_us) const {
  const Topology& topology = world_.topology();
  if (topology.revision() == 0) return {};
  std::vector<Snapshot> all = ToSnapshots(topology.revision(), fold_.Entries(topology));
  for (Snapshot& part : all) part.utime = now_us;
  return all;
}

void EditLog::GoOnFrom(const TopologyFold& fold) {
  const Topology& topology = world_.topology();
  fold_ = fold;
  ordered_ = topology.revision();
  hash_after_.clear();
  hash_after_[ordered_] = topology.composition().hash;
}

void EditLog::Persist(StateArchive& a) {
  a.Section("edits");
  const Topology& topology = world_.topology();
  if (!a.reading()) {
    SEAM_ASSERT(ordered_ == topology.revision());
    pending_.erase(std::remove_if(pending_.begin(), pending_.end(),
                                  [this](const Pending& pending) { return IsStale(pending); }),
                   pending_.end());
  }
  a.List(&pending_, static_cast<std::size_t>(kWaitingMax) * kPeersMax, [&](Pending* pending) {
    seam::Persist(a, &pending->edit);
    a.Int(&pending->peer, 0, kPeersMax - 1);
    a.Tick(&pending->since);
    a.Tick(&pending->found);
    const BreakEdit* broken = pending->edit.As<BreakEdit>();
    if (broken != nullptr && topology.HasJoint(broken->joint)) {
      pending->made_at = topology.JointMadeAt(broken->joint);
    }
  });
  a.Int(&last_tick_, 0, std::max<std::int64_t>(0, world_.tick()));
  waiting_of_peer_.fill(0);
  for (const Pending& pending : pending_) {
    int& waiting = waiting_of_peer_[static_cast<std::size_t>(pending.peer)];
    a.Require(++waiting <= kWaitingMax, "a peer has too many edits");
  }
}

}  // namespace seam
