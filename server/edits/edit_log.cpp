#include "server/edits/edit_log.h"

#include <algorithm>

#include "common/physics/part_places.h"
#include "server/edits/proposal.h"

namespace seam {
namespace {

/// A proposal that cannot be ordered yet (its parts are changing hands) is forgotten after this, s.
constexpr double kPendingSeconds = 3;
/// Proposals that may wait; a hostile peer could send many.
constexpr std::size_t kPendingMax = 1024;

}  // namespace

EditLog::EditLog(const World& world, const AuthorityManager& authority, int tick_hz)
    : world_(world), authority_(authority), tick_hz_(tick_hz) {
  NoteComposition(0);
}

void EditLog::Wait(const Edit& edit, int peer) {
  if (pending_.size() < kPendingMax) pending_.push_back({edit, peer, world_.tick()});
}

void EditLog::Add(const Edit& edit) { Wait(edit, 0); }

EditLog::Verdict EditLog::Propose(int peer, const EditOrder& proposal) {
  const Edit edit = ToEdit(proposal);
  const Topology& topology = world_.topology();
  if (!topology.Validate(edit).ok()) return Verdict::kStale;
  const std::vector<PartId> parts = topology.PartsOf(edit);
  const bool right = !parts.empty() && MayPropose(topology, edit) &&
                     std::any_of(parts.begin(), parts.end(), [&](PartId part) {
                       const int m = MechanismOf(world_, part);
                       return m >= 0 && authority_.Has(peer, m);
                     });
  if (!right) return Verdict::kNoRight;
  if (!PlausibleProposal(world_, edit)) return Verdict::kImplausible;
  Wait(edit, peer);
  return Verdict::kTaken;
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

EditLog::Batch EditLog::OrderPending(std::int64_t now_us) {
  const Topology& topology = world_.topology();
  const auto patience = static_cast<std::int64_t>(kPendingSeconds * tick_hz_);
  std::vector<Pending> waiting;
  Batch batch;
  std::vector<PartId> taken;  // parts that an edit of this batch is about
  for (Pending& pending : pending_) {
    if (!topology.Validate(pending.edit).ok()) {
      if (pending.peer > 0) ++batch.stale;
      continue;
    }
    const std::vector<PartId> parts = topology.PartsOf(pending.edit);
    const bool again = std::any_of(parts.begin(), parts.end(), [&](PartId part) {
      return std::find(taken.begin(), taken.end(), part) != taken.end();
    });
    const bool bond = pending.edit.As<BondEdit>() != nullptr;
    if ((bond && again) || !authority_.InOneHand(MechanismsOf(pending.edit))) {
      if (world_.tick() - pending.since < patience) waiting.push_back(pending);
      continue;
    }
    const bool found = pending.edit.cause == EditCause::kPhysics;
    if (found && !PlausibleProposal(world_, pending.edit)) continue;  // it has moved on
    if (ordered_.size() == kEditsMax) {
      batch.just_full = batch.just_full || !full_;
      full_ = true;
      continue;
    }
    taken.insert(taken.end(), parts.begin(), parts.end());
    EditOrder order = ToOrder(pending.edit);
    order.utime = now_us;
    order.tick = world_.tick();
    order.number = static_cast<std::int32_t>(ordered_.size());
    ordered_.push_back(order);
    batch.orders.push_back(order);
  }
  pending_ = std::move(waiting);
  return batch;
}

void EditLog::NoteComposition(int revision) { hash_after_[revision] = world_.composition().hash; }

bool EditLog::Differs(int revision, std::int64_t composition) const {
  const auto known = hash_after_.find(revision);
  return known != hash_after_.end() && known->second != static_cast<std::uint64_t>(composition);
}

bool EditLog::NeedsRepair(const Ping& ping) const {
  if (ping.revision < 0) return false;  // has no world yet
  const bool never = ping.revision > static_cast<std::int32_t>(ordered_.size());
  return never || Differs(ping.revision, ping.composition);
}

EditOrder EditLog::BeginAnew(std::int64_t now_us) const {
  EditOrder anew;
  anew.utime = now_us;
  anew.tick = std::max<std::int64_t>(0, world_.tick());
  return anew;
}

}  // namespace seam
