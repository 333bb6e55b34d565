#pragma once
/// What the rules of a room go by: for each body its authority's word, checked. Where the server is
/// the authority, that is its own world; its copies of what others simulate count for nothing.

#include <cstdint>
#include <set>
#include <tuple>
#include <vector>

#include "common/codec/messages.h"
#include "common/sync/replica.h"
#include "server/authority/authority_manager.h"
#include "server/rules/rule_source.h"
#include "server/rules/state_trail.h"

namespace seam {

class AuthoritySource : public RuleSource {
 public:
  /// All must outlive it. Dropped things are counted in `stats`.
  AuthoritySource(const Replica& replica, const AuthorityManager& authority, Stats& stats);

  /// States of a peer that were accepted.
  void NoteStates(const States& accepted);
  /// Impacts that a peer says it felt. Believed of a body that it has authority over, in that
  /// epoch, of bodies that are what they were; when they are possible; and each once.
  void NoteReport(int peer, const ImpactReport& report);
  /// After each step of the replica.
  void NoteTick();
  /// The bodies have changed.
  void Remap(const std::vector<BodyOrigin>& bodies);

  BodyState Read(int body) const override;
  std::vector<std::int64_t> Ticks() const override;
  BodyState ReadAt(int body, std::int64_t tick) const override;
  std::int64_t TickOf(int body, std::int64_t tick) const override;
  void MarkProcessed() override { trail_.MarkProcessed(); }
  std::vector<Blow> TakeImpacts() override;

 private:
  bool Mine(int body) const { return authority_.Has(0, replica_.world().mechanism(body)); }
  bool MayReport(int peer, const ImpactReport& report, std::size_t i);
  void NoteReported(const ImpactReport& report, std::size_t i);

  const Replica& replica_;
  const AuthorityManager& authority_;
  Stats& stats_;
  StateTrail trail_;
  std::vector<Blow> blows_;                                     // of this tick
  std::set<std::tuple<std::int64_t, PartId, PartId>> counted_;  // tick, struck, by
};

}  // namespace seam
